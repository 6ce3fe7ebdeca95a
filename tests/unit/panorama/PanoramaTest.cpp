// Photos grown to environments: the place of the light, straight lines, and how the ends meet.
#include "engine/panorama/Panorama.h"
#include "engine/core/Random.h"
#include "engine/math/Quantile.h"
#include "engine/panorama/Steps.h"
#include "tests/bench/panorama/Scenes.h"
#include "tests/unit/media/TestFiles.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace shoal::panorama {
namespace {

// Returns a dusk sky with a clipped disc, and black pillars from top to bottom, 10 wide, at these columns.
ImageRgb8 dusk(int width, int height, double lightX, double lightY, double radius,
               const std::vector<int>& pillars = {}) {
    ImageRgb8 picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double high = 1 - static_cast<double>(y) / height;
            uint8_t* to = picture.at(x, y);
            to[0] = static_cast<uint8_t>(90 + 60 * high + 20 * std::sin(x * 0.05 + y * 0.11));
            to[1] = static_cast<uint8_t>(80 + 30 * high);
            to[2] = static_cast<uint8_t>(70 + 70 * high + 15 * std::sin(x * 0.031 - y * 0.07));
            if (std::hypot(x + 0.5 - lightX, y + 0.5 - lightY) < radius) std::fill_n(to, 3, uint8_t{255});
            for (const int at : pillars)
                if (x >= at && x < at + 10) std::fill_n(to, 3, uint8_t{12});
        }
    return picture;
}

// Returns the picture's values from 0 to 1.
cv::Mat colours(const ImageRgb8& picture) {
    cv::Mat coded;
    media::matOf(picture).convertTo(coded, CV_32F, 1 / 255.0);
    return coded;
}

TEST(FindLight, DiscIsFoundWithinATexel) {
    for (const glm::dvec2 at : {glm::dvec2(300, 200), {77.5, 40.25}, {560, 333.3}, {8, 8}}) {
        const MainLight found = findMainLight(colours(dusk(640, 480, at.x, at.y, 7)));
        EXPECT_NEAR(found.place.x, at.x, 0.5);
        EXPECT_NEAR(found.place.y, at.y, 0.5);
        EXPECT_NEAR(found.radius_px, 7, 0.5);
    }
}

TEST(Lens, ThereAndBack) {
    const Lens lens = Lens::make(800, 600, 1.2);
    for (double x = 5; x < 800; x += 61)
        for (double y = 5; y < 600; y += 47) {
            const double lon = lens.longitudeOf(x), lat = lens.latitudeOf(lon, y);
            EXPECT_NEAR(lens.columnOf(lon), x, 1e-9);
            EXPECT_NEAR(lens.rowOf(lon, lat), y, 1e-9);
        }
    EXPECT_NEAR(lens.rowOf(0.5, lens.latitude), 0, 1e-9); // the top edge is one parallel
    EXPECT_NEAR(lens.rowOf(0, 0.2), 300 - lens.focal_px * std::tan(0.2), 1e-9); // exact in the middle
}

// The mth harmonic of the rim falls as (tan(c/2) / tan(c0/2))^m.
TEST(PolarCaps, HarmonicsFallAsLaplaceWants) {
    const int width = 512, height = 256, edge = 64;
    cv::Mat sphere(height, width, CV_32FC3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double lon = (x + 0.5) / width * 2 * std::numbers::pi;
            const double value = y < edge ? 0 : 0.5 + 0.2 * std::cos(lon) + 0.1 * std::cos(3 * lon);
            sphere.at<cv::Vec3f>(y, x) = cv::Vec3f::all(static_cast<float>(value));
        }
    fillPolarCap(sphere, edge, PolarCap::Sky);
    const double inner =
        edge + 5 * height / 180; // as the header says: it fades in over the ring's first 5 degrees
    const double rim = std::tan((inner + 0.5) / height * std::numbers::pi / 2);
    for (const int y : {3, 20, 50}) {
        const double fall = std::tan((y + 0.5) / height * std::numbers::pi / 2) / rim;
        for (int x = 0; x < width; x += 37) {
            const double lon = (x + 0.5) / width * 2 * std::numbers::pi;
            const double expected =
                0.5 + 0.2 * fall * std::cos(lon) + 0.1 * std::pow(fall, 3) * std::cos(3 * lon);
            EXPECT_NEAR(sphere.at<cv::Vec3f>(y, x)[1], expected, 1e-4) << x << "," << y;
        }
    }
}

