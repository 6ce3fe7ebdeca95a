// The program uses no network, and leaves only the files that the command line names.
#include "Program.h"

namespace shoal {
namespace {

class Privacy : public tests::Program {
  protected:
    // before: a command that runs it, such as unshare.
    int play(const std::string& name, const std::string& before) {
        environment_ = "-u MESA_SHADER_CACHE_DIR HOME=" + folder_.string() +
                       " XDG_CACHE_HOME=" + folder_.string() + "/cache " + before;
        return run("play --headless --size 160x90 --at 1 --fps 10 --stats " + name + ".json --screenshot " +
                   name + ".png")
            .status;
    }
};

TEST_F(Privacy, ItPlaysTheSameWithoutANetwork) {
    if (std::system("unshare -rn true 2>/dev/null") != 0)
        GTEST_SKIP() << "this user may not leave the network";
    ASSERT_EQ(play("with", ""), 0) << err();
    const std::string said = err();
    ASSERT_EQ(play("without", "unshare -rn"), 0) << err();
    EXPECT_EQ(err(), said);
    EXPECT_EQ(tests::valueOf(readText(folder_ / "with.png")), textOf("without.png"));
    EXPECT_NE(statisticIn("with.json", "state_hash"), "");
    EXPECT_EQ(statisticIn("with.json", "state_hash"), statisticIn("without.json", "state_hash"));
}

TEST_F(Privacy, ItWritesWhatIsNamedAndNothingElse) {
    ASSERT_EQ(play("a", ""), 0) << err();
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
        names.push_back(entry.path().filename());
    std::erase(names, "cache"); // the graphics driver's
    EXPECT_THAT(names, testing::UnorderedElementsAre("a.json", "a.png", "stderr.txt", "stdout.txt"));
}

} // namespace
} // namespace shoal
