#include "engine/camera/CameraResponse.h"
#include "engine/core/Random.h"
#include "tests/Test.h"

namespace shoal::camera {
namespace {

// Frames with a known blur, known noise, known levels and known chroma.
struct Film {
    int width = 800, height = 256; // pixels; the estimator reads every row of the middle half
    float blur_texels = 1;
    float softer = 0;     // additional blur of four edges in five, as of things without sharp edges
    float noise = 0;      // standard deviation, in values of 255
    float noiseSlope = 0; // increase of it from black to white, in values of 255
    int grain_texels = 1; // squares that share their noise
    float black = 20, white = 235;
};

float gaussian(Random& random) { // Box and Muller 1958
    const float u = std::max(random.unit(), 1e-7f);
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi_v<float> * random.unit());
}

// Returns a frame of tilted bars (up to 20 degrees) 40 texels apart, of random greys with a tint. Each row is
// stretched by its latitude, so that the blur is the same angle everywhere.
ImageRgb8 filmed(const Film& film, uint64_t seed = 1) {
    ImageRgb8 frame(film.width, film.height);
    Random random(seed, 3);
    constexpr int kApart = 40;
    const int bars = film.width / kApart;
    std::vector<float> greys, blues, reds, leans, places;
    for (int i = 0; i < bars; ++i) {
        greys.push_back(random.between(film.black, film.white));
        blues.push_back(random.between(-25, 25));
        reds.push_back(random.between(-25, 25));
        leans.push_back(random.between(-0.36f, 0.36f));
        places.push_back(static_cast<float>((i + 1) * kApart) + random.between(-4, 4));
    }
    const auto shown = [&](const std::vector<float>& of, float x, float y) {
        const float latitude = (0.5f - y / static_cast<float>(film.height)) * std::numbers::pi_v<float>;
        const int near = static_cast<int>(x) / kApart;
        float value = of[static_cast<size_t>(std::clamp(near - 1, 0, bars - 1))];
        for (int i = std::max(near - 1, 0); i < std::min(near + 2, bars - 1); ++i) {
            const auto n = static_cast<size_t>(i);
            const float blur = i % 5 ? std::hypot(film.blur_texels, film.softer) : film.blur_texels;
            const float sigma = std::max(blur / std::cos(latitude), 1e-3f);
            const float at = places[n] + leans[n] * (std::fmod(y, 16.0f) - 8);
            const float beyond =
                std::erf((x - at) * std::cos(std::atan(leans[n])) / sigma * std::numbers::sqrt2_v<float> / 2);
            value += (of[n + 1] - of[n]) * (0.5f + 0.5f * beyond);
        }
        return value;
    };
    // Bars are tilted so little that their positions within a row count as even.
    const auto mean = [&](const std::vector<float>& of, int x, int y) {
        float sum = 0;
        for (const float part : {0.1f, 0.3f, 0.5f, 0.7f, 0.9f})
            sum += shown(of, static_cast<float>(x) + part, static_cast<float>(y) + 0.5f);
        return sum / 5;
    };
    // Colours also change in bands down the frame.
    const auto meanTint = [&](const std::vector<float>& of, int x, int y) {
        const float turn = 2 * std::numbers::pi_v<float> / 11, top = turn * static_cast<float>(y),
                    bottom = turn * static_cast<float>(y + 1);
        return mean(of, x, y) + 15 * (std::cos(top) - std::cos(bottom)) / (bottom - top);
    };
    std::vector<float> grains(static_cast<size_t>(film.width));
    for (int y = 0; y < film.height; ++y) {
        if (y % film.grain_texels == 0)
            for (int x = 0; x < film.width; ++x)
                grains[static_cast<size_t>(x)] =
                    x % film.grain_texels ? grains[static_cast<size_t>(x - 1)] : gaussian(random);
        for (int x = 0; x < film.width; ++x) {
            float luma = mean(greys, x, y);
            luma += grains[static_cast<size_t>(x)] * (film.noise + film.noiseSlope * luma / 255);
            const float blueLess = meanTint(blues, x, y), redLess = meanTint(reds, x, y);
            const float r = luma + redLess, b = luma + blueLess;
            const float g = (luma - 0.2126f * r - 0.0722f * b) / 0.7152f;
            uint8_t* to = frame.at(x, y);
            const float values[3] = {r, g, b};
            for (int k = 0; k < 3; ++k)
                to[k] = static_cast<uint8_t>(std::clamp(values[k] + 0.5f, 0.0f, 255.0f));
        }
    }
    return frame;
}

CameraResponseEstimate estimated(const ImageRgb8& frame) {
    return CameraResponseEstimator().estimate(viewOf(frame));
}

// Found within 12 % and 0.12 texels: edges' tails are cut at a fixed share, texels are few, and with noise
// the sharpest fifth of the edges lies below their mean. Strong noise breaks off the tails of soft edges.
TEST(EstimateCameraResponse, BlurIsFoundAgain) {
    for (const float blur : {0.3f, 0.6f, 1.0f, 1.5f, 2.2f})
        for (const float noise : {0.0f, 1.0f, 3.0f}) {
            const CameraResponseEstimate found = estimated(filmed({.blur_texels = blur, .noise = noise}));
            EXPECT_GE(found.edges, kFewEdges) << blur << " noise " << noise;
            EXPECT_NEAR(found.response.blur_texels, blur, 0.12f + (noise > 2 ? 0.25f : 0.12f) * blur)
                << "noise " << noise;
        }
}

// The camera's blur is that of the sharpest edges; things that are soft themselves do not count.
TEST(EstimateCameraResponse, SoftThingsDoNotMakeASoftCamera) {
    for (const float blur : {0.2f, 0.5f, 0.8f})
        for (const float noise : {0.0f, 1.0f}) {
            const CameraResponseEstimate found =
                estimated(filmed({.blur_texels = blur, .softer = 1.5f, .noise = noise}));
            EXPECT_NEAR(found.response.blur_texels, blur, 0.12f + 0.12f * blur) << "noise " << noise;
        }
}

// Found within 15 % and a third of a value of 255: some blocks hold edges, and the flattest thirtieth counts.
TEST(EstimateCameraResponse, NoiseIsFoundAgain) {
    for (const float noise : {0.0f, 1.0f, 2.5f, 6.0f})
        for (const int grain : {1, 2}) {
            const auto found = estimated(filmed({.blur_texels = 1, .noise = noise, .grain_texels = grain}));
            for (size_t band = 2; band < 6; ++band) { // greys lie in these
                ASSERT_GE(found.unclippedBlocks[band], kFewBlocks) << band;
                const float fine = 255 * found.response.fineNoise[band],
                            coarse = 255 * found.response.coarseNoise[band];
                if (grain == 1) {
                    EXPECT_NEAR(fine, noise, 0.33f + 0.15f * noise) << band;
                    // The remainder of fine noise has been taken away.
                    EXPECT_LT(coarse, 0.3f + 0.2f * noise) << band;
                } else {
                    // Squares of 2 x 2 keep their noise in the mean. A block has a quarter as many: a fifth.
                    EXPECT_NEAR(std::hypot(coarse, fine / 2), noise, 0.33f + 0.2f * noise) << band;
                }
            }
        }
}

TEST(EstimateCameraResponse, NoiseIsFoundByBrightness) {
    const CameraResponse response = estimated(filmed({.noise = 1, .noiseSlope = 6})).response;
    for (size_t band = 1; band < 7; ++band) {
        const float brightness = (static_cast<float>(band) + 0.5f) / kBrightnesses;
        EXPECT_NEAR(255 * response.fineNoise[band], 1 + 6 * brightness, 0.33f + 0.2f * (1 + 6 * brightness))
            << band;
    }
}

TEST(EstimateCameraResponse, LevelsAreFoundAgain) {
    const CameraResponse response = estimated(filmed({.black = 40, .white = 200})).response;
    for (int c = 0; c < 3; ++c) { // of 25 bars; tints reach 25 further
        EXPECT_GT(255 * response.black[c], 10);
        EXPECT_LT(255 * response.black[c], 70);
        EXPECT_GT(255 * response.white[c], 170);
        EXPECT_LT(255 * response.white[c], 230);
    }
}

TEST(EstimateCameraResponse, AnEvenFrameSaysNothing) {
    const CameraResponseEstimate found = estimated(evenFrame(512, 256, 100, 100, 100));
    EXPECT_EQ(found.edges, 0);
    EXPECT_EQ(found.response.blur_texels, 0);
    for (const float noise : found.response.fineNoise) EXPECT_EQ(noise, 0);
}

TEST(EstimateCameraResponse, StaysFiniteWhateverComes) {
    Random random(7, 1);
    ImageRgb8 noise(300, 150), tiny(20, 10), empty(0, 0), hard(512, 256);
    for (uint8_t& value : noise.pixels) value = static_cast<uint8_t>(random.between(0, 255.9f));
    for (size_t i = 0; i < hard.pixels.size(); ++i) hard.pixels[i] = (i / 3 / 8) % 2 ? 255 : 0;
    for (const ImageRgb8* frame : {&noise, &tiny, &empty, &hard}) {
        const CameraResponse response = estimated(*frame).response;
        EXPECT_TRUE(std::isfinite(response.blur_texels));
        EXPECT_GE(response.blur_texels, 0);
        for (size_t band = 0; band < kBrightnesses; ++band) {
            EXPECT_TRUE(std::isfinite(response.fineNoise[band]));
            EXPECT_TRUE(std::isfinite(response.coarseNoise[band]));
        }
    }
}

TEST(EstimateCameraResponse, ReadsBlueFirstFramesAndPartsOfFrames) {
    const ImageRgb8 frame = filmed({.width = 512, .height = 256, .noise = 2});
    ImageRgb8 other(frame.width + 10, frame.height + 4);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
            for (int c = 0; c < 3; ++c) other.at(x + 4, y + 2)[c] = frame.at(x, y)[2 - c];
    CameraResponseEstimator estimator;
    const CameraResponse one = estimator.estimate(viewOf(frame)).response;
    const CameraResponse two =
        estimator.estimate({other.at(4, 2), frame.width, frame.height, 3 * other.width, true}).response;
    EXPECT_EQ(one.blur_texels, two.blur_texels);
    EXPECT_EQ(one.fineNoise, two.fineNoise);
    EXPECT_EQ(one.black, two.black);
}

TEST(CameraResponseOverTime, TakesTheFirstAndFollowsSlowly) {
    CameraResponseOverTime over;
    CameraResponseEstimate soft, sharp;
    soft.response.blur_texels = 2;
    soft.edges = sharp.edges = 100;
    sharp.response.blur_texels = 1;
    sharp.response.chromaTexels = {1, 1};
    over.follow(soft, 0);
    EXPECT_EQ(over.response().blur_texels, 2);
    EXPECT_EQ(over.response().chromaTexels, glm::ivec2(2)) << "as nearly all video";
    for (int frame = 0; frame < 300; ++frame) over.follow(sharp, 1 / 60.0f);
    EXPECT_NEAR(over.response().blur_texels, 1.1f, 0.01f) << "nine tenths there after five seconds";
    EXPECT_EQ(over.response().chromaTexels, glm::ivec2(1));
    over.follow(CameraResponseEstimate{}, 1000); // an even frame
    EXPECT_NEAR(over.response().blur_texels, 1.1f, 0.01f) << "no edges: no news";
}

constexpr float kSigma = 0.082f; // radians: 4.7 degrees

// Returns a frame bright ahead and black behind, through a lens that scatters a share of the light over
// kSigma: beside a straight edge this gives the normal distribution's integral.
ImageRgb8 edgeBehindALens(float share, float dark, float noise) {
    ImageRgb8 frame(1024, 512);
    Random random(5, 9);
    constexpr float kBright = 0.6f; // light
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
            const float ring = std::sin((static_cast<float>(y) + 0.5f) / 512 * std::numbers::pi_v<float>);
            const float longitude = (static_cast<float>(x) + 0.5f - 512) / 512 * std::numbers::pi_v<float>;
            const float away = (std::numbers::pi_v<float> / 2 - std::abs(longitude)) * ring; // inwards
            const float around =
                dark +
                (kBright - dark) * (0.5f + 0.5f * std::erf(away / kSigma / std::numbers::sqrt2_v<float>));
            const float light = (1 - share) * (away < 0 ? dark : kBright) + share * around;
            for (int c = 0; c < 3; ++c)
                frame.at(x, y)[c] = static_cast<uint8_t>(
                    std::clamp(255 * std::sqrt(light) + noise * gaussian(random) + 0.5f, 0.0f, 255.0f));
        }
    return frame;
}

