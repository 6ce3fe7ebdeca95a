// Baselines of pyramids and of inverse tone mapping.
#include "engine/light/InverseToneMap.h"
#include "engine/math/Colour.h"
#include "tests/baselines/light/Baselines.h"

#include <gtest/gtest.h>

namespace shoal::light::baselines {
namespace {

FrameView viewOf(const ImageRgb8& frame, bool bgr = false) {
    return {frame.pixels.data(), frame.width, frame.height, ptrdiff_t{3} * frame.width, bgr};
}

ImageRgb8 filled(int width, int height, uint8_t red, uint8_t green, uint8_t blue) {
    ImageRgb8 frame(width, height);
    for (size_t i = 0; i < frame.pixels.size(); i += 3)
        frame.pixels[i] = red, frame.pixels[i + 1] = green, frame.pixels[i + 2] = blue;
    return frame;
}

TEST(PyramidBaselines, UniformFrameStaysInEveryLevel) {
    const glm::vec3 want = radianceFromDisplay(glm::vec3(200, 120, 40) / 255.0f);
    for (const auto& [width, height, bgr] :
         {std::tuple(2048, 1024, false), {2048, 1024, true}, {600, 300, true}}) {
        const ImageRgb8 frame =
            bgr ? filled(width, height, 40, 120, 200) : filled(width, height, 200, 120, 40);
        for (const PyramidMethod& method : pyramidMethods()) {
            RadiancePyramid pyramid;
            method.make(viewOf(frame, bgr), pyramid);
            ASSERT_EQ(pyramid.levels.back().width, 2) << method.label.name;
            for (const ImageRgbF& level : pyramid.levels)
                for (size_t i = 0; i < level.pixels.size(); ++i)
                    ASSERT_NEAR(level.pixels[i], want[static_cast<int>(i % 3)], 1e-5f) << method.label.name;
        }
    }
}

// A cap of 30 degrees about the zenith, a sixth of the rows, is (1 - cos 30) / 2 = 6.7 % of the sphere; plain
// means take it for 16.7 %. Where the frame is resampled, the
// edge moves by up to a row of 512.
TEST(PyramidBaselines, PlainMeansGiveTheZenithTooMuch) {
    ImageRgb8 frame = filled(2048, 1020, 0, 0, 0);
    for (int y = 0; y < 170; ++y) std::fill(frame.at(0, y), frame.at(0, y) + 3 * 2048, uint8_t{255});
    for (const PyramidMethod& method : pyramidMethods()) {
        RadiancePyramid pyramid;
        method.make(viewOf(frame), pyramid);
        const bool plain = method.label.name.starts_with("plain");
        EXPECT_NEAR(pyramid.levels.back().pixels[0] / 11.8f, plain ? 0.1667f : 0.0670f, 2e-3f)
            << method.label.name;
    }
}

float expanded(const InverseToneMapMethod& method, uint8_t value) {
    ImageRgb8 frame = filled(8, 4, value, value, value);
    frame.pixels[0] = frame.pixels[1] = frame.pixels[2] = 0; // the range of the picture: black to white
    frame.pixels[3] = frame.pixels[4] = frame.pixels[5] = 255;
    ImageRgbF out;
    method.expand(frame, out);
    return out.pixels.back();
}

TEST(InverseToneMapBaselines, KnownValues) {
    const float middle = 188.0f / 255; // sRGB 0.5029
    EXPECT_NEAR(expanded(thesisInverse(false), 188), radianceFromDisplay(glm::vec3(middle)).x, 1e-6f);
    EXPECT_NEAR(expanded(plainLinear(), 188), 0.5029f, 1e-4f);
    EXPECT_NEAR(expanded(thesisInverse(true), 188), (10 * std::pow(0.5029f, 10.0f) + 1.8f) * 0.5029f, 1e-3f);
    EXPECT_NEAR(expanded(akyuz(1), 188), 0.5029f, 1e-4f);
    EXPECT_NEAR(expanded(akyuz(2.2f), 188), std::pow(0.5029f, 2.2f), 1e-3f);
    EXPECT_NEAR(expanded(landis(), 128), 0.2159f, 1e-4f); // below the threshold: as decoded
    EXPECT_NEAR(expanded(landis(), 255), 10.0f, 1e-4f);
}

TEST(InverseToneMapBaselines, BrighterStaysBrighter) {
    ImageRgb8 frame(256, 128); // each level once a row
    for (size_t i = 0; i < frame.pixels.size(); ++i) frame.pixels[i] = static_cast<uint8_t>(i / 3 % 256);
    for (const InverseToneMapMethod& method : inverseToneMapMethods()) {
        if (method.label.source.starts_with("Rempel") || method.label.source.starts_with("Kovaleski") ||
            method.label.source.starts_with("Banterle"))
            continue; // by place too
        ImageRgbF out;
        method.expand(frame, out);
        for (size_t value = 1; value < 256; ++value)
            EXPECT_GT(out.pixels[3 * value], out.pixels[3 * value - 3]) << method.label.name << ", " << value;
    }
}

// Computed by hand: 30 grey pixels, a black and a white one.
TEST(InverseToneMapBaselines, MasiasPowers) {
    ImageRgb8 frame = filled(8, 4, 188, 188, 188);
    frame.pixels[0] = frame.pixels[1] = frame.pixels[2] = 0;
    frame.pixels[3] = frame.pixels[4] = frame.pixels[5] = 255;
    const float l = 0.5029f, least = std::log(1e-6f);
    const float logMean = (30 * std::log(l) + least) / 32, key = (logMean - least) / -least;
    ImageRgbF out;
    masia2009().expand(frame, out);
    EXPECT_NEAR(out.pixels.back(), std::pow(l, 10.44f * key - 6.282f), 1e-3f);
    masia2017().expand(frame, out);
    EXPECT_NEAR(out.pixels.back(),
                std::pow(l, 2.4379f + 0.2319f * logMean - 1.1228f * key + 0.0085f * 100 / 32), 1e-3f);
}

// A white disc in grey: white there becomes 10, the formula's (10 * 10 / 2) * (2 / 10), and far from it a
// grey stays. Half as much light as white, expanded wholly, would be 50 (-0.5 + sqrt(0.25 + 0.02)) = 0.98.
TEST(InverseToneMapBaselines, ExpandsWhereThereIsMuchLight) {
    ImageRgb8 frame = filled(256, 128, 20, 20, 20);
    for (int y = 52; y < 76; ++y) std::fill_n(frame.at(116, y), 3 * 24, uint8_t{255});
    ImageRgbF out;
    banterle().expand(frame, out);
    EXPECT_NEAR(out.at(128, 64)[0], 10, 1);
    EXPECT_NEAR(out.at(0, 64)[0], math::linearFromSrgb(20 / 255.0f), 1e-3f);
}

TEST(InverseToneMapBaselines, BrightensAroundWhatIsClipped) {
    ImageRgb8 frame = filled(256, 128, 128, 128, 128);
    for (int y = 60; y < 68; ++y)
        for (int x = 120; x < 136; ++x)
            for (int c = 0; c < 3; ++c) frame.at(x, y)[c] = 255;
    ImageRgbF out;
    for (const InverseToneMapMethod& method : {rempel(), kovaleski()}) {
        method.expand(frame, out);
        EXPECT_GT(out.at(128, 64)[0], 2) << method.label.name;
        EXPECT_NEAR(out.at(0, 64)[0], 0.2159f, 1e-3f) << method.label.name;
    }
    EXPECT_NEAR(out.at(116, 64)[0], 0.2159f, 1e-3f); // unlike what is clipped beside it
}

} // namespace
} // namespace shoal::light::baselines
