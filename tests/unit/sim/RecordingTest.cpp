#include "engine/sim/Recording.h"

#include "engine/core/Random.h"
#include "tests/TestPaths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace shoal::sim {
namespace {

using testing::HasSubstr;

Recording sample(size_t ticks) {
    RecordingHeader header;
    header.seed = 0xffffffffffffffffull;
    header.dive = "reef";
    header.inputBytes = 37;
    Recording recording(header, ticks);
    Random random(3);
    std::vector<uint8_t> input(37);
    for (size_t i = 0; i < ticks; ++i) {
        input[random.below(37)] = static_cast<uint8_t>(random.next());
        recording.add(input, (uint64_t{random.next()} << 32) | random.next());
    }
    return recording;
}

class RecordingFile : public testing::Test {
  protected:
    tests::ScratchFolder folder_;
    std::string bytes() { return readText(file_).value(); }
    void write(const std::string& text) { ASSERT_TRUE(writeFileWhole(file_, text)); }
    Path file_ = folder_ / "a.rec";
};

TEST_F(RecordingFile, ComesBackEqual) {
    for (size_t ticks : {0u, 1u, 500u}) {
        const Recording out = sample(ticks);
        ASSERT_TRUE(writeRecording(file_, out));
        const auto in = readRecording(file_);
        ASSERT_TRUE(in) << in.error().message();
        EXPECT_EQ(in->header(), out.header());
        ASSERT_EQ(in->ticks(), ticks);
        for (size_t i = 0; i < ticks; ++i) {
            EXPECT_TRUE(std::ranges::equal(in->input(i), out.input(i))) << i;
            EXPECT_EQ(in->hash(i), out.hash(i));
        }
    }
}

TEST_F(RecordingFile, EveryTruncationIsAnError) {
    ASSERT_TRUE(writeRecording(file_, sample(20)));
    const std::string whole = bytes();
    for (size_t length = 0; length < whole.size(); ++length) {
        write(whole.substr(0, length));
        EXPECT_FALSE(readRecording(file_)) << length << " of " << whole.size() << " bytes";
    }
    write(whole + "x");
    EXPECT_FALSE(readRecording(file_));
}

TEST_F(RecordingFile, EveryFlippedBitIsAnError) {
    ASSERT_TRUE(writeRecording(file_, sample(10)));
    const std::string whole = bytes();
    for (size_t at = 0; at < whole.size(); ++at) {
        std::string bad = whole;
        bad[at] = static_cast<char>(bad[at] ^ (1 << (at % 8)));
        write(bad);
        const auto read = readRecording(file_);
        // The tick count alone lies outside the checksum; it is checked against the unpacked length.
        EXPECT_FALSE(read) << "byte " << at;
    }
}

TEST_F(RecordingFile, LimitsHoldBeforeMemoryIsTaken) {
    ASSERT_TRUE(writeRecording(file_, sample(100)));
    const auto read = readRecording(file_, 100 * 45 - 1);
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message(), HasSubstr("more ticks than are allowed"));
    EXPECT_FALSE(readRecording(file_.string() + ".absent"));
}

TEST(Recording, NamesTheFirstTickThatDiffers) {
    const Recording recording = sample(10);
    for (size_t i = 0; i < 10; ++i) EXPECT_TRUE(recording.compare(i, recording.hash(i)));
    const Status differs = recording.compare(7, recording.hash(7) + 1);
    ASSERT_FALSE(differs);
    EXPECT_THAT(differs.error().reason, HasSubstr("tick 7"));
    EXPECT_FALSE(recording.compare(10, 0));
}

} // namespace
} // namespace shoal::sim
