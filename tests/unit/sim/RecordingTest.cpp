#include "engine/core/Random.h"
#include "engine/sim/FixedStep.h"
#include "tests/Recorded.h"
#include "tests/Test.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <zlib.h>

namespace shoal::sim {
namespace {

using tests::Recorded;

constexpr size_t kBlockTicks = 120, kInputBytes = 37;

Recorded sample(size_t ticks) {
    Recorded recorded({.seed = 0xffffffffffffffffull, .dive = "reef", .inputBytes = kInputBytes});
    Random random(3);
    std::vector<uint8_t> input(kInputBytes);
    for (size_t i = 0; i < ticks; ++i) {
        input[random.below(kInputBytes)] = static_cast<uint8_t>(random.next());
        recorded.add(input, (uint64_t{random.next()} << 32) | random.next());
    }
    return recorded;
}

// Expects that `read` holds the first ticks of `whole`.
void expectBeginOf(const Recorded& whole, const Recorded& read) {
    ASSERT_LE(read.ticks(), whole.ticks());
    for (size_t i = 0; i < read.ticks(); ++i) {
        EXPECT_TRUE(std::ranges::equal(read.input(i), whole.input(i))) << i;
        EXPECT_EQ(read.hash(i), whole.hash(i)) << i;
    }
}

class RecordingFile : public testing::Test {
  protected:
    tests::ScratchFolder folder_;
    std::string bytes() { return readText(file_).value(); }
    void write(const std::string& text) { std::ofstream(file_, std::ios::binary) << text; }
    Path file_ = folder_ / "a.replay";
};

TEST_F(RecordingFile, ComesBackEqual) {
    for (size_t ticks : {size_t{0}, size_t{1}, kBlockTicks - 1, kBlockTicks, kBlockTicks + 1, size_t{500}}) {
        const Recorded out = sample(ticks);
        ASSERT_TRUE(tests::write(file_, out));
        const auto reader = tests::valueOf(RecordingReader::open(file_));
        EXPECT_TRUE(reader.complete());
        EXPECT_EQ(reader.header(), out.header());
        EXPECT_EQ(reader.ticks(), ticks);
        const auto in = tests::valueOf(tests::readAll(reader));
        EXPECT_EQ(in.ticks(), ticks);
        expectBeginOf(out, in);
    }
}

TEST_F(RecordingFile, OneThatIsCutIsReadUpToItsLastWholeBlock) {
    const Recorded out = sample(3 * kBlockTicks + 5);
    ASSERT_TRUE(tests::write(file_, out));
    const std::string whole = bytes();
    uint64_t before = 0;
    for (size_t length = 0; length < whole.size();
         length += length < 200 || length + 40 > whole.size() ? 1 : 11) {
        write(whole.substr(0, length));
        const auto reader = RecordingReader::open(file_);
        if (!reader) {
            EXPECT_EQ(before, 0u) << length;
            continue;
        }
        EXPECT_FALSE(reader->complete()) << length;
        EXPECT_TRUE(reader->ticks() % kBlockTicks == 0 || reader->ticks() == out.ticks()) << length;
        EXPECT_GE(reader->ticks(), before);
        before = reader->ticks();
        expectBeginOf(out, tests::valueOf(tests::readAll(*reader)));
    }
    EXPECT_EQ(before, out.ticks()); // the mark of its end alone was missing
    write(whole + "x");
    EXPECT_FALSE(RecordingReader::open(file_)->complete());
}

// Ticks before the damage are read correctly, and a damaged file is never taken for complete.
TEST_F(RecordingFile, NoFlippedBitGoesUnseen) {
    const Recorded out = sample(kBlockTicks + 10);
    ASSERT_TRUE(tests::write(file_, out));
    const std::string whole = bytes();
    for (size_t at = 0; at < whole.size(); ++at) {
        std::string bad = whole;
        bad[at] = static_cast<char>(bad[at] ^ (1 << (at % 8)));
        write(bad);
        const auto reader = RecordingReader::open(file_);
        if (!reader) continue;
        EXPECT_FALSE(reader->complete()) << "byte " << at;
        expectBeginOf(out, tests::valueOf(tests::readAll(*reader)));
    }
}

TEST_F(RecordingFile, CopiesReadOnByThemselves) {
    ASSERT_TRUE(tests::write(file_, sample(300)));
    auto first = RecordingReader::open(file_).value();
    for (int i = 0; i < 130; ++i) ASSERT_TRUE(first.next());
    auto second = first;
    const auto a = tests::readAll(first), b = tests::readAll(second);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->ticks(), 170u);
    expectBeginOf(*a, *b);
}

// A process that is killed has recorded all but its last second.
TEST_F(RecordingFile, SurvivesItsWriter) {
    const Recorded out = sample(5 * kBlockTicks + 60);
    const pid_t child = ::fork();
    if (child == 0) {
        auto writer = RecordingWriter::create(file_, out.header());
        for (size_t i = 0; writer && i < out.ticks(); ++i)
            if (!writer->add(out.input(i), out.hash(i))) break;
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    const auto reader = tests::valueOf(RecordingReader::open(file_));
    EXPECT_FALSE(reader.complete());
    EXPECT_EQ(reader.ticks(), 5 * kBlockTicks);
    expectBeginOf(out, tests::readAll(reader).value());
}

// The disk is full after so many bytes: each byte of the file once.
TEST_F(RecordingFile, AFullDiskIsSaidAndWhatIsWholeIsRead) {
    const Recorded out = sample(2 * kBlockTicks + 30);
    ASSERT_TRUE(tests::write(file_, out));
    const auto size = std::filesystem::file_size(file_);
    for (uint64_t room = 0; room < size; room += 61) {
        std::filesystem::remove(file_);
        const pid_t child = ::fork();
        if (child == 0) {
            const rlimit limit{room, room};
            ::signal(SIGXFSZ, SIG_IGN);
            ::setrlimit(RLIMIT_FSIZE, &limit);
            ::_exit(tests::write(file_, out) ? 1 : 0);
        }
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0)
            << "said to be written into " << room << " bytes";
        const auto reader = RecordingReader::open(file_);
        if (!reader) continue;
        EXPECT_FALSE(reader->complete());
        expectBeginOf(out, tests::readAll(*reader).value());
    }
}

// Whole numbers that are negative, too large or fractions are refused too.
TEST_F(RecordingFile, NumbersOfItsHeaderThatAreNoneAreRefused) {
    const auto with = [&](const std::string& number, const std::string& inputBytes = "64") {
        const std::string text = R"({"version":5,"tick_rate_Hz":120,"seed":)" + number +
                                 R"(,"dive":"reef","input_bytes":)" + inputBytes + R"(,"settings":{}})";
        const std::array<uint32_t, 2> prefix = {
            static_cast<uint32_t>(text.size()),
            static_cast<uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size()))};
        write("SHOALRE2" + std::string(reinterpret_cast<const char*>(prefix.data()), sizeof prefix) + text);
        const auto reader = RecordingReader::open(file_);
        return reader ? "accepted" : reader.error().reason;
    };
    EXPECT_EQ(with("7"), "accepted");
    for (const char* none : {"nan", "-nan", "inf", "1e999", "1e300", "-1", "1.5", "\"7\"", "0x7"}) {
        EXPECT_EQ(with(none), "has a header that cannot be read") << none;
        EXPECT_NE(with("7", none), "accepted") << none;
    }
    EXPECT_NE(with("7", "4294967360"), "accepted"); // 64 in its lower 32 bits
}

