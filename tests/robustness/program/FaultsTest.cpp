// The program on a full disk, stopped or killed, and with outputs that are not ordinary files: it loses only
// unfinished work, and reports that.
#include "Program.h"
#include "tests/Recorded.h"

#include <chrono>
#include <sys/resource.h>
#include <thread>

namespace shoal {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Faults : public tests::Program {
  protected:
    std::vector<std::string> play(std::vector<std::string> more) const {
        std::vector<std::string> words = {"play", "--headless", "--skip", "objects", "--size", "32x18"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    // Returns the words of a run that also draws pictures.
    std::vector<std::string> draw(std::vector<std::string> more) const {
        more.insert(more.end(), {"--screenshot", "picture.png"});
        return play(std::move(more));
    }
    std::string script() const {
        return "script:" + (tests::sourceFolder() / "tests/bench/looking_around.toml").string();
    }

    // Waits until the child has recorded so many seconds of play.
    void awaitRecording(pid_t child, uint64_t seconds) const {
        const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(10);
        while (std::chrono::steady_clock::now() < until && ::waitpid(child, nullptr, WNOHANG) == 0) {
            const auto reader = sim::RecordingReader::open(folder_ / "a.replay");
            if (reader && reader->ticks() >= seconds * sim::kTickRate_Hz) return;
            std::this_thread::yield();
        }
        ADD_FAILURE() << "it does not record: " << err();
    }
};

void limit(decltype(RLIMIT_AS) resource, rlim_t maximum) {
    const rlimit both{maximum, maximum};
    ::setrlimit(resource, &both);
}

// A session that a signal stops writes all its output files, and the recording is whole.
TEST_F(Faults, SignalsEndADiveInOrder) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const pid_t child =
            start(draw({"--hands", script(), "--fps", "10", "--record", "a.replay", "--stats", "s.json"}));
        awaitRecording(child, 2);
        ::kill(child, signal);
        EXPECT_EQ(end(child), 128 + signal) << err();
        const auto recorded = tests::valueOf(tests::readRecorded(folder_ / "a.replay"));
        EXPECT_THAT(readText(folder_ / "s.json").value(),
                    HasSubstr("\"ticks\": " + std::to_string(recorded.ticks()) + ","));
        EXPECT_EQ(statusOf(play({"--hands", "replay:a.replay"})), 0) << err();
        fs::remove(folder_ / "a.replay");
    }
}

// A recording up to a crash shows the way to it.
TEST_F(Faults, AKilledDiveLeavesItsRecording) {
    const pid_t child = start(draw({"--hands", script(), "--fps", "10", "--record", "a.replay"}));
    awaitRecording(child, 3);
    ::kill(child, SIGKILL);
    EXPECT_EQ(end(child), -SIGKILL);
    EXPECT_EQ(statusOf({"check", "a.replay"}), 0) << err();
    EXPECT_EQ(statusOf(play({"--hands", "replay:a.replay"})), 1);
    EXPECT_THAT(err(), HasSubstr("cut short"));
    EXPECT_THAT(err(), HasSubstr("up to there the states are the same"));
}

TEST_F(Faults, ADiveGoesOnWhenItsRecordingNoLongerFits) {
    const std::vector<std::string> words = play(
        {"--hands", script(), "--at", "4", "--fps", "5", "--screenshot", "a.png", "--record", "a.replay"});
    EXPECT_EQ(statusOf(words, [] { limit(RLIMIT_FSIZE, 8192); }), 1);
    EXPECT_THAT(err(), HasSubstr("a.replay: cannot be written: File too large; the recording ends here"));
    EXPECT_TRUE(fs::exists(folder_ / "a.png")) << "it was played to its end";
    const auto reader = tests::valueOf(sim::RecordingReader::open(folder_ / "a.replay"));
    EXPECT_FALSE(reader.complete());
}

TEST_F(Faults, AFullDiskLeavesOldLightAndPicturesAlone) {
    const auto fullDisk = [] { limit(RLIMIT_FSIZE, 4096); };
    const std::string film = (tests::sourceFolder() / "content/truth/reef_0120.hdr").string();
    for (const std::string format : {"hdr", "exr"}) {
        EXPECT_EQ(statusOf({"light", film, "--out", "new", "--format", format}, fullDisk), 1);
        EXPECT_THAT(err(), HasSubstr("cannot be"));
        EXPECT_FALSE(fs::exists(folder_ / "new"));
        fs::create_directory(folder_ / "old");
        write("old/diffuse." + format, "old");
        EXPECT_EQ(statusOf({"light", film, "--out", "old", "--format", format}, fullDisk), 1);
        EXPECT_EQ(readText(folder_ / ("old/diffuse." + format)).value(), "old");
        EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "old"), {}), 1);
        fs::remove_all(folder_ / "old");
    }
    write("out.hdr", "old");
    EXPECT_EQ(statusOf({"panorama", film, "--out", "out.hdr"}, [] { limit(RLIMIT_FSIZE, 65536); }), 1);
    EXPECT_EQ(readText(folder_ / "out.hdr").value(), "old");
}

