// Settings and scores survive between games, and a damaged file is neither believed nor overwritten.
#include "game/settings/KeptFiles.h"
#include "engine/core/WriteFile.h"
#include "game/settings/PlayOptions.h"
#include "game/tools/NearestWord.h"
#include "tests/Test.h"

#include <nlohmann/json.hpp>

namespace shoal::app {
namespace {

class KeptFiles : public testing::Test {
  protected:
    tests::ScratchFolder folder_;
    void SetUp() override {
        ::setenv("XDG_CONFIG_HOME", folder_.path().c_str(), 1);
        ::setenv("XDG_DATA_HOME", folder_.path().c_str(), 1);
    }

    static Status saveAll(PlayOptions& options) {
        for (const Setting& row : settingsOf(options).rows)
            if (row.kept)
                if (Status saved = saveSetting(row); !saved) return saved;
        return Done{};
    }
    static PlayOptions load() {
        PlayOptions options;
        loadSettings(settingsOf(options));
        return options;
    }
};

TEST_F(KeptFiles, AnAddressMayBeOfIPv6AndHasAPort) {
    std::string host;
    uint16_t port = 0;
    const TextSetting address = addressSetting(host, port);
    EXPECT_TRUE(address.set("[::1]:6502"));
    EXPECT_EQ(address.get(), "[::1]:6502");
    EXPECT_EQ(host, "[::1]");
    for (const char* wrong : {"::1:6502", "[]:1", "[::1]", "[::1:1", "::1]:1", "a]:1", "[:1", "nowhere", ":1",
                              "a:0", "a:70000", "a:1x"})
        EXPECT_FALSE(address.set(wrong)) << wrong;
}

// Each file's content decides, and its name says something else.
TEST_F(KeptFiles, FilmsAndPhotosAreListedByTheirContent) {
    ::setenv("HOME", folder_.path().c_str(), 1);
    const auto write = [&](const char* name, std::string_view bytes) {
        std::filesystem::create_directories((folder_ / name).parent_path());
        EXPECT_TRUE(writeFileWhole(folder_ / name, bytes));
    };
    write("Videos/text.mp4", "no film, but text");
    write("Videos/photo", "\xff\xd8\xff\xe0");
    write("Pictures/grey.ppm", "P5 2 1 255\n12");
    write("Pictures/phone.jpg", std::string_view("\0\0\0\x14"
                                                 "ftypheic\0\0\0\0mif1",
                                                 20));
    write("Downloads/sky.txt", "#?RADIANCE\n");
    write("Downloads/empty.png", "");
    const auto names = [] {
        FilmList list;
        list.look();
        while (!list.found().complete) std::this_thread::yield();
        std::vector<std::string> all;
        for (const Path& file : list.found().files) all.push_back(file.filename().string());
        return all;
    };
    EXPECT_THAT(names(), testing::UnorderedElementsAre("photo", "grey.ppm", "sky.txt"));
    write("Downloads/empty.png", "\xff\xd8\xff\xe0");
    const auto later = std::filesystem::file_time_type::clock::now() + std::chrono::hours(1);
    std::filesystem::last_write_time(folder_ / "Pictures/grey.ppm", later);
    EXPECT_THAT(names(), testing::AllOf(testing::SizeIs(4), testing::Contains("empty.png")));
    EXPECT_EQ(names().front(), "grey.ppm"); // the newest comes first
}

// The ends of ranges are floats, which need not be what their decimals say.
TEST_F(KeptFiles, EverySettingComesBack) {
    for (const float fraction : {0.0f, 1.0f}) {
        PlayOptions set;
        for (const Setting& row : settingsOf(set).rows) {
            if (!row.kept) continue;
            if (sliderOf(row)) slide(row, fraction);
            if (!sliderOf(row) || fraction == 1) adjust(row, 1); // no farther than the end
            EXPECT_NEAR(sliderOf(row).value_or(fraction), fraction, 1e-6f)
                << row.option; // an end is no float
        }
        set.hands.leap.host = "tracker";
        set.hands.leap.port = 7000;
        ASSERT_TRUE(saveAll(set));
        PlayOptions settings = load();
        EXPECT_NE(settings.skin, PlayOptions().skin);
        const auto given = settingsOf(set), read = settingsOf(settings);
        for (size_t i = 0; i < given.rows.size(); ++i) {
            if (!given.rows[i].kept) continue;
            EXPECT_EQ(sliderOf(read.rows[i]), sliderOf(given.rows[i])) << given.rows[i].option;
            EXPECT_EQ(shownValue(read.rows[i], game::Language::English),
                      shownValue(given.rows[i], game::Language::English))
                << given.rows[i].option;
        }
    }
}

// Options for one run are not written to the file: only settings that the player changes are.
TEST_F(KeptFiles, OneSettingIsWrittenAndAllElseInTheFileStays) {
    const Path file = folder_ / "shoal/settings.json";
    ASSERT_TRUE(writeFileWhole(file, R"({"of-a-later-version": [1, 2], "volume": 17, "fov": 80})"));
    PlayOptions set{.record = "a.replay", .volume = 0.25f, .snow = false};
    const auto rows = settingsOf(set).rows;
    ASSERT_TRUE(saveSetting(*std::ranges::find(rows, "snow", &Setting::key)));
    const auto json = nlohmann::json::parse(readText(file).value());
    EXPECT_EQ(json, nlohmann::json::parse(
                        R"({"of-a-later-version": [1, 2], "volume": 17, "fov": 80, "snow": false})"));
    EXPECT_EQ(load().fov_deg, 80);
    EXPECT_FALSE(load().snow);
}

TEST_F(KeptFiles, SettingsThatMakeNoSenseAreNotBelieved) {
    ASSERT_TRUE(writeFileWhole(folder_ / "shoal/settings.json",
                               R"({"volume": 17, "captions": "yes", "haptics": null, "skin": "scales",
                                   "leap": "nowhere", "fov": [65]})"));
    EXPECT_EQ(load().volume, PlayOptions().volume);
    EXPECT_TRUE(load().text.captions);
    EXPECT_EQ(load().skin, PlayOptions().skin);
    EXPECT_EQ(load().hands.leap.host, PlayOptions().hands.leap.host);
    EXPECT_EQ(load().fov_deg, PlayOptions().fov_deg);
    ASSERT_TRUE(writeFileWhole(folder_ / "shoal/settings.json", "{\"volume\": "));
    EXPECT_EQ(load().volume, PlayOptions().volume);
}

TEST_F(KeptFiles, TheBestFiveScoresAreKeptByDive) {
    EXPECT_TRUE(readScores()["reef"].top.empty());
    for (const int score : {30, 120, 50, 10, 70, 60}) ASSERT_TRUE(addScore("reef", score, 1));
    ASSERT_TRUE(addScore("wreck", 40, 0));
    EXPECT_EQ(readScores()["reef"].top, (std::vector<int>{120, 70, 60, 50, 30}));
    EXPECT_EQ(readScores()["reef"].last, 60);
    ASSERT_TRUE(addScore("wreck", 0, 0)); // 0 is no top score
    EXPECT_EQ(readScores()["wreck"].top, std::vector<int>{40});
    EXPECT_EQ(readScores()["wreck"].last, 0);
}

TEST_F(KeptFiles, ScoresOfEarlierVersionsAreRead) {
    ASSERT_TRUE(writeFileWhole(folder_ / "shoal/scores.json",
                               R"({"reef": 90, "wreck": "many", "kelp": {"top": [20, "many"]}})"));
    EXPECT_EQ(readScores()["reef"].top, std::vector<int>{90});
    EXPECT_TRUE(readScores()["wreck"].top.empty());
    EXPECT_EQ(readScores()["kelp"].top, std::vector<int>{20});
    ASSERT_TRUE(addScore("reef", 40, 2));
    EXPECT_EQ(readScores()["reef"].top, (std::vector<int>{90, 40}));
    EXPECT_EQ(starsIn(readScores()), 2);
}

TEST_F(KeptFiles, StarsAreKeptByDiveTheMostAndAllTogether) {
    EXPECT_EQ(starsIn(readScores()), 0);
    for (const int stars : {1, 3, 2}) ASSERT_TRUE(addScore("reef", 10, stars));
    ASSERT_TRUE(addScore("kelp", 10, 1));
    EXPECT_EQ(readScores()["reef"].stars, 3);
    EXPECT_EQ(readScores()["reef"].allStars, 6);
    EXPECT_EQ(readScores()["kelp"].stars, 1);
    EXPECT_EQ(starsIn(readScores()), 7);
    ASSERT_TRUE(writeFileWhole(folder_ / "shoal/scores.json",
                               R"({"reef": {"top": [1], "stars": -2, "all_stars": "many"}})"));
    EXPECT_EQ(starsIn(readScores()), 0);
}

TEST_F(KeptFiles, ADamagedScoreFileIsLeftAlone) {
    const Path file = folder_ / "shoal/scores.json";
    ASSERT_TRUE(writeFileWhole(file, "[1, 2"));
    EXPECT_TRUE(readScores()["reef"].top.empty());
    EXPECT_FALSE(addScore("reef", 1, 0));
    EXPECT_EQ(readText(file).value(), "[1, 2");
}

TEST_F(KeptFiles, TheFieldGuideRemembers) {
    EXPECT_TRUE(readGuide().empty());
    const std::vector<MetAnimal> met = {
        {.species = "snapper", .caught = 3, .largest_m = 0.25f, .dive = "The reef", .date = "2024-02-29"},
        {.species = "ray"}};
    ASSERT_TRUE(saveGuide(met));
    EXPECT_EQ(readGuide(), met);
    const Path damaged = folder_ / "shoal/guide.json"; // is left alone
    ASSERT_TRUE(writeFileWhole(damaged, "[1, 2"));
    EXPECT_FALSE(saveGuide(met));
    EXPECT_EQ(readText(damaged).value(), "[1, 2");
}

TEST_F(KeptFiles, AGuideOfEarlierVersionsIsReadAndWrongValuesAreNot) {
    ASSERT_TRUE(writeFileWhole(folder_ / "shoal/guide.json",
                               R"({"met": ["snapper", {"species": "ray", "caught": "many", "largest_m": 1e40,
                                   "dive": 7}, {"caught": 2}, 5, [1]]})"));
    EXPECT_EQ(readGuide(),
              (std::vector<MetAnimal>{{.species = "snapper"}, {.species = "ray", .largest_m = 30}}));
}

