// Tests that a known share of scattered light is found again.
#include "engine/camera/CameraResponse.h"
#include "MadeFilm.h"

#include <gtest/gtest.h>

namespace shoal::camera {
namespace {

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

class KnownGlare : public testing::TestWithParam<std::tuple<float, float>> {};

// Within a fifth and half a percent: a cell beside the edge has some of the bright side's light for its own,
// and noise adds its variance.
TEST_P(KnownGlare, IsFoundBesideBrightThings) {
    const auto [share, noise] = GetParam();
    EXPECT_NEAR(glowOf(edgeBehindALens(share, 0, noise)).maxShare, share, 0.005f + 0.2f * share);
}
INSTANTIATE_TEST_SUITE_P(SharesAndNoises, KnownGlare,
                         testing::Combine(testing::Values(0.0f, 0.02f, 0.06f, 0.1f),
                                          testing::Values(0.0f, 3.0f)));

TEST(Glare, IsOnlyABoundWhereNothingIsDark) {
    EXPECT_GT(glowOf(edgeBehindALens(0.02f, 0.2f, 0)).maxShare, 0.25f);
    EXPECT_EQ(glowOf(ImageRgb8(512, 256)).maxShare, 1) << "black: nothing is known";
    EXPECT_EQ(glowOf(ImageRgb8()).maxShare, 1);
}

TEST(Glare, SpreadsLightOverFiveDegreesAndLosesNone) {
    ImageRgb8 frame(1024, 512);
    for (int y = 248; y < 264; ++y)
        for (int x = 1016; x < 1032; ++x) // over the seam
            std::fill_n(frame.at(x % 1024, y), 3, uint8_t{255});
    const Glare glow = glowOf(frame);
    double sum = 0, square = 0;
    for (int y = 0; y < kGlowHeight; ++y)
        for (int x = 0; x < kGlowWidth; ++x) {
            const double light = static_cast<double>(glow.spread.at(x, y)[1]);
            const double away = x < kGlowWidth / 2 ? x + 0.5 : x + 0.5 - kGlowWidth; // from the seam
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
