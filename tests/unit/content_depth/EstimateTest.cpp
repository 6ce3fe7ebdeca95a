// The estimators of one frame, in a room of known size.
#include "content/make/depth/FilmDepth.h"
#include "content/make/depth/FrameRecord.h"
#include "content/make/depth/Ground.h"
#include "content/make/depth/SphereSweep.h"
#include "content/make/depth/TrackFilter.h"
#include "engine/math/LatLong.h"
#include "engine/media/DepthTrack.h"
#include "tests/unit/media/TestFiles.h"

#include <opencv2/imgproc.hpp>

namespace shoal::depth {
namespace {

namespace fs = std::filesystem;

// A room of known size that can be drawn from any place in it: a box with noise on its walls.
struct TestRoom {
    glm::vec3 half{2, 1.5f, 2.5f}; // metres, from its middle to its walls

    float distance(const glm::vec3& from, const glm::vec3& dir) const {
        float least = 1e9f;
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(dir[axis]) > 1e-6f)
                least = std::min(least, (std::copysign(half[axis], dir[axis]) - from[axis]) / dir[axis]);
        return least;
    }

    // Returns a grey value, 0 to 255, smooth over 0.1 m and more.
    static float greyAt(const glm::vec3& at) {
        float sum = 0;
        for (const float period : {0.12f, 0.31f, 0.7f}) {
            const glm::vec3 cell = glm::floor(at / period), f = at / period - cell;
            const glm::vec3 s = f * f * (3.0f - 2.0f * f);
            for (int k = 0; k < 8; ++k) {
                const glm::vec3 corner(k & 1, k >> 1 & 1, k >> 2);
                const glm::vec3 w = glm::mix(1.0f - s, s, corner), c = cell + corner;
                const float value = std::sin(c.x * 127.1f + c.y * 311.7f + c.z * 74.7f) * 43758.547f;
                sum += w.x * w.y * w.z * (value - std::floor(value) - 0.5f);
            }
        }
        return std::clamp(128 + 110 * sum, 0.0f, 255.0f);
    }

    // Returns the lat-long picture seen from there. between_m: distance between two eyes of omnidirectional
    // stereo; below 0 the left eye's picture, above 0 the right eye's.
    ImageRgb8 seen(const glm::vec3& from, int width, float between_m = 0) const {
        ImageRgb8 picture(width, width / 2);
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < width; ++x) {
                const glm::vec3 dir = texelDirection(x, y, width, picture.height);
                const glm::vec3 right = glm::normalize(glm::vec3(-dir.z, 0, dir.x));
                const glm::vec3 eye = from + right * (between_m / 2);
                const auto grey = static_cast<uint8_t>(greyAt(eye + dir * distance(eye, dir)));
                std::fill_n(picture.at(x, y), 3, grey);
            }
        return picture;
    }
};

struct Shares {
    double right = 0;     // of what is confident: within 10 %
    double confident = 0; // of all
};

// Compares with the room seen from `from`; shares are of solid angle.
Shares sharesOf(const DepthEstimate& depth, const TestRoom& room, const glm::vec3& from) {
    double right = 0, confident = 0, all = 0;
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        const glm::vec3 dir = estimateDirection(i);
        const double weight = std::sqrt(1 - static_cast<double>(dir.y * dir.y));
        all += weight;
        if (depth.confidence[i] < 0.6f) continue;
        confident += weight;
        if (std::abs(depth.inverse[i] * room.distance(from, dir) - 1) < 0.1f) right += weight;
    }
    return {right / confident, confident / all};
}

struct Swept {
    SweepImage reference;
    std::vector<SweepImage> images;
    std::vector<SweepView> views;
};

Swept sweepOf(const TestRoom& room, const std::vector<glm::vec3>& places) {
    Swept result;
    makeSweepImage(viewOf(room.seen({0, 0, 0}, 1024)), result.reference);
    result.images.resize(places.size());
    for (size_t i = 0; i < places.size(); ++i) {
        makeSweepImage(viewOf(room.seen(places[i], 1024)), result.images[i]);
        result.views.push_back({&result.images[i], glm::mat3(1), places[i], i % 2 == 1});
    }
    return result;
}

