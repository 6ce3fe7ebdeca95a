// The program uses no network, and leaves only the files that the command line names.
#include "Program.h"

namespace shoal {
namespace {

namespace fs = std::filesystem;

class Privacy : public tests::Program {
  protected:
    // before: a command that runs it, such as unshare.
    int play(const std::string& name, const std::string& before) const {
        const std::string folder = folder_.string();
        return std::system(("cd " + folder + " && HOME=" + folder + " XDG_DATA_HOME=" + folder +
                            "/data XDG_CONFIG_HOME=" + folder + "/config XDG_CACHE_HOME=" + folder +
                            "/cache " + before + " env -u MESA_SHADER_CACHE_DIR '" + tests::program() +
                            "' play --headless --size 160x90 --at 1 --fps 10 --stats " + name +
                            ".json --screenshot " + name + ".png 2>" + name + ".txt")
                               .c_str());
    }
    std::string bytesOf(const std::string& name) const { return readText(folder_ / name, 1u << 26).value(); }
};

TEST_F(Privacy, ItPlaysTheSameWithoutANetwork) {
    if (std::system("unshare -rn true 2>/dev/null") != 0)
        GTEST_SKIP() << "this user may not leave the network";
    ASSERT_EQ(play("with", "env"), 0) << bytesOf("with.txt");
    ASSERT_EQ(play("without", "unshare -rn"), 0) << bytesOf("without.txt");
    EXPECT_EQ(bytesOf("with.png"), bytesOf("without.png"));
    EXPECT_EQ(bytesOf("with.txt"), bytesOf("without.txt"));
    EXPECT_NE(statisticIn("with.json", "state_hash"), "");
    EXPECT_EQ(statisticIn("with.json", "state_hash"), statisticIn("without.json", "state_hash"));
}

TEST_F(Privacy, ItWritesWhatIsNamedAndNothingElse) {
    ASSERT_EQ(play("a", "env"), 0) << bytesOf("a.txt");
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
        if (entry.path().filename() != "cache")
            names.push_back(entry.path().filename()); // the graphics driver's
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, (std::vector<std::string>{"a.json", "a.png", "a.txt"}));
}

} // namespace
} // namespace shoal
