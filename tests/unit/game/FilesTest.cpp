// Species, dives and scripts as files: what is wrong is named with its line.
#include "Fixture.h"
#include "engine/core/WriteFile.h"
namespace shoal::game {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class GameFiles : public testing::Test {
  protected:
    const Path& write(const std::string& text) {
        EXPECT_TRUE(writeFileWhole(file_, text));
        return file_;
    }
    tests::ScratchFolder folder_;
    Path file_ = folder_ / "a.toml";
};

template <class T> std::string reasonOf(const Result<T>& read) {
    return read ? "accepted" : read.error().message();
}

const std::string kSpecies = "[[species]]\nname = \"perch\"\nmodel = \"models/perch.glb\"\nlength = 0.2\n";

TEST_F(GameFiles, SpeciesErrorsNameTheLine) {
    ASSERT_TRUE(loadSpecies(write(kSpecies)));
    EXPECT_EQ(loadSpecies(file_)->at(0).name, "perch");
    const auto reason = [&](const std::string& text) { return reasonOf(loadSpecies(write(text))); };
    EXPECT_THAT(reason(kSpecies + "shape = 3\n"),
                AllOf(HasSubstr("line 5"), HasSubstr("unknown key \"shape\"")));
    EXPECT_THAT(reason(kSpecies + "colour = [0, 1, 2]\n"), AllOf(HasSubstr("line 5"), HasSubstr("0 to 1")));
    EXPECT_THAT(reason(kSpecies + "fact = [\"\", 3]\n"), AllOf(HasSubstr("line 5"), HasSubstr("3 texts")));
    EXPECT_THAT(reason(kSpecies + "one = [\"\", \"\", \"\", \"\"]\n"), HasSubstr("3 texts"));
    EXPECT_THAT(reason(kSpecies + "cruise = 99\n"), AllOf(HasSubstr("line 5"), HasSubstr("0.05 to 2")));
    EXPECT_THAT(reason(kSpecies + "cruise = nan\n"), HasSubstr("line 5"));
    EXPECT_THAT(reason(kSpecies + "cruise = \"fast\"\n"), HasSubstr("line 5"));
    EXPECT_THAT(reason(kSpecies + "points = 1.5\n"), HasSubstr("whole number"));
    EXPECT_THAT(reason(kSpecies + "company = \"crowd\"\n"), AllOf(HasSubstr("line 5"), HasSubstr("shoal")));
    EXPECT_THAT(reason(kSpecies + "cruise = = 3\n"), HasSubstr("line 5"));
    EXPECT_THAT(reason(kSpecies + kSpecies), AllOf(HasSubstr("line 5"), HasSubstr("twice")));
    EXPECT_THAT(reason("[[species]]\nname = \"perch\"\n"), HasSubstr("\"model\" is missing"));
    EXPECT_THAT(reason("[[species]]\nname=\"a\"\nmodel=\"../a\"\nlength=0.2\n"), HasSubstr("below content"));
    EXPECT_THAT(reason(""), HasSubstr("missing"));
    EXPECT_THAT(reason("species = 3"), HasSubstr("list"));
    EXPECT_FALSE(loadSpecies("/nonexistent/species.toml"));
}

TEST_F(GameFiles, DiveErrorsNameTheLine) {
    const SpeciesTable& known = cove().species;
    const std::string good = "duration = 30\n[[school]]\nspecies = \"snapper\"\ncount = 3\n";
    ASSERT_TRUE(loadDive(write(good), known));
    const auto reason = [&](const std::string& text) { return reasonOf(loadDive(write(text), known)); };
    EXPECT_THAT(reason("music = \"../reef\"\n" + good), AllOf(HasSubstr("line 1"), HasSubstr("theme")));
    EXPECT_EQ(tests::valueOf(loadDive(write("music = \"reef\"\n" + good), known)).music, "reef");
    EXPECT_THAT(reason(good + "radius = [2, 1]\n"), HasSubstr("line 5"));
    EXPECT_THAT(reason(good + "radius = [0.1, 1]\n"), HasSubstr("line 5"));
    EXPECT_THAT(reason(good + "radius = [1, 2, 3]\n"), HasSubstr("line 5"));
    EXPECT_THAT(reason(good + "[[school]]\nspecies = \"whale\"\ncount = 1\n"),
                AllOf(HasSubstr("line 6"), HasSubstr("whale")));
    const std::string goal = "[[goal]]\nkind = ", catchOne = goal + "\"catch\"\ncount = 1\n";
    EXPECT_THAT(reason(good + goal + "\"quick\"\ncount = 99\n"),
                AllOf(HasSubstr("line 7"), HasSubstr("1 to 8")));
    EXPECT_THAT(reason(good + goal + "\"catch\"\ncount = 1\nwithin = 5\n"), HasSubstr("unknown key"));
    EXPECT_THAT(reason(good + goal + "\"first\"\n"), HasSubstr("\"species\" is missing"));
    EXPECT_THAT(reason(good + catchOne + "level = 4\n"), AllOf(HasSubstr("line 8"), HasSubstr("1 to 3")));
    std::string levels;
    for (const char* level : {"1", "2", "3", "1"}) levels += catchOne + "level = " + level + "\n";
    EXPECT_EQ(reason(good + levels), "accepted");
    EXPECT_THAT(reason(good + levels + catchOne), HasSubstr("one of each \"level\""));
    EXPECT_THAT(reason(good + catchOne + catchOne + catchOne + catchOne), HasSubstr("one of each \"level\""));
    EXPECT_EQ(reason(good + catchOne + catchOne + catchOne), "accepted");
    EXPECT_THAT(reason(good + "[[school]]\nspecies = \"shark\"\ncount = 1\n"),
                HasSubstr("must not be a shark"));
    EXPECT_THAT(reason(good + "[[school]]\nspecies = \"snapper\"\ncount = 1000\n"),
                HasSubstr("more than 1000 fish"));
    EXPECT_THAT(reason(good + "[shark]\nspecies = \"snapper\"\n"), HasSubstr("must be a shark"));
    SpeciesTable withWhale = known;
    withWhale.push_back({.name = "whale", .giant = true});
    const auto encounter = [&](const std::string& species, const std::string& rest) {
        return reasonOf(
            loadDive(write(good + "[encounter]\nspecies = \"" + species + "\"\nat = 9\n" + rest), withWhale));
    };
    const std::string way = "from = [-9, 3, 0]\nto = [9, 3, 0]\n";
    EXPECT_EQ(encounter("whale", way), "accepted");
    EXPECT_THAT(encounter("snapper", way), HasSubstr("must be a giant"));
    EXPECT_THAT(encounter("whale", "from = [-9, 3, 0]\n"), HasSubstr("\"to\" is missing"));
    EXPECT_THAT(encounter("whale", "from = [-9, 3]\nto = [9, 3, 0]\n"), HasSubstr("three numbers"));
    EXPECT_THAT(encounter("whale", "from = [-9, 1, 0]\nto = [9, 1, 0]\n"), HasSubstr("no less than 2.5 m"));
    EXPECT_THAT(encounter("whale", "from = [-90, 3, 0]\nto = [9, 3, 0]\n"), HasSubstr("-60 to 60"));
    EXPECT_THAT(reason(good + "[shark]\nspecies = \"shark\"\nvisits = [20, 10]\n"), HasSubstr("rising"));
    EXPECT_THAT(reason("video = \"/etc/passwd\"\n" + good), HasSubstr("line 1"));
    EXPECT_THAT(reason(good + "[[enclosure]]\nfrom_s = 5\nto_s = 4\n"),
                AllOf(HasSubstr("line 7"), HasSubstr("after")));
    EXPECT_THAT(reason(good + "[[enclosure]]\nfrom_s = -1\nto_s = 4\n"), HasSubstr("line 6"));
    EXPECT_THAT(reason(good + "[[enclosure]]\nfrom_s = 1\nto_s = 4\namount = 1.5\n"), HasSubstr("line 8"));
    EXPECT_THAT(reason(good + "[[enclosure]]\nfrom_s = 1\n"), HasSubstr("\"to_s\" is missing"));
    EXPECT_THAT(reason("enclosure = 3\n" + good), HasSubstr("list"));
    EXPECT_THAT(reason("duration = 30\n"), HasSubstr("\"school\" is missing"));
}

TEST_F(GameFiles, ScriptErrorsNameTheLine) {
    const std::string good = "seed = 4\n[[step]]\ndo = \"wait\"\nseconds = 1\n";
    ASSERT_TRUE(loadScript(write(good)));
    const auto reason = [&](const std::string& text) { return reasonOf(loadScript(write(text))); };
    EXPECT_THAT(reason(good + "[[step]]\ndo = \"fly\"\n"),
                AllOf(HasSubstr("line 6"), HasSubstr("reach, move")));
    EXPECT_THAT(reason(good + "until = \"dinner\"\n"), HasSubstr("line 5"));
    EXPECT_THAT(reason(good + "[[step]]\ndo = \"again\"\nfrom = 2\n"), HasSubstr("earlier"));
    EXPECT_THAT(reason(good + "[[expect]]\norder = [\"grab\", \"dinner\"]\n"), HasSubstr("line 6"));
    EXPECT_THAT(reason("dive = \"../reef\"\n" + good), HasSubstr("line 1"));
    EXPECT_THAT(reason(good + "hand = \"third\"\n"), HasSubstr("line 5"));
    EXPECT_THAT(reason("assist = \"much\"\n" + good), HasSubstr("line 1"));
    EXPECT_THAT(reason(good + "[[step]]\ndo = \"press\"\n[[step]]\ndo = \"close\"\n"), HasSubstr("either"));
}

TEST_F(GameFiles, AScriptThatFailsSaysWhy) {
    const auto verdict = [&](const std::string& text) {
        const auto script = tests::valueOf(loadScript(write(text)));
        const Played played = playScript(script, rig(), cove());
        return played.verdict ? std::string("met") : played.verdict.error().message();
    };
    const std::string wait = "name = \"idle\"\n[[step]]\ndo = \"wait\"\nseconds = 1\n";
    EXPECT_EQ(verdict(wait), "met");
    EXPECT_EQ(verdict(wait + "[[expect]]\nevent = \"dive_start\"\n"), "met");
    EXPECT_EQ(verdict(wait + "[[expect]]\ncaught = 1\n"), "idle: line 5: caught 0, expected 1");
    EXPECT_THAT(verdict(wait + "[[expect]]\nevent = \"grab\"\n"), HasSubstr("\"grab\" occurred 0 times"));
    EXPECT_THAT(verdict(wait + "[[expect]]\nnever = \"dive_start\"\n"), HasSubstr("expected never"));
    EXPECT_THAT(verdict(wait + "[[expect]]\norder = [\"dive_start\", \"catch\"]\n"),
                HasSubstr("\"catch\" did not occur"));
    EXPECT_THAT(verdict("[[step]]\ndo = \"wait\"\nuntil = \"catch\"\ntimeout = 2\n"),
                HasSubstr("line 1: step 1 was not done in time"));
    EXPECT_THAT(verdict("timeout = 1\n[[step]]\ndo = \"wait\"\nuntil = \"catch\"\n"),
                HasSubstr("time was over"));
}

} // namespace
} // namespace shoal::game