TEST(NearestWord, DistancesAreKnown) {
    EXPECT_EQ(editDistance("", ""), 0);
    EXPECT_EQ(editDistance("", "abc"), 3);
    EXPECT_EQ(editDistance("play", "play"), 0);
    EXPECT_EQ(editDistance("plya", "play"), 1); // a swap is one edit
    EXPECT_EQ(editDistance("kitten", "sitting"), 3);
    EXPECT_EQ(editDistance("ca", "abc"), 3); // 2 where a letter may be edited twice
    EXPECT_EQ(editDistance("sitting", "kitten"), editDistance("kitten", "sitting"));
}

TEST(NearestWord, OnlyWhatIsNearIsSuggested) {
    const std::vector<std::string> commands = {"play", "view", "light", "panorama", "check", "devices"};
    EXPECT_EQ(didYouMean("plya", commands), "; did you mean play?");
    EXPECT_EQ(didYouMean("pnorma", commands), "; did you mean panorama?");
    EXPECT_EQ(didYouMean("chekc", commands), "; did you mean check?");
    EXPECT_EQ(didYouMean("viw", commands), "; did you mean view?");
    EXPECT_EQ(didYouMean("swim", commands), "");
    EXPECT_EQ(didYouMean("pl", commands), "") << "half of its letters would change";
    EXPECT_EQ(didYouMean("", commands), "");
    EXPECT_EQ(didYouMean(std::string(100'000, 'x'), commands), "");
}

} // namespace
} // namespace shoal::app
