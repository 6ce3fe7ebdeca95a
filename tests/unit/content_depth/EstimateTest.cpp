// The estimators of one frame, in a room of known size.
#include "content/make/depth/FrameRecord.h"
#include "content/make/depth/SphereSweep.h"
#include "content/make/depth/TrackFilter.h"
#include "tests/unit/content_depth/TestRoom.h"

#include <gtest/gtest.h>

namespace shoal::depth {
namespace {

light::FrameView frameViewOf(const ImageRgb8& picture) {
    return {picture.at(0, 0), picture.width, picture.height, ptrdiff_t{3} * picture.width, false};
}

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
    makeSweepImage(frameViewOf(room.seen({0, 0, 0}, 1024)), result.reference);
    result.images.resize(places.size());
    for (size_t i = 0; i < places.size(); ++i) {
        makeSweepImage(frameViewOf(room.seen(places[i], 1024)), result.images[i]);
        result.views.push_back({&result.images[i], glm::mat3(1), places[i], i % 2 == 1});
    }
    return result;
}

} // namespace

// This is the goal of the whole tool: it is confident of half at least, and of that four fifths are within 10
// %.
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
    StereoDepth().estimate(frameViewOf(left), frameViewOf(right), static_cast<double>(kBaseline_m),
                           kEstimateWidth, depth);
    const Shares shares = sharesOf(depth, room, {0, 0, 0});
    EXPECT_GT(shares.right, 0.8);
    EXPECT_GT(shares.confident, 0.5);
}

TEST(StereoDepth, OneEyeTwiceIsFarAway) {
    const ImageRgb8 left = TestRoom().seen({0, 0, 0}, 1024);
    DepthEstimate depth;
    StereoDepth().estimate(frameViewOf(left), frameViewOf(left), 0.064, kEstimateWidth, depth);
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
        const bool isWrong = i % 2 == 0;
        depth.inverse.push_back((isWrong ? 2.0f : 1.0f) / room.distance({0, 0, 0}, dir));
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

} // namespace shoal::depth