// The goal of the whole tool: it is confident of half at least, of which four fifths are within 10 %.
TEST(SphereSweep, AWalkThroughARoomGivesItsWalls) {
    const TestRoom room;
    Swept swept = sweepOf(room, {{-0.1f, 0, 0.02f}, {0.1f, 0, -0.02f}, {-0.2f, 0, 0}, {0.2f, 0, 0}});
    DepthEstimate depth;
    SphereSweep().estimate(swept.reference, swept.views, 1.2f, depth);
    const Shares shares = sharesOf(depth, room, {0, 0, 0});
    EXPECT_GT(shares.right, 0.8);
    EXPECT_GT(shares.confident, 0.5);
}

TEST(SphereSweep, NothingIsKnownOfOnePlace) {
    const TestRoom room;
    Swept swept = sweepOf(room, {{0, 0, 0}, {0, 0, 0}});
    DepthEstimate depth;
    SphereSweep().estimate(swept.reference, swept.views, 1.2f, depth);
    EXPECT_EQ(*std::max_element(depth.confidence.begin(), depth.confidence.end()), 0);
    SphereSweep().estimate(swept.reference, {}, 1.2f, depth);
    EXPECT_EQ(*std::max_element(depth.confidence.begin(), depth.confidence.end()), 0);
}

// Poles are left out: there the eyes of omnidirectional stereo see no disparity.
TEST(StereoDepth, APairOfARoomGivesItsWalls) {
    constexpr float kBaseline_m = 0.064f;
    const TestRoom room;
    const ImageRgb8 left = room.seen({0, 0, 0}, 2048, -kBaseline_m),
                    right = room.seen({0, 0, 0}, 2048, kBaseline_m);
    DepthEstimate depth;
    StereoDepth().estimate(viewOf(left), viewOf(right), static_cast<double>(kBaseline_m), kEstimateWidth,
                           depth);
    const Shares shares = sharesOf(depth, room, {0, 0, 0});
    EXPECT_GT(shares.right, 0.8);
    EXPECT_GT(shares.confident, 0.5);
}

TEST(StereoDepth, OneEyeTwiceIsFarAway) {
    const ImageRgb8 left = TestRoom().seen({0, 0, 0}, 1024);
    DepthEstimate depth;
    StereoDepth().estimate(viewOf(left), viewOf(left), 0.064, kEstimateWidth, depth);
    EXPECT_LT(*std::max_element(depth.confidence.begin(), depth.confidence.end()), 0.25f) << "not believed";
}

// Another frame, 0.2 m beside, knows the room: texels that contradict it lose their confidence.
TEST(TrackFilter, DepthThatOtherFramesContradictIsNotBelieved) {
    const TestRoom room;
    const glm::vec3 beside(0.2f, 0, 0);
    OtherFrame other;
    other.pose.at = beside;
    DepthEstimate depth;
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        const glm::vec3 dir = estimateDirection(i);
        depth.inverse.push_back((i % 2 == 0 ? 2.0f : 1.0f) / room.distance({0, 0, 0}, dir));
        depth.confidence.push_back(0.9f);
        other.depth.inverse.push_back(1 / room.distance(beside, dir));
        other.depth.confidence.push_back(1);
    }
    requireAgreement(depth, std::vector{other, other});
    int believedWrong = 0, believedRight = 0;
    for (size_t i = 0; i < kEstimateTexels; ++i)
        (i % 2 == 0 ? believedWrong : believedRight) += depth.confidence[i] >= 0.6f;
    EXPECT_EQ(believedWrong, 0);
    // Texels at the corners of the room may see another wall from beside.
    EXPECT_GT(believedRight, static_cast<int>(0.97 * kEstimateTexels / 2));
}

// A block of known texels lies across the seam; those at its outline are doubted.
TEST(TrackFilter, OutlinesAreDoubted) {
    DepthEstimate depth{std::vector<float>(kEstimateTexels, 1), std::vector<float>(kEstimateTexels)};
    const auto at = [](int x, int y) {
        return static_cast<size_t>(y * kEstimateWidth + (x + kEstimateWidth) % kEstimateWidth);
    };
    for (int y = 20; y < 30; ++y)
        for (int x = -5; x < 5; ++x) depth.confidence[at(x, y)] = 0.9f;
    doubtOutlines(depth);
    for (int y = 20; y < 30; ++y)
        for (int x = -5; x < 5; ++x) {
            const bool isOutline = x == -5 || x == 4 || y == 20 || y == 29;
            EXPECT_EQ(depth.confidence[at(x, y)], isOutline ? 0.5f : 0.9f) << x << ", " << y;
        }
    EXPECT_EQ(depth.confidence[at(-6, 25)], 0);
}