// A ground of blots goes on to the nadir with its own contrast, and no part of it is another's copy, straight
// or mirrored.
TEST(PolarCaps, GroundKeepsItsGrainAndDoesNotRepeat) {
    const int width = 1024, height = 512, edge = 150; // a rim 53 degrees from the nadir
    cv::Mat sphere(height, width, CV_32FC3), grain(height, width, CV_32F);
    cv::RNG dice(5);
    dice.fill(grain, cv::RNG::NORMAL, 0, 1);
    cv::GaussianBlur(grain, grain, {}, 3);
    cv::Scalar mean, spread;
    cv::meanStdDev(grain, mean, spread);
    grain = (grain - mean) * (0.04 / spread[0]) + 0.5;
    cv::merge(std::array{grain, grain, grain}, sphere);
    fillPolarCap(sphere, edge, PolarCap::Ground);

    // The plane below, from 1 to the left to 1 to the right, in units of the height above it.
    const int side = 256;
    cv::Mat column(side, side, CV_32F), row(column.size(), CV_32F), plane, grey;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double right = 2.0 * (x + 0.5) / side - 1, ahead = 2.0 * (y + 0.5) / side - 1;
            const double lon = std::atan2(right, ahead), away = std::atan(std::hypot(right, ahead));
            column.at<float>(y, x) = static_cast<float>((lon / (2 * std::numbers::pi) + 0.5) * width - 0.5);
            row.at<float>(y, x) = static_cast<float>(away / std::numbers::pi * height - 0.5);
        }
    cv::remap(sphere, plane, column, row, cv::INTER_LINEAR, cv::BORDER_WRAP);
    cv::extractChannel(plane, grey, 1);
    cv::Mat blurred;
    cv::GaussianBlur(grey, blurred, {}, 20);
    grey -= blurred;
    cv::meanStdDev(grey, mean, spread);
    // The part of 0.04 that is finer than the two blurs: 0.022 where the square itself is laid there,
    // unblended.
    EXPECT_NEAR(spread[0], 0.022, 0.005);

    const cv::Mat piece = grey(cv::Rect(100, 100, 64, 64));
    for (const auto& [turn, name] :
         {std::pair{2, "straight"}, {0, "upside down"}, {1, "mirrored"}, {-1, "both"}}) {
        cv::Mat sought = piece.clone(), match;
        if (turn != 2) cv::flip(piece, sought, turn);
        cv::matchTemplate(grey, sought, match, cv::TM_CCOEFF_NORMED);
        if (turn == 2) match(cv::Rect(92, 92, 17, 17)) = 0; // itself
        double maximum = 0;
        cv::minMaxLoc(match, nullptr, &maximum);
        EXPECT_LT(maximum, 0.8) << name;
    }
}

// Absolute differences of luminance between horizontal neighbours.
struct WrapDiscontinuity {
    double wrapStep = 0;  // maximum between the last column and the first
    double usualStep = 0; // 90th percentile of all others
};

WrapDiscontinuity wrapDiscontinuity(const cv::Mat& ring) {
    cv::Mat grey;
    cv::cvtColor(ring, grey, cv::COLOR_RGB2GRAY);
    const cv::Mat steps = cv::abs(grey.colRange(1, grey.cols) - grey.colRange(0, grey.cols - 1));
    const cv::Mat wrap = cv::abs(grey.col(0) - grey.col(grey.cols - 1));
    std::vector<float> all(steps.begin<float>(), steps.end<float>());
    WrapDiscontinuity found{.usualStep = static_cast<double>(math::quantile(all, 0.9))};
    cv::minMaxLoc(wrap, nullptr, &found.wrapStep);
    return found;
}

