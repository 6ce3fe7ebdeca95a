// Sound files, good and bad.
#include "engine/audio/Audio.h"
#include "tests/TestPaths.h"
#include "tests/unit/Wav.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace shoal::audio {
namespace {

Result<Clip> read(const std::string& bytes) {
    const tests::ScratchFolder folder;
    const Path file = folder / "clip.bin";
    std::ofstream(file, std::ios::binary) << bytes;
    return readClip(file);
}

TEST(Clip, ReadsWhatWasWritten) {
    const std::vector<int16_t> samples = {0, 1000, -1000, 32767, -32768, 5};
    auto clip = read(wavOf(2, 44100, samples));
    ASSERT_TRUE(clip) << clip.error().message();
    EXPECT_EQ(clip->rate_Hz, 44100);
    EXPECT_EQ(clip->channels, 2);
    EXPECT_EQ(clip->samples, samples);
}

TEST(Clip, SaysWhyItCannotBeRead) {
    const auto reason = [](const auto& clip) { return clip ? std::string("read") : clip.error().reason; };
    const std::vector<int16_t> some(64);
    EXPECT_EQ(reason(readClip("/nowhere/a.flac")), "there is no such sound");
    EXPECT_EQ(reason(readClip("/")), "there is no such sound");
    EXPECT_EQ(reason(readClip(dataRoot() / "content" / "species.toml")), "is not a sound that can be read");
    EXPECT_EQ(reason(read("")), "is not a sound that can be read");
    EXPECT_EQ(reason(read(wavOf(3, 48000, some, 120))), "has neither one nor two channels");
    EXPECT_EQ(reason(read(wavOf(1, 100, some))), "has an unusable sample rate");
    EXPECT_EQ(reason(read(wavOf(1, 4000000, some))), "has an unusable sample rate");
    EXPECT_EQ(reason(read(wavOf(1, 48000, {}))), "is empty or longer than a minute");
    EXPECT_EQ(reason(read(wavOf(1, 8000, std::vector<int16_t>(8000 * 61)))),
              "is empty or longer than a minute");
}

TEST(Clip, NoDamageCrashesIt) {
    std::ifstream file(dataRoot() / "content" / "sounds" / "touch.flac", std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(file), {}};
    ASSERT_GT(whole.size(), 1000u);
    for (size_t i = 0; i < 200; ++i) { // a value or a reason, each time
        std::string damaged = whole;
        damaged[(i * 7919) % (i < 100 ? 200 : whole.size())] ^= static_cast<char>(1 + i % 255);
        if (i % 3 == 0) damaged.resize(damaged.size() * (i + 1) / 201);
        const auto clip = read(damaged);
        if (!clip) {
            EXPECT_FALSE(clip.error().reason.empty());
        }
    }
}

} // namespace
} // namespace shoal::audio
