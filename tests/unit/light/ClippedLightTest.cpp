// Estimates of clipped light: known scenes, and every way in which a cue can be missing.
#include "engine/light/ClippedLight.h"
#include "engine/light/MakeLight.h"
#include "engine/math/Colour.h"
#include "engine/math/LatLong.h"
#include "tests/Test.h"

namespace shoal::light {
namespace {

constexpr int kWidth = 512, kHeight = 256;

// radianceIn(direction): grey, linear; above 1 it is clipped.
ImageRgb8 filmed(const std::function<float(const glm::vec3&)>& radianceIn) {
    ImageRgb8 frame(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float seen = std::min(radianceIn(texelDirection(x, y, kWidth, kHeight)), 1.0f);
            std::fill_n(frame.at(x, y), 3, static_cast<uint8_t>(255 * math::srgbFromLinear(seen) + 0.5f));
        }
    return frame;
}

// Returns the gain straight above, where the estimate from the ground has full trust.
float gainOf(const FrameView& frame, int askedWidth = 512) {
    PyramidMaker maker;
    RadiancePyramid pyramid;
    maker.make(frame, askedWidth, pyramid, FrameRadiance::Auto);
    return maker.clippedGain().at(1);
}

float gainOf(const std::function<float(const glm::vec3&)>& radianceIn) {
    return gainOf(viewOf(filmed(radianceIn)));
}

constexpr float kSky = 0.1f;
const float kSunCosine = std::cos(0.2f); // about the zenith

// Returns the irradiance of level ground, over pi, by a sun of this radiance in an even sky.
float fromAbove(float sun) {
    const float sunShare = 1 - kSunCosine * kSunCosine; // of the cosine-weighed half sphere
    return sun * sunShare + kSky * (1 - sunShare);
}

// Returns the radiance of that sky, and of the ground of the assumed albedo in its light.
float openAir(const glm::vec3& towards, float sun) {
    if (towards.y < 0) return kGroundAlbedo * fromAbove(sun);
    return towards.y > kSunCosine ? sun : kSky;
}

EnvironmentLight lightOf(const ImageRgb8& frame, FrameRadiance from) {
    LightMaker maker({256, 0.5f, LightQuality::Video, from});
    EnvironmentLight light;
    maker.make(viewOf(frame), light);
    return light;
}

// Light from straight above is the sun's and the sky's. 6 % both ways: half a step of 8 bits is 2.2 % of the
// ground under a sun of 2; at the rim of the sun, at 78.5 degrees, the ground is trusted 0.982, which takes
// up to 1 - (80 / 2.5)^-0.018, 6 %, of the light there, half of that on the whole disc. 12.5 % less: white,
// the disc would give level ground 0.12, of which densities leave 0.105, beside 0.015 for few clipped pixels.
TEST(ClippedLight, KnowsTheSunByTheGround) {
    for (const float sun : {2.0f, 10.0f, 40.0f, 80.0f}) {
        const ImageRgb8 frame = filmed([&](const glm::vec3& d) { return openAir(d, sun); });
        const float up = lightOf(frame, FrameRadiance::Auto).diffuse.pixels[0];
        EXPECT_GT(up / fromAbove(sun), 1 - 0.06f - 0.125f) << sun;
        EXPECT_LT(up / fromAbove(sun), 1 + 0.06f) << sun;
    }
}

// A sun that shrinks to nothing, half its pixels each time, takes its light along without a leap at the end.
TEST(ClippedLight, TheLastClippedPixelsTakeNoMoreThanTheirShare) {
    const auto up = [](float radius_rad) {
        const float cosine = std::cos(radius_rad);
        const auto lit = [=](const glm::vec3& d) {
            return d.y < 0 ? kGroundAlbedo * fromAbove(40) : d.y > cosine ? 40.0f : kSky;
        };
        return lightOf(filmed(lit), FrameRadiance::Auto).diffuse.pixels[0];
    };
    const float none = up(0);
    float before = up(0.2f) - none;
    for (float radius_rad = 0.2f / std::sqrt(2.0f); radius_rad > 0.02f; radius_rad /= std::sqrt(2.0f)) {
        const float now = up(radius_rad) - none;
        EXPECT_LT(now, before) << radius_rad;
        EXPECT_GT(now, 0.25f * before) << radius_rad; // half the pixels, of half the density at most
        before = now;
    }
    EXPECT_LT(before, 0.3f * (up(0.2f) - none));
}

// A beam on the floor of a cave, ten times as bright as the rest, that comes from elsewhere: it is cut. It is
// a twentieth of the ground and would add 45 % to it; cut at 1.75 times the mean of 1.45 it adds 8 %.
TEST(ClippedLight, ABeamOnTheGroundTellsLittleOfTheSky) {
    const auto lit = [](float beam) {
        return gainOf([=](const glm::vec3& d) {
            const bool inBeam = d.y < 0 && d.y * d.y > 0.95f; // of the irradiance from below
            return (inBeam ? beam : 1) * openAir(d, 20) * 0.4f;
        });
    };
    const float alone = lit(1), with = lit(10);
    EXPECT_GT(with, alone);
    EXPECT_LT(with / alone, 1.12f);
}

// Glints of a pixel spread over the sky are hardly brighter than white; the sun has what the ground misses.
TEST(ClippedLight, GlintsAreNoSun) {
    const auto glints = [](int x, int y) { return x % 12 == 0 && y % 12 == 0 && y < kHeight / 2; };
    ImageRgb8 frame = filmed([](const glm::vec3& d) { return openAir(d, 40); });
    const float sun = gainOf(viewOf(frame));
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            if (glints(x, y)) std::fill_n(frame.at(x, y), 3, uint8_t{255});
    EXPECT_NEAR(gainOf(viewOf(frame)) / sun, 1, 0.03f); // 1 / 144 of all, of density 1 / 144, is left of them
}

// The gain stays within its stated limits in every case in which a cue is missing.
TEST(ClippedLight, FallsBackWhereACueIsMissing) {
    const float usual = kUsualGain, most = 1 + kMaxFromGround;
    const auto sunlit = [](const glm::vec3& d) { return openAir(d, 40); };
    const auto covered = [&](float below) {
        return gainOf([&](const glm::vec3& d) { return d.y < below ? 0.0f : sunlit(d); });
    };
    const float known = gainOf(sunlit);
    EXPECT_FLOAT_EQ(covered(0), usual) << "no ground is seen";
    EXPECT_NEAR(covered(-0.9f), known, 0.01f * known) << "a covered nadir, a tripod";
    EXPECT_FLOAT_EQ(gainOf([](const glm::vec3&) { return 2.0f; }), usual) << "everything is clipped";
    EXPECT_NEAR(gainOf([](const glm::vec3& d) { return d.y < 0 ? 2.0f : 0.1f; }), usual, 1e-5f)
        << "the ground is clipped";
    EXPECT_FLOAT_EQ(gainOf([](const glm::vec3&) { return 0.0f; }), usual) << "black";
    // Bright ground under a dark sky, as by lamps: clipped pixels may have been anything, but have a limit.
    EXPECT_NEAR(gainOf([](const glm::vec3& d) { return d.y < 0        ? 0.9f
                                                       : d.y > 0.999f ? 2.0f
                                                                      : 0.0f; }), most,
                0.01f * most);
    // A dark ground says that nothing is missing.
    EXPECT_NEAR(gainOf([](const glm::vec3& d) { return d.y < 0      ? 0.01f
                                                       : d.y > 0.9f ? 2.0f
                                                                    : 0.4f; }), 1,
                0.01f);
    // Bars above and below, as of a film in letterbox.
    const float boxed = gainOf([&](const glm::vec3& d) { return std::abs(d.y) > 0.95f ? 0.0f : sunlit(d); });
    EXPECT_GE(boxed, 1);
    EXPECT_LE(boxed, most);
}

// The ground counts less the less of it is seen. A step is a row or two of 256, of which every second one is
// read, so none, two or four. Over the 40 rows from where the share begins to count to the horizon, the gain
// falls from 40 to 2.5: four of them are a factor of 1.32.
TEST(ClippedLight, GroundThatDisappearsIsForgottenSmoothly) {
    float before = 0;
    for (float below = -1; below <= 0; below += 0.01f) {
        const float now = gainOf([&](const glm::vec3& d) { return d.y < below ? 0.0f : openAir(d, 40); });
        if (below > -1) {
            EXPECT_NEAR(now / before, 1, 0.25f) << below; // 1 - 1 / 1.32
        }
        before = now;
    }
}

// A white patch below the horizon, as sand in the sun, is left as it is; one above is scaled.
TEST(ClippedLight, ScalesWhatIsAboveTheHorizon) {
    const auto patchAt = [](float height) {
        return filmed([=](const glm::vec3& d) { return std::abs(d.y - height) < 0.1f ? 2.0f : 0.1f; });
    };
    EXPECT_EQ(lightOf(patchAt(-0.5f), FrameRadiance::Auto).diffuse.pixels,
              lightOf(patchAt(-0.5f), FrameRadiance::Linear).diffuse.pixels);
    const auto up = [](const EnvironmentLight& light) { return light.diffuse.pixels[0]; };
    EXPECT_GT(up(lightOf(patchAt(0.5f), FrameRadiance::Auto)),
              1.5f * up(lightOf(patchAt(0.5f), FrameRadiance::Linear)));
}

// The ground tells of light from above; what stands low has the usual gain, but for a tenth of the exponent.
TEST(ClippedLight, TrustsTheGroundTheMoreTheHigherLightStands) {
    const ClippedGain gain{100, 1}, half{100, 0.5f}, unseen{100, 0};
    EXPECT_FLOAT_EQ(gain.at(1), 100);
    EXPECT_FLOAT_EQ(half.at(1), std::sqrt(100 * kUsualGain));
    EXPECT_FLOAT_EQ(unseen.at(1), kUsualGain);
    EXPECT_FLOAT_EQ(gain.at(0), std::pow(kUsualGain, 0.9f) * std::pow(100.0f, 0.1f));
    for (float sine = 0; sine < 1; sine += 0.05f) EXPECT_LE(gain.at(sine), gain.at(sine + 0.05f));
    EXPECT_NEAR(gain.of(0, 1024), gain.at(1), 0.01f);
    // A third from the zenith to the nadir is 30 degrees; the row's middle is a sixth of one off, 0.0005
    // radians, which are 0.0014 of the gain.
    EXPECT_NEAR(gain.of(341, 1024), gain.at(0.5f), 0.0015f * gain.at(0.5f));
}

// Two clipped channels are an eighth of three, in whatever order; one is nothing.
TEST(ClippedLight, CountsByTheMiddleAndTheLeastChannel) {
    const auto steps = [](uint8_t a, uint8_t b, uint8_t c) {
        const std::array<uint8_t, 3> pixel{a, b, c};
        return clippedSteps(pixel.data());
    };
    EXPECT_EQ(steps(255, 255, 255), kClippedSteps);
    for (const int eighth : {steps(255, 255, 0), steps(255, 0, 255), steps(0, 255, 255)})
        EXPECT_EQ(8 * eighth, kClippedSteps);
    EXPECT_EQ(steps(255, 0, 0), 0);
    EXPECT_EQ(steps(kLastUnclipped, 255, kLastUnclipped), 0);
    EXPECT_EQ(steps(249, 255, 243), 6);
    EXPECT_EQ(steps(255, 244, 250), 7 * 1 + 7);
}

// Even colours of the upper and of the lower half. Of the upper one the largest channel is as bright as may
// be without being clipped.
glm::vec3 tintOf(const glm::vec3& above, const glm::vec3& below) {
    ImageRgbF decoded(64, 32);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c)
                decoded.at(x, y)[c] = y < 16 ? math::linearOfByte()[kLastUnclipped] * above[c] : below[c];
    return clippedTintOf(decoded);
}

void expectTint(const glm::vec3& got, const glm::vec3& ratios) {
    const glm::vec3 want = ratios / (0.2126f * ratios.r + 0.7152f * ratios.g + 0.0722f * ratios.b);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], want[c], 1e-3f) << c; // 1e-4 steradians of white
}