// The ends differ in colour and in the horizon's height; both meet.
TEST(WrapBlend, EndsMeet) {
    cv::Mat ring(200, 720, CV_32FC3);
    for (int y = 0; y < ring.rows; ++y)
        for (int x = 0; x < ring.cols; ++x) {
            const double horizon = 95 + 10.0 * x / ring.cols;
            const double value =
                (y < horizon ? 0.7 : 0.25) + 0.1 * x / ring.cols + 0.03 * std::sin(x * 0.7 + y * 0.9);
            ring.at<cv::Vec3f>(y, x) = cv::Vec3f::all(static_cast<float>(value));
        }
    const WrapDiscontinuity before = wrapDiscontinuity(ring);
    const cv::Mat middle = ring.col(360).clone();
    blendWrapAround(ring);
    const WrapDiscontinuity after = wrapDiscontinuity(ring);
    EXPECT_GT(before.wrapStep, 2 * before.usualStep);
    EXPECT_LE(after.wrapStep, after.usualStep);
    EXPECT_EQ(cv::norm(ring.col(360), middle, cv::NORM_INF), 0); // far from the ends nothing changes
    // The horizon is one step still, not two half ones: at both ends it crosses the middle once, at one
    // height.
    for (const int x : {0, 719}) {
        int crossings = 0, at = 0;
        for (int y = 1; y < ring.rows; ++y)
            if ((ring.at<cv::Vec3f>(y - 1, x)[0] > 0.52f) != (ring.at<cv::Vec3f>(y, x)[0] > 0.52f))
                ++crossings, at = y;
        EXPECT_EQ(crossings, 1);
        EXPECT_NEAR(at, 100, 2);
    }
}

TEST(Panorama, WrapStepIsNoStrongerThanThePicturesOwnGradients) {
    const bench::Scene scene = bench::forest(480, 360);
    cv::Mat ring = colours(scene.photo);
    blendWrapAround(ring);
    const WrapDiscontinuity seam = wrapDiscontinuity(ring);
    EXPECT_LE(seam.wrapStep, seam.usualStep);
    const auto grown = tests::valueOf(panoramaFromPhoto(scene.photo, {.fov_deg = bench::kSceneFov_deg}));
    // The light is wider than 2 degrees and has a ragged edge.
    EXPECT_LT(glm::distance(grown.lightInPhoto, scene.light) / 480 * bench::kSceneFov_deg, 0.5);
}

// Middle of the brightest texels of the columns around the middle.
glm::dvec2 brightest(const ImageRgb8& picture) {
    glm::dvec2 sum(0);
    double count = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            if (picture.at(x, y)[1] > 235) sum += glm::dvec2(x + 0.5, y + 0.5), ++count;
    return sum / count;
}

TEST(Panorama, LightStandsInTheMiddleAtItsOwnHeight) {
    for (const double x : {60.0, 300.0}) {
        const auto grown = tests::valueOf(panoramaFromPhoto(dusk(480, 360, x, 100, 9), {.fov_deg = 60}));
        const ImageRgb8& out = grown.latLong;
        ASSERT_EQ(out.width, 2 * out.height);
        const glm::dvec2 at = brightest(out);
        EXPECT_NEAR(at.x, out.width / 2.0, 1) << x;
        const Lens lens = Lens::make(480, 360, 60 * kRadiansPerDegree);
        const double latitude = lens.latitudeOf(lens.longitudeOf(x), 100);
        // Within a texel, and half a degree for the disc's middle, which is not the middle of its angles.
        EXPECT_NEAR(90 - at.y / out.height * 180, latitude / kRadiansPerDegree, 0.5 + 180.0 / out.height)
            << x;
        EXPECT_NEAR(grown.lightLatitude_deg, latitude / kRadiansPerDegree, 0.2);
    }
}

// Pillars stand beside the light and across the picture; in every row of the ring the edge of each lies
// where the others' mean is.
TEST(Panorama, PillarsStayUpright) {
    const int width = 640;
    const auto grown = tests::valueOf(
        panoramaFromPhoto(dusk(width, 480, 300, 170, 9, {60, 250, 340, 560}), {.fov_deg = 65}));
    const ImageRgb8& out = grown.latLong;
    // Dark runs, followed up and down from the horizon.
    const int middle = out.height / 2, reach = static_cast<int>(18.0 / 180 * out.height);
    const auto dark = [&](int x, int y) { return out.at((x + out.width) % out.width, y)[0] < 60; };
    int pillars = 0;
    for (int x = 0; x < out.width; ++x) {
        if (!dark(x, middle) || dark(x - 1, middle)) continue;
        ++pillars;
        const auto edgeAt = [&](int y) {
            int at = x;
            while (dark(at, y) && at > x - 100) --at;
            while (!dark(at, y) && at < x + 100) ++at;
            return at;
        };
        for (int y = middle - reach; y <= middle + reach; ++y) EXPECT_NEAR(edgeAt(y), x, 1) << "row " << y;
    }
    EXPECT_EQ(pillars, 4);
}