Glare glowOf(const ImageRgb8& frame) {
    Glare glow;
    GlareFilter().make(viewOf(frame), glow);
    return glow;
}

// Within a fifth and half a percent: cells beside the edge have some of its light, noise adds its variance.
TEST(Glare, IsFoundBesideBrightThings) {
    for (const float share : {0.0f, 0.02f, 0.06f, 0.1f})
        for (const float noise : {0.0f, 3.0f})
            EXPECT_NEAR(glowOf(edgeBehindALens(share, 0, noise)).maxShare, share, 0.005f + 0.2f * share)
                << "noise " << noise;
}

TEST(Glare, IsOnlyABoundWhereNothingIsDark) {
    EXPECT_GT(glowOf(edgeBehindALens(0.02f, 0.2f, 0)).maxShare, 0.25f);
    EXPECT_EQ(glowOf(ImageRgb8(512, 256)).maxShare, 1) << "black: nothing is known";
    EXPECT_EQ(glowOf(ImageRgb8()).maxShare, 1);
}

// Stones and shadows in a meadow: each cell is bright, and small things in it are nearly black.
TEST(Glare, SmallDarkThingsBoundItBelowThatOfAUsualLens) {
    ImageRgb8 meadow(1024, 512);
    for (int y = 0; y < meadow.height; ++y)
        for (int x = 0; x < meadow.width; ++x) // three in eight texels are dark
            std::fill_n(meadow.at(x, y), 3, uint8_t(x % 8 < 3 ? 10 : 180));
    EXPECT_LT(glowOf(meadow).maxShare, 0.01f);
}