TEST_F(Faults, StatisticsThatCannotBeWrittenAreSaid) {
    EXPECT_EQ(statusOf(play({"--at", "0.1", "--stats", "/dev/full", "--record", "/dev/null"})), 1);
    EXPECT_THAT(err(), HasSubstr("/dev/full: cannot be written"));
    EXPECT_EQ(lines(err()), 1) << err();
}

TEST_F(Faults, OutputsAreNeitherOneFileNorAnInput) {
    EXPECT_EQ(statusOf(play({"--stats", "a", "--record", "a"})), 1);
    EXPECT_THAT(err(), HasSubstr("--record and --stats name the same file"));
    write("a.replay", "precious");
    EXPECT_EQ(statusOf(play({"--hands", "replay:a.replay", "--record", "a.replay"})), 1);
    EXPECT_THAT(err(), HasSubstr("--record would overwrite what --hands reads"));
    EXPECT_EQ(readText(folder_ / "a.replay").value(), "precious");
    EXPECT_EQ(statusOf({"panorama", "a.png", "--out", "a.png"}), 1);
    EXPECT_THAT(err(), HasSubstr("would overwrite"));
}

TEST_F(Faults, FewOpenFilesAreEnoughOrSaid) {
    for (const rlim_t files : {8, 12, 16, 20, 40}) {
        const int status =
            statusOf(draw({"--at", "0.5", "--stats", "s.json"}), [&] { limit(RLIMIT_NOFILE, files); });
        EXPECT_TRUE(status == 0 || (status == 1 && !err().empty()) || status == 127)
            << status << ": " << err();
        if (files >= 40) {
            EXPECT_EQ(status, 0) << err();
        }
    }
}

// 64 MB less address space than a dive needs: an error in a sentence. (LLVM, below the driver, says its own.)
TEST_F(Faults, LackOfMemoryIsSaid) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer maps terabytes";
#endif
    const auto playWithin = [&](rlim_t memory_MB) {
        return statusOf(draw({"--at", "0.2"}), [=] { limit(RLIMIT_AS, memory_MB << 20); });
    };
    rlim_t tooLittle_MB = 448, enough_MB = 1024; // more where many processors have many stacks
    for (; playWithin(enough_MB) != 0; enough_MB *= 2) {
        ASSERT_LT(enough_MB, 65536u) << err();
        tooLittle_MB = enough_MB;
    }
    while (enough_MB - tooLittle_MB > 64) {
        const rlim_t middle_MB = (tooLittle_MB + enough_MB) / 2;
        (playWithin(middle_MB) == 0 ? enough_MB : tooLittle_MB) = middle_MB;
    }
    // Threads may come in another order, and need less at once. Mesa's compilers crash without memory.
    int status = 0, crashes = 0;
    for (rlim_t less_MB = enough_MB; status == 0 || (status == -SIGSEGV && ++crashes < 5);
         status = playWithin(less_MB)) {
        ASSERT_GT(less_MB, 64u);
        less_MB -= status == 0 ? 64 : 8;
    }
    EXPECT_TRUE(status == 1 || (status == -SIGABRT && err().find("LLVM ERROR") != std::string::npos))
        << status;
    EXPECT_NE(err(), "");
}

TEST_F(Faults, SharedMemoryIsNotNeeded) {
    if (std::system("unshare -rm umount /dev/shm 2>/dev/null") != 0)
        GTEST_SKIP() << "this user may not unmount";
    const std::string command = tests::program() +
                                " play --headless --skip objects --size 32x18 --at 0.5 --screenshot " +
                                (folder_ / "s.png").string();
    EXPECT_EQ(std::system(("unshare -rm sh -c 'umount /dev/shm && " + command + "'").c_str()), 0);
}

} // namespace
} // namespace shoal