// Carved to the poles the photo's first and last row lie there; its middle is that of the band.
TEST(Panorama, FullReachesBothPolesAndKeepsTheMiddle) {
    const ImageRgb8 photo = dusk(480, 360, 240, 100, 9);
    const auto band = tests::valueOf(panoramaFromPhoto(photo, {.fov_deg = 60})).latLong;
    const auto full = tests::valueOf(panoramaFromPhoto(photo, {.fov_deg = 60, .full = true})).latLong;
    ASSERT_EQ(full.width, band.width);
    ASSERT_EQ(full.width, 2 * full.height);
    for (int x = 0; x < full.width; ++x) {
        EXPECT_NEAR(full.at(x, 0)[1], photo.at(0, 0)[1], 1) << x;
        EXPECT_NEAR(full.at(x, full.height - 1)[1], photo.at(0, 359)[1], 1) << x;
    }
    // Halfway from the horizon to the light, 10.9 degrees high, and as far from what is stretched as can be.
    // Rows of the map are a quarter of a degree, so there may be a shift of half of that.
    const int y = static_cast<int>((90 - 5.5) / 180 * full.height);
    for (int x = full.width / 4; x < full.width * 3 / 4; ++x)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(full.at(x, y)[c], band.at(x, y)[c], 2) << x;
    for (const double at : {1.0, 63.0}) // a light in a corner has nothing above it or below
        EXPECT_TRUE(panoramaFromPhoto(dusk(64, 48, at, at * 47 / 63, 4), {.fov_deg = 100, .full = true}));
}

TEST(Panorama, SameBytesTwice) {
    const ImageRgb8 photo = bench::forest(320, 240).photo;
    const auto a = panoramaFromPhoto(photo, {}), b = panoramaFromPhoto(photo, {});
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->latLong.pixels, b->latLong.pixels);
}

TEST(Panorama, ProgressRisesToOne) {
    std::vector<double> shares;
    ASSERT_TRUE(
        panoramaFromPhoto(dusk(200, 150, 60, 50, 5), {.progress = [&](double s) { shares.push_back(s); }}));
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_GT(shares.size(), 50u);
    EXPECT_EQ(shares.back(), 1);
}

TEST(Panorama, APictureThatCannotBeGrownIsRefused) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 400}, {400, 1}, {15, 15}, {16 * 9, 16}})
        EXPECT_FALSE(panoramaFromPhoto(ImageRgb8(width, height), {})) << width << "x" << height;
    for (const double fov : {0.0, 9.9, 151.0, std::nan("")})
        EXPECT_FALSE(panoramaFromPhoto(dusk(64, 48, 20, 9, 4), {.fov_deg = fov}));
}

TEST(Panorama, BlackStaysBlack) {
    for (const auto& [width, height] : {std::pair{16, 17}, {16, 128}, {128, 16}}) {
        const auto grown = panoramaFromPhoto(ImageRgb8(width, height), {});
        ASSERT_TRUE(grown) << width << "x" << height;
        EXPECT_EQ(grown->latLong.width, 2 * grown->latLong.height);
        EXPECT_EQ(*std::max_element(grown->latLong.pixels.begin(), grown->latLong.pixels.end()), 0);
    }
}

TEST(Panorama, LightInACornerAtEitherEndOfFieldsOfView) {
    EXPECT_TRUE(panoramaFromPhoto(dusk(64, 48, 1, 1, 4), {.fov_deg = kMinFov_deg}));
    EXPECT_TRUE(panoramaFromPhoto(dusk(64, 48, 63, 47, 4), {.fov_deg = kMaxFov_deg}));
}

// Odd files become photos like any other.
TEST(Panorama, SixteenBitsGreyAndAlpha) {
    const tests::ScratchFolder folder;
    for (const int type : {CV_8UC1, CV_8UC4, CV_16UC3}) {
        cv::Mat made(24, 32, type, cv::Scalar::all(CV_MAT_DEPTH(type) == CV_8U ? 100 : 25700));
        cv::rectangle(made, {20, 4, 4, 4}, cv::Scalar::all(CV_MAT_DEPTH(type) == CV_8U ? 255 : 65535),
                      cv::FILLED);
        ASSERT_TRUE(cv::imwrite((folder / "odd.png").string(), made));
        const auto photo = tests::valueOf(media::readPicture(folder / "odd.png"));
        const auto grown = tests::valueOf(panoramaFromPhoto(photo, {}));
        EXPECT_NEAR(grown.lightInPhoto.x, 22, 0.5) << type;
        EXPECT_NEAR(grown.latLong.at(0, grown.latLong.height / 2)[0], 100, 12) << type;
    }
}

