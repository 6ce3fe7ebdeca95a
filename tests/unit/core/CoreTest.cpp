#include "engine/core/Hash.h"
#include "engine/core/Random.h"
#include "engine/core/ThreadPool.h"
#include "engine/core/WriteFile.h"
#include "tests/Test.h"

#include <atomic>
#include <csignal>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>

namespace shoal {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class WriteFile : public testing::Test {
  protected:
    std::vector<std::string> namesIn(const Path& folder) const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }
    std::vector<std::string> names() const { return namesIn(folder_.path()); }
    std::string text(const Path& name) const { return readText(folder_ / name).value(); }

    tests::ScratchFolder folder_;
};

// Writes in a child process on a disk with room for so many bytes of each file. Returns 1 if that succeeds, 0
// if it fails, -1 if a signal ends the process.
int writtenWithin(uint64_t bytes, const std::function<Status()>& write) {
    const pid_t child = ::fork();
    if (child == 0) {
        const rlimit limit{bytes, bytes};
        ::signal(SIGXFSZ, SIG_IGN);
        ::setrlimit(RLIMIT_FSIZE, &limit);
        ::_exit(write() ? 1 : 0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(WriteFile, KeepsThePermissionsOfWhatItReplaces) {
    ASSERT_TRUE(writeFileWhole(folder_ / "a", "one"));
    fs::permissions(folder_ / "a", fs::perms(0640));
    ASSERT_TRUE(writeFileWhole(folder_ / "a", "two"));
    EXPECT_EQ(fs::status(folder_ / "a").permissions(), fs::perms(0640));
}

TEST_F(WriteFile, AFolderOfThatNameStays) {
    ASSERT_TRUE(writeFileWhole(folder_ / "a.txt" / "b.txt", "old"));
    EXPECT_EQ(tests::errorOf(writeFileWhole(folder_ / "a.txt", "new")).message(),
              (folder_ / "a.txt").string() + ": cannot be written: it is a folder");
    EXPECT_EQ(text("a.txt/b.txt"), "old");
    EXPECT_EQ(names(), std::vector<std::string>{"a.txt"});
}

TEST_F(WriteFile, LinksStayLinks) {
    ASSERT_TRUE(writeFileWhole(folder_ / "below/target", "old"));
    fs::create_symlink("below/target", folder_ / "link");
    ASSERT_TRUE(writeFileWhole(folder_ / "link", "new"));
    EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
    EXPECT_EQ(text("below/target"), "new");
    fs::create_symlink("below/absent", folder_ / "dangling");
    ASSERT_TRUE(writeFileWhole(folder_ / "dangling", "made"));
    EXPECT_EQ(text("below/absent"), "made");
    fs::create_symlink("loop", folder_ / "loop");
    EXPECT_FALSE(writeFileWhole(folder_ / "loop", "x"));
}

TEST_F(WriteFile, WritesIntoPipesAndDevices) {
    const Path pipe = folder_ / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::string read;
    std::thread reader([&] {
        std::ifstream stream(pipe);
        std::getline(stream, read, '\0');
    });
    EXPECT_TRUE(writeFileWhole(pipe, "through"));
    reader.join();
    EXPECT_EQ(read, "through");
    EXPECT_TRUE(fs::is_fifo(pipe));
    EXPECT_TRUE(writeFileWhole("/dev/null", "x"));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_THAT(tests::errorOf(writeFileWhole("/dev/full", "x")).message(),
                HasSubstr("/dev/full: cannot be written: No space left"));
    ASSERT_EQ(names(), std::vector<std::string>{"pipe"});
}

// The disk is full after each page, and within one.
TEST_F(WriteFile, AFullDiskLeavesWhatIsThere) {
    const std::string old(3 * 4096, 'o'), fresh(5 * 4096 + 17, 'n');
    for (uint64_t room = 0; room < fresh.size(); room += 2048) {
        ASSERT_TRUE(writeFileWhole(folder_ / "a", old));
        EXPECT_EQ(writtenWithin(room, [&] { return writeFileWhole(folder_ / "a", fresh); }), 0) << room;
        EXPECT_EQ(text("a"), old);
        EXPECT_EQ(names(), std::vector<std::string>{"a"});
    }
}

TEST_F(WriteFile, AFolderAppearsWholeOrNotAtAll) {
    const std::vector<NamedBytes> files = {{"one", std::string(5000, '1')}, {"two", std::string(9000, '2')}};
    for (uint64_t room : {0, 4096, 5000, 8192, 8999}) {
        EXPECT_EQ(writtenWithin(room, [&] { return writeFolderWhole(folder_ / "out", files); }), 0) << room;
        EXPECT_TRUE(names().empty()) << room;
    }
    ASSERT_TRUE(writeFolderWhole((folder_ / "out").string() + "/", files));
    EXPECT_EQ(namesIn(folder_ / "out"), (std::vector<std::string>{"one", "two"}));

    // Nothing is replaced in a folder that is there, and nothing else is touched.
    std::ofstream(folder_ / "out/mine") << "stays";
    const std::vector<NamedBytes> later = {{"one", "new"}, {"two", std::string(9000, '3')}};
    EXPECT_EQ(writtenWithin(4096, [&] { return writeFolderWhole(folder_ / "out", later); }), 0);
    EXPECT_EQ(text("out/one"), files[0].bytes);
    ASSERT_TRUE(writeFolderWhole(folder_ / "out", later));
    EXPECT_EQ(text("out/one"), "new");
    EXPECT_EQ(text("out/mine"), "stays");
    EXPECT_EQ(namesIn(folder_ / "out"), (std::vector<std::string>{"mine", "one", "two"}));
    EXPECT_FALSE(writeFolderWhole(folder_ / "out/mine", later)) << "a file is no folder";
}

// Bytes behind those that are known to be good, which a killed program may have left, are dropped.
TEST_F(WriteFile, AGrowingFileGoesOnBehindWhatIsGood) {
    ASSERT_TRUE(writeFileWhole(folder_ / "a", "good, and half of a rec"));
    auto file = tests::valueOf(GrowingFile::open(folder_ / "a", 4));
    ASSERT_TRUE(file.write(" and more"));
    EXPECT_EQ(text("a"), "good and more");
    ASSERT_TRUE(file.write(", whole"));
    ASSERT_TRUE(file.finish());
    EXPECT_EQ(text("a"), "good and more, whole");
}

TEST_F(WriteFile, OnlyAFileThatIsThereCanBeExtended) {
    EXPECT_THAT(tests::errorOf(GrowingFile::open(folder_ / "a", 1)).message(),
                HasSubstr("cannot be written"));
    EXPECT_TRUE(names().empty());
}

// After each of 200 kills at arbitrary moments, the file is one of those that were written.
TEST_F(WriteFile, AKilledWriterLeavesAWholeFile) {
    const auto textOf = [](int i) {
        return std::string(20'000 + 100 * static_cast<size_t>(i % 50), static_cast<char>('a' + i % 26));
    };
    ASSERT_TRUE(writeFileWhole(folder_ / "a", textOf(0)));
    for (int round = 0; round < 200; ++round) {
        int ready[2];
        ASSERT_EQ(::pipe(ready), 0);
        const pid_t child = ::fork();
        if (child == 0) {
            for (int i = 0;; ++i) {
                if (!writeFileWhole(folder_ / "a", textOf(i))) ::_exit(1);
                if (i >= round % 3) (void)!::write(ready[1], "x", 1); // it writes on while it is killed
            }
        }
        char byte = 0;
        ASSERT_EQ(::read(ready[0], &byte, 1), 1);
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        ::close(ready[0]);
        ::close(ready[1]);
        const std::string found = text("a");
        ASSERT_FALSE(found.empty());
        EXPECT_EQ(found, std::string(found.size(), found[0])) << round;
        EXPECT_GE(found.size(), 20'000u);
    }
}

TEST_F(WriteFile, OutputsAreCheckedBeforeTheWork) {
    const auto refused = [&](std::vector<NamedFile> outputs, std::vector<NamedFile> inputs = {}) {
        const Status status = checkOutputs(outputs, inputs);
        return status ? std::string() : status.error().message();
    };
    const std::string folder = folder_.path().string();
    EXPECT_EQ(refused({{"--out", "a.txt"}, {"--stats", ""}, {"--record", ""}}), "");
    EXPECT_EQ(refused({{"--out", folder_ / "none/a.txt"}}),
              folder + "/none/a.txt: there is no folder " + folder + "/none");
    EXPECT_EQ(refused({{"--out", folder_.path()}}), folder + ": cannot be written: it is a folder");
    EXPECT_THAT(refused({{"--out", folder_ / "a"}, {"--stats", folder_ / "./a"}}),
                HasSubstr("--out and --stats name the same file"));
    ASSERT_TRUE(writeFileWhole(folder_ / "a", ""));
    fs::create_symlink("a", folder_ / "link");
    fs::create_hard_link(folder_ / "a", folder_ / "hard");
    EXPECT_THAT(refused({{"--out", folder_ / "a"}, {"--stats", folder_ / "link"}}), HasSubstr("same file"));
    EXPECT_THAT(refused({{"--out", folder_ / "hard"}, {"--stats", folder_ / "link"}}),
                HasSubstr("same file"));
    EXPECT_THAT(refused({{"--record", folder_ / "a"}}, {{"--hands", folder_ / "link"}}),
                HasSubstr("--record would overwrite what --hands reads"));
    EXPECT_EQ(refused({{"--out", "/dev/null"}, {"--stats", "/dev/null"}}), "");
    EXPECT_FALSE(checkOutputs(std::vector<NamedFile>{{"--out", folder_ / "a/b"}}));
}

TEST_F(WriteFile, AFolderThatCannotBeWrittenToIsSaidBeforeTheWork) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
    fs::permissions(folder_.path(), fs::perms(0500));
    EXPECT_FALSE(checkOutputs(std::vector<NamedFile>{{"--out", folder_ / "a"}}));
    const Status status = writeFileWhole(folder_ / "a", "x");
    EXPECT_FALSE(status);
    fs::permissions(folder_.path(), fs::perms(0700));
}

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

using Files = WriteFile;

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
    EXPECT_EQ(dataFolder(), "/home/diver/.local/share/shoal");
    ::setenv("XDG_DATA_HOME", "/data", 1);
    EXPECT_EQ(dataFolder(), "/data/shoal");
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