TEST(ClippedLight, HasTheColourThatAllHasInCommon) {
    expectTint(tintOf({0.5f, 1, 1}, {0.2f, 0.4f, 0.4f}), {0.5f, 1, 1}); // under water
    expectTint(tintOf({1, 0.8f, 0.4f}, {0.05f, 0.04f, 0.02f}), {1, 0.8f, 0.4f});
    expectTint(tintOf({1, 1, 1}, {0.2f, 0.4f, 0.1f}), {1, 1, 1});       // what is brightest is white
    expectTint(tintOf({0.9f, 0.9f, 1}, {0.6f, 0.6f, 0.1f}), {1, 1, 1}); // on the whole it is of the other hue
    // Nothing is nearly white.
    expectTint(tintOf({0.1f, 0.2f, 0.2f}, {0.1f, 0.2f, 0.2f}), {1, 1, 1});
}

// A region that comes to be clipped a step of 8 bits at a time: the light grows by no more at once than over
// the ramp's twelve steps, and never falls.
TEST(ClippedLight, NothingFlickersAtTheEdgeOfClipping) {
    ImageRgb8 frame = filmed([](const glm::vec3& d) { return openAir(d, 0.5f); });
    std::vector<float> light;
    for (int value = 235; value <= 255; ++value) {
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                if (openAir(texelDirection(x, y, kWidth, kHeight), 0.5f) > 0.4f)
                    std::fill_n(frame.at(x, y), 3, static_cast<uint8_t>(value));
        light.push_back(lightOf(frame, FrameRadiance::Auto).diffuse.pixels[0]);
    }
    const float whole = light.back() - light.front();
    for (size_t i = 1; i < light.size(); ++i) {
        EXPECT_GE(light[i], light[i - 1]);
        EXPECT_LT(light[i] - light[i - 1], 0.3f * whole) << i;
    }
}