TEST(Panorama, HighDynamicRangeIsKept) {
    ImageRgbF photo(160, 120);
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x) {
            const bool sun = std::hypot(x + 0.5 - 100, y + 0.5 - 40) < 5;
            std::fill_n(photo.at(x, y), 3, sun ? 20000.0f : 0.3f);
        }
    const auto grown = tests::valueOf(panoramaFromPhoto(photo, {}));
    const auto& pixels = grown.latLong.pixels;
    const float maximum = *std::max_element(pixels.begin(), pixels.end());
    EXPECT_GT(maximum, 15000.0f);
    EXPECT_LT(maximum, 20001.0f);
    EXPECT_TRUE(
        std::all_of(pixels.begin(), pixels.end(), [](float p) { return std::isfinite(p) && p >= 0; }));
}

TEST(PartialPanorama, PartLiesWhereItSays) {
    ImageRgb8 part(512, 256);
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 512; ++x) part.at(x, y)[0] = static_cast<uint8_t>(x / 4), part.at(x, y)[1] = 200;
    const auto placed = tests::valueOf(completePanorama(part, {0.25, 0.25, 0.75, 0.75}));
    ASSERT_EQ(placed.width, 1024);
    ASSERT_EQ(placed.height, 512);
    for (int x = 0; x < 512; x += 31) EXPECT_EQ(placed.at(256 + x, 256)[0], x / 4);
    for (int x = 0; x < 1024; ++x) { // no step at the sides, nor where the gap is closed
        EXPECT_LE(std::abs(placed.at(x, 256)[0] - placed.at((x + 1) % 1024, 256)[0]), 3) << x;
        EXPECT_NEAR(placed.at(x, 256)[1], 200, 1);
    }
    for (const int y : {0, 511}) EXPECT_NEAR(placed.at(100, y)[1], 200, 4); // sky and ground are filled
    ImageRgb8 lit = evenFrame(256, 128, 60, 60, 60); // one light, and no second one in the gap
    for (int y = 50; y < 60; ++y) std::fill_n(lit.at(120, y), 30, uint8_t{255});
    const auto one = tests::valueOf(completePanorama(lit, {0.25, 0.25, 0.75, 0.75}));
    for (int y = 0; y < one.height; ++y)
        for (int x = 0; x < one.width / 4; ++x) {
            ASSERT_LT(one.at(x, y)[0], 100);
            ASSERT_LT(one.at(one.width - 1 - x, y)[0], 100);
        }
    for (const PanoramaPart& odd : {PanoramaPart{0, 0.8, 1, 1}, PanoramaPart{0, 0, 1, 0.2},
                                    PanoramaPart{0.99, 0.4, 1, 0.6}, PanoramaPart{0, 0, 1, 1}})
        EXPECT_TRUE(completePanorama(part, odd));
    EXPECT_FALSE(completePanorama(ImageRgb8(1, 1), {0.5, 0.5, 0.5001, 0.5001}));
}

struct Case {
    cv::Mat colours, weight;
};

Case noise(int width, int height, uint64_t seed) {
    Case made{cv::Mat(height, width, CV_32FC3), cv::Mat(height, width, CV_32F)};
    Random random(seed);
    for (float& value : cv::Mat_<float>(made.colours.reshape(1))) value = random.unit();
    for (float& value : cv::Mat_<float>(made.weight)) value = 0.3f * random.unit() - 0.1f;
    return made;
}

double apart(const cv::Mat& c, int xa, int ya, int xb, int yb) {
    return cv::norm(c.at<cv::Vec3f>(ya, xa) - c.at<cv::Vec3f>(yb, xb), cv::NORM_L1);
}

