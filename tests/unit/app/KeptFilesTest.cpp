// Settings and scores survive between games, and a damaged file is neither believed nor overwritten.
#include "game/settings/KeptFiles.h"
#include "engine/core/Files.h"
#include "game/session/Statistics.h"
#include "game/settings/PlayOptions.h"
#include "tests/TestPaths.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace shoal::app {
namespace {

class KeptFiles : public testing::Test {
  protected:
    tests::ScratchFolder folder_;
    void SetUp() override {
        ::setenv("XDG_CONFIG_HOME", folder_.path().c_str(), 1);
        ::setenv("XDG_DATA_HOME", folder_.path().c_str(), 1);
    }

    static PlayOptions load() {
        PlayOptions options;
        loadSettings(settingsOf(options));
        return options;
    }
};

TEST_F(KeptFiles, SettingsComeBack) {
    EXPECT_EQ(load().volume, PlayOptions().volume);
    PlayOptions set{.skin = Skin::Glove,
                    .stereo = StereoOutput::SideBySide,
                    .eyeDistance_mm = 61,
                    .vsync = false,
                    .compose = render::Composition::VideoTexels,
                    .headphones = true,
                    .volume = 0.25f,
                    .hapticStrength = 0.5f,
                    .captions = false,
                    .snow = false};
    set.hands.leap.host = "tracker";
    set.hands.leap.port = 7000;
    ASSERT_TRUE(saveSettings(settingsOf(set)));
    const PlayOptions settings = load();
    EXPECT_EQ(settings.volume, 0.25f);
    EXPECT_EQ(settings.hapticStrength, 0.5f);
    EXPECT_TRUE(settings.headphones);
    EXPECT_FALSE(settings.captions);
    EXPECT_FALSE(settings.snow);
    EXPECT_FALSE(settings.vsync);
    EXPECT_EQ(settings.skin, Skin::Glove);
    EXPECT_EQ(settings.stereo, StereoOutput::SideBySide);
    EXPECT_EQ(settings.compose, render::Composition::VideoTexels);
    EXPECT_EQ(settings.eyeDistance_mm, 61);
    EXPECT_EQ(settings.hands.leap.host, "tracker");
    EXPECT_EQ(settings.hands.leap.port, 7000);
}

// What a command is given for one run only must not stay.
TEST_F(KeptFiles, SettingsOfOneRunAreNotKept) {
    PlayOptions set{.seed = 7, .record = "a.replay", .headless = true, .timedemo = true};
    set.environment.video = "mine.mp4";
    set.look.size = {64, 36};
    ASSERT_TRUE(saveSettings(settingsOf(set)));
    const PlayOptions settings = load();
    EXPECT_EQ(settings.seed, PlayOptions().seed);
    EXPECT_EQ(settings.record, "");
    EXPECT_FALSE(settings.headless);
    EXPECT_FALSE(settings.timedemo);
    EXPECT_EQ(settings.environment.video, "");
    EXPECT_EQ(settings.look.size, PlayOptions().look.size);
}

TEST_F(KeptFiles, SettingsThatMakeNoSenseAreNotBelieved) {
    ASSERT_TRUE(writeFileWhole(folder_ / "shoal/settings.json",
                               R"({"volume": 17, "captions": "yes", "haptics": null, "skin": "scales",
                                   "leap": "nowhere", "samples": 1e300, "fov": [65]})"));
    EXPECT_EQ(load().volume, PlayOptions().volume);
    EXPECT_TRUE(load().captions);
    EXPECT_EQ(load().skin, PlayOptions().skin);
    EXPECT_EQ(load().hands.leap.host, PlayOptions().hands.leap.host);
    EXPECT_EQ(load().look.samples, 0);
    EXPECT_EQ(load().fov_deg, PlayOptions().fov_deg);
    ASSERT_TRUE(writeFileWhole(folder_ / "shoal/settings.json", "{\"volume\": "));
    EXPECT_EQ(load().volume, PlayOptions().volume);
}

TEST_F(KeptFiles, ScoresAreKeptByDive) {
    EXPECT_EQ(bestScore("reef"), 0);
    ASSERT_TRUE(saveBestScore("reef", 120));
    ASSERT_TRUE(saveBestScore("wreck", 40));
    EXPECT_EQ(bestScore("reef"), 120);
    EXPECT_EQ(bestScore("wreck"), 40);
}

TEST_F(KeptFiles, ADamagedScoreFileIsLeftAlone) {
    const Path file = folder_ / "shoal/scores.json";
    ASSERT_TRUE(writeFileWhole(file, "[1, 2"));
    EXPECT_EQ(bestScore("reef"), 0);
    EXPECT_FALSE(saveBestScore("reef", 1));
    EXPECT_EQ(readText(file).value(), "[1, 2");
}

TEST(Series, QuantilesAreValuesOfTheSeries) {
    Series series;
    EXPECT_EQ(series.quantile(0.5), 0);
    for (int i = 100; i >= 0; --i) series.add(i);
    EXPECT_EQ(series.quantile(0), 0);
    EXPECT_EQ(series.quantile(0.5), 50);
    EXPECT_EQ(series.quantile(0.99), 99);
    EXPECT_EQ(series.quantile(1), 100);
}

} // namespace
} // namespace shoal::app
