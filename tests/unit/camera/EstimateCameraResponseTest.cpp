// Tests that a known camera is found again in frames made with it.
#include "engine/camera/CameraResponse.h"
#include "MadeFilm.h"

#include <gtest/gtest.h>

namespace shoal::camera {
namespace {

CameraResponseEstimate estimated(const ImageRgb8& frame) {
    return CameraResponseEstimator().estimate(viewOf(frame));
}

class KnownBlur : public testing::TestWithParam<std::tuple<float, float>> {};

// Found within 12 % and 0.12 texels: edges' tails are cut at a fixed share, texels are few, and with noise
// the sharpest fifth of the edges lies below their mean. Strong noise breaks off the tails of soft edges.
TEST_P(KnownBlur, IsFoundAgain) {
    const auto [blur, noise] = GetParam();
    const CameraResponseEstimate found = estimated(filmed({.blur_texels = blur, .noise = noise}));
    EXPECT_GE(found.edges, kFewEdges);
    EXPECT_NEAR(found.response.blur_texels, blur, 0.12f + (noise > 2 ? 0.25f : 0.12f) * blur);
}
INSTANTIATE_TEST_SUITE_P(BlursAndNoises, KnownBlur,
                         testing::Combine(testing::Values(0.3f, 0.6f, 1.0f, 1.5f, 2.2f),
                                          testing::Values(0.0f, 1.0f, 3.0f)));

// The camera's blur is that of the sharpest edges; things that are soft themselves do not count.
TEST(EstimateCameraResponse, SoftThingsDoNotMakeASoftCamera) {
    for (const float blur : {0.2f, 0.5f, 0.8f})
        for (const float noise : {0.0f, 1.0f}) {
            const CameraResponseEstimate found =
                estimated(filmed({.blur_texels = blur, .softer = 1.5f, .noise = noise}));
            EXPECT_NEAR(found.response.blur_texels, blur, 0.12f + 0.12f * blur) << "noise " << noise;
        }
}

class KnownNoise : public testing::TestWithParam<std::tuple<float, int>> {};

// Found within 15 % and a third of a value of 255: some blocks hold edges, and the flattest thirtieth counts.
TEST_P(KnownNoise, IsFoundAgain) {
    const auto [noise, grain] = GetParam();
    const CameraResponseEstimate found =
        estimated(filmed({.blur_texels = 1, .noise = noise, .grain_texels = grain}));
    for (size_t band = 2; band < 6; ++band) { // greys lie in these
        ASSERT_GE(found.flatBlocks[band], kFewBlocks) << band;
        const float fine = 255 * found.response.fineNoise[band],
                    coarse = 255 * found.response.coarseNoise[band];
        const float bound = 0.33f + 0.15f * noise;
        if (grain == 1) {
            EXPECT_NEAR(fine, noise, bound) << band;
            EXPECT_LT(coarse, 0.3f + 0.2f * noise) << band; // what is left of fine noise has been taken away
        } else {
            // Squares of 2 x 2 keep their noise in the mean. A block has a quarter as many: a fifth.
            EXPECT_NEAR(std::sqrt(coarse * coarse + fine * fine / 4), noise, 0.33f + 0.2f * noise) << band;
        }
    }
}
INSTANTIATE_TEST_SUITE_P(NoisesAndGrains, KnownNoise,
                         testing::Combine(testing::Values(0.0f, 1.0f, 2.5f, 6.0f), testing::Values(1, 2)));

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
    ImageRgb8 frame(512, 256);
    std::fill(frame.pixels.begin(), frame.pixels.end(), uint8_t{100});
    const CameraResponseEstimate found = estimated(frame);
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

} // namespace
} // namespace shoal::camera