// The order of a frame's bytes and the padding of its rows do not matter.
TEST(ClippedLight, ReadsAnyFrame) {
    const ImageRgb8 frame =
        filmed([](const glm::vec3& d) { return openAir(d, 20) * (d.x > 0 ? 1.0f : 0.5f); });
    std::vector<uint8_t> padded;
    for (int y = 0; y < kHeight; ++y) {
        padded.insert(padded.end(), frame.at(0, y), frame.at(0, y) + ptrdiff_t{3} * kWidth);
        padded.insert(padded.end(), 7, uint8_t{255});
    }
    EXPECT_EQ(gainOf(viewOf(frame)), gainOf({padded.data(), kWidth, kHeight, 3 * kWidth + 7, true}));
    for (const auto& [width, height] : {std::pair(2, 1), {3, 2}, {5, 7}})
        EXPECT_TRUE(std::isfinite(gainOf({frame.pixels.data(), width, height, 3 * kWidth, false})));
}

// Averaged over blocks first, or pixel by pixel: noise and a sun across edges of blocks. Where it is clipped
// a block has the gain of its middle, at most 1.5 rows of 512 away: 0.009 radians, at 54 degrees 0.0054 of
// the sine and 0.014 of the exponent, of a gain of at most 30 times the usual one 5 %.
TEST(ClippedLight, BlocksAgreeWithPixels) {
    ImageRgb8 frame = evenFrame(1024, 512, 120, 120, 120);       // sky
    std::fill_n(frame.at(0, 256), 3 * 1024 * 256, uint8_t{100}); // ground
    for (int y = 101; y < 114; ++y) std::fill_n(frame.at(700, y), 3 * 13, uint8_t{255});
    uint32_t seed = 3;
    for (uint8_t& value : frame.pixels) {
        seed = seed * 1664525u + 1013904223u;
        if (value < 255) value = static_cast<uint8_t>(value - 20 + (seed >> 24) % 40);
    }
    RadiancePyramid blocks, pixels;
    PyramidMaker blockMaker, pixelMaker;
    blockMaker.make(viewOf(frame), 256, blocks, FrameRadiance::Auto);
    pixelMaker.make(viewOf(frame), 1024, pixels, FrameRadiance::Auto);
    const float pixelGain = pixelMaker.clippedGain().at(1);
    EXPECT_NEAR(blockMaker.clippedGain().at(1), pixelGain, 0.002f * pixelGain);
    const ImageRgbF &got = blocks.levels[0], &want = pixels.levels[2];
    for (size_t i = 0; i < got.pixels.size(); ++i)
        ASSERT_NEAR(got.pixels[i], want.pixels[i],
                    (want.pixels[i] > 1 ? 0.05f : 0.003f) * want.pixels[i] + 2e-4f)
            << i;
}