TEST(Glare, SpreadsLightOverFiveDegreesAndLosesNone) {
    ImageRgb8 frame(1024, 512);
    for (int y = 248; y < 264; ++y)
        for (int x = 1016; x < 1032; ++x) // over the seam
            std::fill_n(frame.at(x % 1024, y), 3, uint8_t{255});
    const Glare glow = glowOf(frame);
    double sum = 0, square = 0;
    for (int y = 0; y < kGlareHeight; ++y)
        for (int x = 0; x < kGlareWidth; ++x) {
            const double light = static_cast<double>(glow.spread.at(x, y)[1]);
            const double away = x < kGlareWidth / 2 ? x + 0.5 : x + 0.5 - kGlareWidth; // from the seam
            sum += light;
            square += light * away * away;
        }
    EXPECT_NEAR(sum, 4, 0.01) << "a square of two cells by two";
    // Two cells side by side, 1/4 cells^2, and four means over three, 8/3.
    EXPECT_NEAR(square / sum, 1 / 4.0 + 8 / 3.0, 0.05);
}

TEST(CameraResponseOverTime, BelievesTheLeastGlareOfAllFrames) {
    CameraResponseOverTime over;
    over.follow(CameraResponseEstimate{}, 0);
    over.followGlare(0.4f, 0);
    EXPECT_EQ(over.response().glare, 0.03f) << "nothing dark was seen: as lenses are";
    for (int frame = 0; frame < 1200; ++frame) over.followGlare(frame == 3 ? 0.06f : 0.3f, 1 / 60.0f);
    EXPECT_NEAR(over.response().glare, 0.06f, 1e-3f);
}

} // namespace
} // namespace shoal::camera