TEST(Recording, NamesTheTickThatDiffers) {
    EXPECT_TRUE(sameState(7, 3, 3));
    EXPECT_THAT(tests::errorOf(sameState(7, 3, 4)).reason, testing::HasSubstr("tick 7"));
}

TEST(FixedStep, AnyDisplayRateGivesTheSameTicks) {
    for (int fps : {24, 30, 50, 60, 72, 90, 120, 144, 240, 1000}) {
        FixedStep step;
        int ticks = 0;
        for (int frame = 0; frame < 100 * fps; ++frame) ticks += step.advance(1.0 / fps);
        // Frame times are whole nanoseconds: 100 s of them err by at most half of one per frame.
        EXPECT_NEAR(ticks, 12000, 1) << fps;
    }
}

TEST(FixedStep, ALongFrameIsCaughtUpAndAVeryLongOneForgotten) {
    FixedStep step;
    EXPECT_EQ(step.advance(0.3), 36);
    EXPECT_EQ(step.advance(10), 60);
    EXPECT_EQ(step.advance(-1), 0);
    EXPECT_EQ(step.advance(std::numeric_limits<double>::quiet_NaN()), 0);
    EXPECT_EQ(step.advance(std::numeric_limits<double>::infinity()), 0);
}

TEST(FixedStep, AlphaIsTheRemainder) {
    FixedStep step;
    EXPECT_EQ(step.advance(1.5 / kTickRate_Hz), 1);
    EXPECT_NEAR(step.alpha(), 0.5f, 1e-6f); // half a nanosecond of 8.3 ms
    EXPECT_EQ(step.advance(0.4999 / kTickRate_Hz), 0);
    EXPECT_LT(step.alpha(), 1.0f);
    EXPECT_GT(step.alpha(), 0.99f);
}

} // namespace
} // namespace shoal::sim
