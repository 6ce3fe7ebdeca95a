// Traced frames come back from disk to a step of their coding; scenes state what differs from their base.
#include "content/make/video/Kept.h"
#include "content/make/video/Scene.h"
#include "tests/Test.h"

namespace shoal::reef {
namespace {

// Steps: (64 / 0.002 + 1)^(1 / 4095) = 1.00254, 512^(1 / 4095) = 1.00153; half is the error, and rounding.
constexpr float kRadianceTol = 0.00127f * 1.01f, kDistanceTol = 0.000766f * 1.01f;

TEST(TracedFrames, CodesKeepLightAndDistanceToHalfAStep) {
    for (float x = 1e-4f; x < kKeptBrightest; x *= 1.37f)
        EXPECT_NEAR(radianceOfCode(codeOfRadiance(x)), x, kRadianceTol * (x + kKeptDark)) << x;
    EXPECT_EQ(radianceOfCode(codeOfRadiance(0)), 0);
    EXPECT_NEAR(radianceOfCode(codeOfRadiance(1e6f)), kKeptBrightest, kRadianceTol * kKeptBrightest);
    for (float x = kKeptNearest; x < kKeptFurthest; x *= 1.13f)
        EXPECT_NEAR(distanceOfCode(codeOfDistance(x)), x, kDistanceTol * x) << x;
}

Drawn gradient(int width) {
    Drawn drawn{ImageRgbF(width, width / 2), std::vector<float>(static_cast<size_t>(width) * width / 2)};
    for (int y = 0; y < width / 2; ++y)
        for (int x = 0; x < width; ++x) {
            const float u = static_cast<float>(x) / static_cast<float>(width), v = static_cast<float>(y % 7);
            for (int c = 0; c < 3; ++c)
                drawn.radianceLin.at(x, y)[c] = 0.01f * std::exp(6 * u) + 0.1f * v * static_cast<float>(c);
            drawn.distance[static_cast<size_t>(y) * width + x] = 0.3f + 20 * u + v;
        }
    return drawn;
}

TEST(TracedFrames, ComeBackAsTheyWere) {
    const tests::ScratchFolder folder;
    const Drawn drawn = gradient(96);
    ASSERT_TRUE(keep(drawn, folder / "frame.nut"));
    EXPECT_FALSE(std::filesystem::exists(folder / "frame.nut.part"));
    const auto back = tests::valueOf(recall(folder / "frame.nut", 96));
    for (size_t i = 0; i < drawn.radianceLin.pixels.size(); ++i) {
        const float x = drawn.radianceLin.pixels[i];
        ASSERT_NEAR(back.radianceLin.pixels[i], x, kRadianceTol * (x + kKeptDark)) << i;
    }
    for (size_t i = 0; i < drawn.distance.size(); ++i)
        ASSERT_NEAR(back.distance[i], drawn.distance[i], kDistanceTol * drawn.distance[i]) << i;
}

TEST(TracedFrames, AnotherSizeAndHalfAFileAreErrors) {
    const tests::ScratchFolder folder;
    ASSERT_TRUE(keep(gradient(96), folder / "frame.nut"));
    EXPECT_FALSE(recall(folder / "frame.nut", 128));
    EXPECT_FALSE(recall(folder / "missing.nut", 96));
    std::filesystem::resize_file(folder / "frame.nut", std::filesystem::file_size(folder / "frame.nut") / 8);
    EXPECT_FALSE(recall(folder / "frame.nut", 96));
}

TEST(Scenes, StateWhatDiffersFromTheirBase) {
    const Path folder = dataRoot() / "content/make/video";
    const auto reef = tests::valueOf(readScene(folder / "Reef.toml")),
               night = tests::valueOf(readScene(folder / "Night.toml"));
    EXPECT_EQ(night.rocks.size(), reef.rocks.size());
    EXPECT_EQ(night.water.attenuation, reef.water.attenuation);
    EXPECT_EQ(night.film.fps, reef.film.fps);
    EXPECT_LT(night.sun.irradiance.y, 0.05f * reef.sun.irradiance.y);
    EXPECT_TRUE(reef.lamps.empty());
    EXPECT_FALSE(night.lamps.empty());
    EXPECT_NE(night.key, reef.key);
    EXPECT_TRUE(readScene(folder / "Kelp.toml"));
}

} // namespace
} // namespace shoal::reef