// Returns the cost of the pixels that removing the seam brings together, without the search's tables.
double costOf(const Case& of, const std::vector<int>& seam) {
    double sum = 0;
    for (int y = 0; y < of.colours.rows; ++y) {
        const int x = seam[y];
        const int left = std::max(x - 1, 0), right = std::min(x + 1, of.colours.cols - 1);
        sum += apart(of.colours, left, y, right, y) + of.weight.at<float>(y, x);
        if (y == 0) continue;
        const int before = seam[y - 1];
        // The pixel above stays, and gets the neighbour on the side that the seam came from below it.
        if (before < x) sum += apart(of.colours, x, y - 1, left, y);
        if (before > x) sum += apart(of.colours, x, y - 1, right, y);
    }
    return sum;
}

double cheapestOfAll(const Case& of) {
    double minimum = std::numeric_limits<double>::max();
    std::vector<int> seam;
    const std::function<void()> grow = [&] {
        if (static_cast<int>(seam.size()) == of.colours.rows) {
            minimum = std::min(minimum, costOf(of, seam));
            return;
        }
        for (int x = 0; x < of.colours.cols; ++x) {
            if (!seam.empty() && std::abs(x - seam.back()) > 1) continue;
            seam.push_back(x);
            grow();
            seam.pop_back();
        }
    };
    grow();
    return minimum;
}

TEST(SeamSearch, CheapestOfAllSeams) {
    uint64_t seed = 0;
    for (const auto& [width, height] : {std::pair{6, 7}, {5, 8}, {2, 9}, {1, 5}, {7, 1}, {3, 2}})
        for (int k = 0; k < 12; ++k) {
            const Case made = noise(width, height, ++seed);
            const std::vector<int> seam = minSeam(made.colours, made.weight);
            ASSERT_EQ(static_cast<int>(seam.size()), height);
            for (size_t y = 0; y < seam.size(); ++y) {
                EXPECT_GE(seam[y], 0);
                EXPECT_LT(seam[y], width);
                EXPECT_LE(std::abs(seam[y] - seam[y ? y - 1 : 0]), 1) << "row " << y;
            }
            // Sums of at most 9 rows of numbers below 7 in single precision.
            EXPECT_NEAR(costOf(made, seam), cheapestOfAll(made), 1e-5)
                << width << "x" << height << " seed " << seed;
        }
}

TEST(SeamInsertion, MapsNeverFallAndKeepTheirEnds) {
    const Case made = noise(30, 20, 3);
    const cv::Mat map = seamInsertionMap(made.colours, made.weight, 100);
    ASSERT_EQ(map.cols, 100);
    for (int y = 0; y < map.rows; ++y)
        for (int x = 1; x < map.cols; ++x) ASSERT_GE(map.at<float>(y, x), map.at<float>(y, x - 1));
    std::vector<float> even(map.begin<float>(), map.begin<float>() + map.cols);
    const float first = even.front(), last = even.back();
    smoothMap(even, 5);
    EXPECT_FLOAT_EQ(even.front(), first);
    EXPECT_FLOAT_EQ(even.back(), last);
    EXPECT_TRUE(std::is_sorted(even.begin(), even.end()));
}

// Flat to the left, noise to the right: the flat half takes the growth.
TEST(SeamInsertion, IsPlacedWhereThePictureIsFlat) {
    Case made = noise(40, 30, 5);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 20; ++x) made.colours.at<cv::Vec3f>(y, x) = cv::Vec3f::all(0.5f);
    made.weight.setTo(0);
    const cv::Mat_<float> map = seamInsertionMap(made.colours, made.weight, 100);
    const auto flat = std::count_if(map.begin(), map.end(), [](float at) { return at < 19.5f; });
    EXPECT_GT(flat, 70 * map.rows); // of 60 new columns nearly all; it began with 20
}

TEST(SeamInsertion, NothingWithinTheStrip) {
    const Case made = noise(40, 10, 9);
    cv::Mat weight(10, 40, CV_32F, cv::Scalar(0));
    for (int y = 0; y < 10; ++y)
        for (int x = 15; x < 25; ++x) weight.at<float>(y, x) = 10;
    const cv::Mat map = seamInsertionMap(made.colours, weight, 120);
    for (int y = 0; y < 10; ++y)
        for (int x = 1; x < 120; ++x)
            if (map.at<float>(y, x - 1) >= 15 && map.at<float>(y, x) <= 24) {
                EXPECT_FLOAT_EQ(map.at<float>(y, x) - map.at<float>(y, x - 1), 1);
            }
}

} // namespace
} // namespace shoal::panorama