// The cap from the zenith 45 degrees down is (1 - cos 45 degrees) / 2 of the sphere.
TEST(TrackFilter, BelievedShareIsCountedBySolidAngle) {
    media::DepthFrame frame;
    frame.confidence.assign(kEstimateTexels / 4, media::kMaxDepthCode / 2);
    std::fill_n(frame.confidence.begin(), kEstimateTexels / 16, media::kMaxDepthCode * 3 / 4);
    EXPECT_NEAR(believedShare(frame), 0.1464, 0.001);
}

// A plane 1.6 m below the camera, tilted by 6 degrees: its dot product with a direction is 1 / distance.
const glm::vec3 kPlane = glm::normalize(glm::vec3(0.1f, -1, 0.03f)) / 1.6f;

bool isBoulder(const glm::vec3& dir) {
    return glm::dot(dir, glm::normalize(glm::vec3(0, -0.6f, -1))) > 0.96f;
}
bool isLit(const glm::vec3& dir) { return dir.x > 0 && std::abs(dir.z) < dir.x; } // a quarter of all around

// Returns a frame that knows the ground exactly in so many of ten texels, in others in each frame. A boulder
// hides some of it, and caustics move over a quarter.
DepthEstimate seenInPlaces(size_t inTen = 5, size_t frame = 0) {
    DepthEstimate depth;
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        const glm::vec3 dir = estimateDirection(i);
        const float inverse = glm::dot(kPlane, dir);
        const bool isKnown = inverse > 0 && !isLit(dir) && (i * 7919 + frame * 3) % 10 < inTen;
        depth.inverse.push_back(isBoulder(dir) ? 1.6f * inverse : isKnown ? inverse : 3.0f);
        depth.confidence.push_back(isBoulder(dir) ? 0.9f : isKnown ? 0.8f : 0.1f);
    }
    return depth;
}

// Returns a frame with a ball below one side of the camera, on ground without any texture.
DepthEstimate ballBelow() {
    const glm::vec3 middle(0.7f, -1.7f, 0);
    const float radius = 1;
    DepthEstimate depth;
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        const float along = glm::dot(estimateDirection(i), middle),
                    square = along * along - glm::dot(middle, middle) + radius * radius;
        const bool isSeen = along > 0 && square > 0;
        depth.inverse.push_back(isSeen ? 1 / (along - std::sqrt(square)) : 0.2f);
        depth.confidence.push_back(isSeen ? 0.9f : 0);
    }
    return depth;
}

// Returns the frame twice, since a texel has to be known in two frames.
std::vector<DepthEstimate> twice(const DepthEstimate& depth) { return {depth, depth}; }

// Each frame knows a tenth of the ground, all together three quarters; one in five believes it twice as far.
TEST(Ground, FramesTellOfItTogether) {
    std::vector<DepthEstimate> frames;
    for (size_t frame = 0; frame < kGroundFrames; ++frame) {
        frames.push_back(seenInPlaces(1, frame));
        for (float& each : frames.back().inverse) each *= frame % 5 == 0 ? 0.5f : 1;
    }
    EXPECT_EQ(findGround(twice(frames[1])).trust, 0);
    const Ground ground = findGround(frames);
    EXPECT_EQ(ground.trust, 1);
    EXPECT_NEAR(glm::distance(ground.inverse, kPlane), 0, 0.005f * glm::length(kPlane));
}

TEST(Ground, GoesOnWhereTooLittleIsKnown) {
    const DepthEstimate before = seenInPlaces();
    DepthEstimate depth = before;
    continueGround(findGround(twice(depth)), depth);
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        const glm::vec3 dir = estimateDirection(i);
        if (isBoulder(dir) || dir.y > 0) {
            EXPECT_EQ(depth.inverse[i], before.inverse[i]);
            EXPECT_EQ(depth.confidence[i], before.confidence[i]);
        } else if (glm::dot(kPlane, dir) > std::sin(0.22f) * glm::length(kPlane)) { // clearly below
            EXPECT_NEAR(depth.inverse[i] / glm::dot(kPlane, dir), 1, 0.02f);
            EXPECT_GE(depth.confidence[i], 0.6f);
        }
    }
}

// Less than a quarter of confidence says nothing (content/README.md).
TEST(Ground, AThingBelowIsNoGround) {
    const DepthEstimate before = ballBelow();
    DepthEstimate depth = before;
    continueGround(findGround(twice(depth)), depth);
    for (size_t i = 0; i < kEstimateTexels; ++i)
        if (before.confidence[i] > 0)
            EXPECT_EQ(depth.inverse[i], before.inverse[i]);
        else
            EXPECT_LT(depth.confidence[i], 0.25f);
}