// A cell is 4 x 4 pixels.
constexpr int kFrameWidth = 1024, kFrameHeight = 512, kAbove = kFrameHeight / 2;

ImageF filled() {
    ImageF upperHalf(kFrameWidth, kAbove);
    std::ranges::fill(upperHalf.pixels, 1.0f);
    return upperHalf;
}

// Returns the values of an upper half, times their densities.
ImageF weighed(const ImageF& upperHalf) {
    const ImageF before = filled(); // of which nothing is left
    ClippedDensity density;
    for (const ImageF* frame : {&before, &upperHalf}) {
        density.begin(kFrameWidth, kFrameHeight);
        for (int y = 0; y < kAbove; ++y) density.addRow(y, frame->at(0, y));
        density.finish();
    }
    ImageF out = upperHalf;
    for (int y = 0; y < kAbove; ++y) density.weigh(y, out.at(0, y));
    return out;
}

// Returns the number of cells of a neighbourhood at the elevation of a row.
float cellsAround(int y) {
    const double ring = std::sin(std::numbers::pi * (y / 4 + 0.5) / (kFrameHeight / 4));
    return 3 * (2 * static_cast<float>(std::lround(1 / ring)) + 1);
}

TEST(ClippedDensity, IsOneInsideAndLessAtTheHorizon) {
    const ImageF out = weighed(filled());
    for (int y = 0; y < kAbove; y += 3)
        for (int x = 0; x < kFrameWidth; x += 7)
            ASSERT_NEAR(*out.at(x, y), y < kAbove - 4 ? 1 : 2 / 3.0f, 1e-5) << x << ' ' << y;
}

