#include "engine/core/Hash.h"
#include "engine/core/Random.h"
#include "engine/core/ThreadPool.h"
#include "engine/core/WriteFile.h"
#include "tests/TestPaths.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <fstream>

namespace shoal {
namespace {

TEST(ThreadPool, DoesEachPartOnceWhoeverDoesIt) {
    for (const int helpers : {0, 1, 3}) {
        ThreadPool threadPool(helpers);
        for (const int parts : {0, 1, 2, 1000}) {
            std::array<std::atomic<int>, 1000> done{};
            threadPool.parallelFor(parts, [&](int k) { ++done[static_cast<size_t>(k)]; });
            for (int k = 0; k < 1000; ++k)
                ASSERT_EQ(done[static_cast<size_t>(k)], k < parts ? 1 : 0) << k << " of " << parts;
        }
    }
}

TEST(ThreadPool, LeavesWhatIsNotFinished) {
    std::atomic<int> done = 0;
    auto part = [&](int) { ++done; };
    {
        ThreadPool threadPool(1);
        threadPool.start(1 << 30, part);
    }
    EXPECT_LT(done, 1 << 30);
}

// The parts wait for each other, so this ends only if two threads are in the task at once.
TEST(ThreadPool, WorksBesideTheCaller) {
    ThreadPool threadPool(1);
    std::atomic<int> within = 0;
    threadPool.parallelFor(2, [&](int) {
        ++within;
        while (within < 2) {
        }
    });
    EXPECT_EQ(within, 2);
}

TEST(Random, IsPcg32) {
    // The first outputs of O'Neill's reference program, pcg32-demo, for seed 42 and stream 54.
    Random random(42, 54);
    EXPECT_EQ(random.next(), 0xa15c02b7u);
    EXPECT_EQ(random.next(), 0x7b47f409u);
    EXPECT_EQ(random.next(), 0xba1d3330u);
}

TEST(Random, StaysInRange) {
    Random random(7);
    for (int i = 0; i < 100000; ++i) {
        const float unit = random.unit();
        ASSERT_GE(unit, 0);
        ASSERT_LT(unit, 1);
        ASSERT_LT(random.below(3), 3u);
    }
}

TEST(Hash, IsFnv1a) {
    // From the FNV reference test vectors.
    EXPECT_EQ(Hash().value(), 0xcbf29ce484222325ull);
    Hash hash;
    hash.bytes("foobar", 6);
    EXPECT_EQ(hash.value(), 0x85944171f73967e8ull);
}

class Files : public testing::Test {
  protected:
    tests::ScratchFolder folder_;
};

TEST_F(Files, SaysWhyItCannotRead) {
    EXPECT_NE(readText(folder_ / "none").error().reason.find("no such file"), std::string::npos);
    EXPECT_NE(readText(folder_.path()).error().reason.find("folder"), std::string::npos);
    ASSERT_TRUE(writeFileWhole(folder_ / "big", std::string(100, 'x')));
    EXPECT_NE(readText(folder_ / "big", 99).error().reason.find("limit"), std::string::npos);
    EXPECT_TRUE(readText(folder_ / "big", 100));
}

TEST_F(Files, RelativeXdgFoldersAreIgnored) {
    ::setenv("HOME", "/home/diver", 1);
    ::setenv("XDG_DATA_HOME", "relative", 1);
    EXPECT_EQ(scoreFolder(), "/home/diver/.local/share/shoal");
    ::setenv("XDG_DATA_HOME", "/data", 1);
    EXPECT_EQ(scoreFolder(), "/data/shoal");
    ::unsetenv("XDG_DATA_HOME");
}

TEST_F(Files, PicturesGoWhereTheDesktopKeepsThem) {
    ::setenv("HOME", "/home/diver", 1);
    ::setenv("XDG_CONFIG_HOME", folder_.path().c_str(), 1);
    const auto folderIn = [&](const std::string& file) {
        EXPECT_TRUE(writeFileWhole(folder_ / "user-dirs.dirs", file));
        return userFolder(UserFolder::Pictures).string();
    };
    EXPECT_EQ(userFolder(UserFolder::Pictures), "/home/diver/Pictures") << "there is no such file";
    EXPECT_EQ(folderIn("XDG_MUSIC_DIR=\"$HOME/Musik\"\n# a comment\nXDG_PICTURES_DIR=\"$HOME/Bilder\"\n"),
              "/home/diver/Bilder");
    EXPECT_EQ(folderIn("XDG_PICTURES_DIR=\"/data/my \\\"best\\\" pictures\"\n"),
              "/data/my \"best\" pictures");
    EXPECT_EQ(folderIn("XDG_PICTURES_DIR=\"$HOME/\"\n"), "/home/diver/") << "no folder of its own";
    EXPECT_EQ(folderIn("XDG_PICTURES_DIR=\"relative\"\n"), "/home/diver/Pictures");
    EXPECT_EQ(folderIn("#XDG_PICTURES_DIR=\"$HOME/Bilder\"\n"), "/home/diver/Pictures");
    EXPECT_EQ(folderIn("XDG_PICTURES_DIR=\""), "/home/diver/Pictures");
    ::unsetenv("XDG_CONFIG_HOME");
}

} // namespace
} // namespace shoal