TEST(Ground, IsMissingWhereNothingIsKnown) {
    const DepthEstimate nothing{std::vector<float>(kEstimateTexels, 1), std::vector<float>(kEstimateTexels)};
    EXPECT_EQ(findGround(twice(nothing)).trust, 0);
    EXPECT_EQ(findGround({}).trust, 0);
}

constexpr int kFrames = 8;

class FilmDepths : public testing::Test {
  protected:
    // Writes a film 256 pixels around, whose camera moves by 4 cm each frame. gain: factor of all light;
    // noise: standard deviation of each pixel, grey values.
    void film(double gain = 1, double noise = 0) {
        cv::RNG random(7);
        const auto picture = [&](int i) {
            ImageRgb8 seen = TestRoom().seen({0.04f * static_cast<float>(i - kFrames / 2), 0, 0}, 1024);
            const cv::Mat large(seen.height, seen.width, CV_8UC3, seen.pixels.data());
            cv::Mat small;
            cv::resize(large, small, {256, 128}, 0, 0, cv::INTER_AREA);
            cv::Mat sensor(128, 256, CV_32F), filmed;
            random.fill(sensor, cv::RNG::NORMAL, 0, noise);
            cv::cvtColor(sensor, sensor, cv::COLOR_GRAY2BGR);
            small.convertTo(filmed, CV_32F, gain);
            cv::Mat(filmed + sensor).convertTo(small, CV_8U);
            return small;
        };
        media::writeFilm(film_, "MJPG", kFrames, picture, 24);
    }

    Result<FilmDepth> make(const FilmDepthOptions& options = {}) {
        return makeFilmDepth(film_, out_, options);
    }

    media::TempFolder folder_;
    Path film_ = folder_ / "film.avi", out_ = folder_ / "film.depth.mkv",
         part_ = folder_ / "film.depth.mkv.part";
};

struct Interrupted {};

// Ends the run by an exception after that many of its reports, as if the program had been killed.
FilmDepthOptions interruptedAfter(int reports) {
    return {.progress = [reports, count = 0](double) mutable {
        if (++count == reports) throw Interrupted{};
    }};
}

// The film's texture has a deviation of a grey value or two, like its noise: enough to find a movement, but
// hardly any distance that several frames agree on.
TEST_F(FilmDepths, AFilmDarkerThanItsNoiseIsNotKnownAndWritesNothing) {
    film(0.05, 1.5);
    int reports = 0;
    const Path preview = folder_ / "film.png";
    EXPECT_EQ(tests::valueOf(make({.preview = preview, .progress = [&](double) { ++reports; }})),
              FilmDepth::CannotBeKnown);
    EXPECT_EQ(reports, 2 * kFrames / 2) << "a movement was found";
    for (const Path& file : {out_, part_, preview}) EXPECT_FALSE(fs::exists(file)) << file;
}

// The run is interrupted in either pass, and in the middle of a record.
TEST_F(FilmDepths, AnInterruptedRunGoesOnToTheSameTrack) {
    film();
    ASSERT_EQ(tests::valueOf(make()), FilmDepth::Written);
    EXPECT_FALSE(fs::exists(part_));
    const std::string whole = media::readBytes(out_);
    fs::remove(out_);
    for (const int reports : {3, 6}) {
        EXPECT_THROW((void)make(interruptedAfter(reports)), Interrupted);
        EXPECT_FALSE(fs::exists(out_));
        fs::resize_file(part_, fs::file_size(part_) - 1000); // half of the last record
        int more = 0;
        ASSERT_TRUE(make({.progress = [&](double) { ++more; }}));
        EXPECT_EQ(more, 2 * kFrames / 2 - (reports - 1)) << "what is there is not made again";
        EXPECT_FALSE(fs::exists(part_));
        EXPECT_TRUE(media::readBytes(out_) == whole);
        fs::remove(out_);
    }
    // Records of other options would be mixed with the new ones.
    EXPECT_THROW((void)make(interruptedAfter(3)), Interrupted);
    int all = 0;
    ASSERT_TRUE(make({.height_m = 2, .progress = [&](double) { ++all; }}));
    EXPECT_EQ(all, 2 * kFrames / 2);
}

} // namespace
} // namespace shoal::depth