TEST(ClippedDensity, OneCellCountsItsShareOfTheCellsAround) {
    for (const int y : {8, 40, 128, 240})       // 3 to 84 degrees from the zenith
        for (const int x : {0, 4, 512, 1020}) { // over the seam too
            ImageF frame(kFrameWidth, kAbove);
            for (int dy = 0; dy < 4; ++dy) std::fill_n(frame.at(x, y + dy), 4, 1.0f);
            const ImageF out = weighed(frame);
            EXPECT_NEAR(*out.at(x + 1, y + 2), 1 / cellsAround(y), 1e-6) << x << ' ' << y;
            EXPECT_EQ(*out.at((x + 4) % kFrameWidth, y), 0);
        }
}

// A glint of a pixel or a lamp of a degree moves a pixel at a time without a flicker.
TEST(ClippedDensity, StaysWhileSomethingSmallMoves) {
    for (int x = 0; x < 12; ++x) {
        const int column = (kFrameWidth - 6 + x) % kFrameWidth; // over the seam
        ImageF frame(kFrameWidth, kAbove);
        *frame.at(column, 160 + x) = 1;
        EXPECT_NEAR(*weighed(frame).at(column, 160 + x), 1 / 16.0f / cellsAround(160), 1e-7);
    }
}

TEST(ClippedDensity, TakesFramesOfAnySize) {
    for (const auto& [width, height] : {std::pair(2, 1), {3, 2}, {5, 7}, {300, 150}, {700, 351}}) {
        ClippedDensity density;
        density.begin(width, height);
        std::vector<float> row(static_cast<size_t>(width), 1);
        const int above = (height + 1) / 2;
        for (int y = 0; y < above; ++y) density.addRow(y, row.data());
        density.finish();
        density.weigh(0, row.data());
        for (const float each : row) {
            EXPECT_GT(each, 0) << width;
            EXPECT_LE(each, 1.0001f) << width;
        }
    }
}

} // namespace
} // namespace shoal::light
