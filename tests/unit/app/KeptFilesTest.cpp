// Settings and scores survive between games, and a damaged file is neither believed nor overwritten.
#include "engine/core/Files.h"
#include "game/app/Scores.h"
#include "game/app/Settings.h"
#include "game/app/Statistics.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace shoal::app {
namespace {

class KeptFiles : public testing::Test {
  protected:
    Path folder_ = Path(testing::TempDir()) / "shoal_kept";
    void SetUp() override {
        std::filesystem::remove_all(folder_);
        ::setenv("XDG_CONFIG_HOME", folder_.c_str(), 1);
        ::setenv("XDG_DATA_HOME", folder_.c_str(), 1);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
};

TEST_F(KeptFiles, SettingsComeBack) {
    EXPECT_EQ(loadSettings().volume, Settings().volume);
    ASSERT_TRUE(saveSettings(
        {.volume = 0.25f, .hapticStrength = 0.5f, .headphones = true, .captions = false, .snow = false}));
    const Settings settings = loadSettings();
    EXPECT_EQ(settings.volume, 0.25f);
    EXPECT_EQ(settings.hapticStrength, 0.5f);
    EXPECT_TRUE(settings.headphones);
    EXPECT_FALSE(settings.captions);
    EXPECT_FALSE(settings.snow);
}

TEST_F(KeptFiles, SettingsThatMakeNoSenseAreNotBelieved) {
    ASSERT_TRUE(writeFileWhole(folder_ / "shoal/settings.json",
                               R"({"volume": 17, "captions": "yes", "haptics": null})"));
    EXPECT_EQ(loadSettings().volume, Settings().volume);
    EXPECT_TRUE(loadSettings().captions);
    ASSERT_TRUE(writeFileWhole(folder_ / "shoal/settings.json", "{\"volume\": "));
    EXPECT_EQ(loadSettings().volume, Settings().volume);
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
