// Tests of the samples that are read from a video's sound, and of their place in time.
#include "engine/media/SoundTrack.h"
#include "engine/media/Check.h"
#include "tests/unit/Wav.h"
#include "tests/unit/media/TestFiles.h"

#include <thread>

namespace shoal::media {
namespace {

// Each frame tells its number, so that every place can be checked to the sample.
int16_t leftOf(int64_t frame) { return static_cast<int16_t>(frame % 30000 + 1); }
int16_t rightOf(int64_t frame) { return static_cast<int16_t>(-(frame % 20000) - 1); }

std::string numbered(int64_t frames) {
    std::vector<int16_t> samples;
    for (int64_t i = 0; i < frames; ++i) {
        samples.push_back(leftOf(i));
        samples.push_back(rightOf(i));
    }
    return wavOf(2, 48000, samples);
}

// Reads as many frames as asked for, however long the decoder takes.
std::vector<int16_t> readAll(SoundTrack& track, size_t frames) {
    const auto channels = static_cast<size_t>(track.channels());
    std::vector<int16_t> samples(channels * frames);
    for (size_t i = 0; i < samples.size(); std::this_thread::yield())
        i += channels * track.read(std::span(samples).subspan(i));
    return samples;
}

constexpr int64_t kSecond = kSoundRate_Hz;

TEST(SoundTrack, GivesEverySampleAndLoops) {
    const TemporaryFile file("loops.wav", numbered(2 * kSecond));
    auto track = tests::valueOf(SoundTrack::open(file.path, 2));
    EXPECT_EQ(track.passLength(), 2 * kSecond);
    track.seek(0);
    const auto samples = readAll(track, 5 * kSecond);
    for (int64_t i = 0; i < 5 * kSecond; ++i) {
        ASSERT_EQ(samples[static_cast<size_t>(2 * i)], leftOf(i % (2 * kSecond))) << i;
        ASSERT_EQ(samples[static_cast<size_t>(2 * i + 1)], rightOf(i % (2 * kSecond))) << i;
    }
}

TEST(SoundTrack, SeeksToTheSample) {
    const TemporaryFile file("seeks.wav", numbered(20 * kSecond));
    auto track = tests::valueOf(SoundTrack::open(file.path, 20));
    for (const int64_t at :
         {int64_t{0}, int64_t{12345}, 19 * kSecond, int64_t{7}, 20 * kSecond - 1, 33 * kSecond + 5}) {
        track.seek(at);
        const auto samples = readAll(track, 3000);
        for (int64_t i = 0; i < 3000; ++i)
            ASSERT_EQ(samples[static_cast<size_t>(2 * i)], leftOf((at + i) % (20 * kSecond)))
                << at << " + " << i;
    }
}

TEST(SoundTrack, FillsUpAndCutsOffToThePictureslength) {
    const TemporaryFile file("fills.wav", numbered(kSecond));
    auto longer = SoundTrack::open(file.path, 1.5), shorter = SoundTrack::open(file.path, 0.5),
         own = SoundTrack::open(file.path, 0);
    ASSERT_TRUE(longer && shorter && own);
    longer->seek(kSecond / 2);
    auto samples = readAll(*longer, 2 * kSecond);
    for (int64_t i = 0; i < 2 * kSecond; ++i) {
        const int64_t at = (kSecond / 2 + i) % (kSecond + kSecond / 2);
        ASSERT_EQ(samples[static_cast<size_t>(2 * i)], at < kSecond ? leftOf(at) : 0) << i;
    }
    longer->seek(kSecond + 100); // where there is nothing but silence
    samples = readAll(*longer, kSecond);
    EXPECT_EQ(samples[0], 0);
    EXPECT_EQ(samples[static_cast<size_t>(2 * (kSecond / 2 - 100))], leftOf(0));
    shorter->seek(0);
    samples = readAll(*shorter, kSecond);
    EXPECT_EQ(samples[static_cast<size_t>(kSecond)], leftOf(0)); // frame of half a second
    EXPECT_EQ(own->passLength(), kSecond);
}

TEST(SoundTrack, ReadsNoMoreThanIsThereAndDoesNotWait) {
    const TemporaryFile file("ahead.wav", numbered(10 * kSecond));
    auto track = tests::valueOf(SoundTrack::open(file.path, 10));
    std::vector<int16_t> all(2 * 10 * kSecond);
    EXPECT_EQ(track.read(all), 0u); // nobody said where from
    track.seek(0);
    readAll(track, 10);
    EXPECT_LE(track.read(all), static_cast<size_t>(kSoundAhead));
}

TEST(SoundTrack, OtherRatesAndChannelsComeAtTheirTime) {
    // A mono tone of 440 Hz with a silent second in its middle, at rates that must be converted.
    for (const uint32_t rate_Hz : {8000u, 22050u, 44100u, 96000u}) {
        std::vector<int16_t> mono;
        for (uint32_t i = 0; i < 3 * rate_Hz; ++i)
            mono.push_back(i / rate_Hz == 1 ? int16_t{0}
                                            : static_cast<int16_t>(12000 * std::sin(2 * std::numbers::pi *
                                                                                    440 * i / rate_Hz)));
        const TemporaryFile file("rate.wav", wavOf(1, rate_Hz, mono));
        auto track = tests::valueOf(SoundTrack::open(file.path, 3));
        for (const int64_t from : {int64_t{0}, kSecond / 2}) {
            track.seek(from);
            const auto samples = readAll(track, static_cast<size_t>(2 * kSecond + kSecond / 2 - from));
            int64_t stops = 0, starts = 0;
            for (int64_t i = 0; i < static_cast<int64_t>(samples.size() / 2); ++i) {
                const bool loud = std::abs(samples[static_cast<size_t>(2 * i)]) > 2000;
                if (loud && from + i < 3 * kSecond / 2) stops = from + i;
                if (loud && from + i > 3 * kSecond / 2 && !starts) starts = from + i;
                EXPECT_EQ(samples[static_cast<size_t>(2 * i)], samples[static_cast<size_t>(2 * i + 1)]);
            }
            EXPECT_NEAR(static_cast<double>(stops), kSecond, 48) << rate_Hz; // a millisecond
            EXPECT_NEAR(static_cast<double>(starts), 2 * kSecond, 48) << rate_Hz;
        }
    }
}

TEST(SoundTrack, AVideosSoundBeginsWithItsPicture) {
    // AAC in MP4: codec delay, packets with time stamps, a picture beside it. The tone starts at 1 s.
    const TemporaryFile file("aac.mp4", "");
    if (!ffmpeg("-f lavfi -i color=c=blue:s=64x32:r=25:d=4 -f lavfi -i "
                "\"aevalsrc='if(gte(t,1),0.5*sin(2*PI*1000*t),0)':s=44100:d=4\" -c:v mpeg4 -c:a aac -b:a 96k",
                file.path))
        GTEST_SKIP() << "needs ffmpeg to make a video";
    EXPECT_NE(tests::valueOf(checkVideo(file.path)).find("; sound in stereo"), std::string::npos);
    auto track = tests::valueOf(SoundTrack::open(file.path, 4));
    for (const int64_t from : {int64_t{0}, 3 * kSecond / 4}) {
        track.seek(from);
        const auto samples = readAll(track, static_cast<size_t>(2 * kSecond));
        int64_t starts = 0;
        for (int64_t i = 0; !starts && i < 2 * kSecond; ++i)
            if (std::abs(samples[static_cast<size_t>(2 * i)]) > 6000) starts = from + i;
        // The codec smears a start over a part of its block of 1024 samples; 10 ms is half of that.
        EXPECT_NEAR(static_cast<double>(starts), kSecond, 480) << from;
    }
}

std::string big32(size_t value) { return number(value, 4, false); }

// PCM in QuickTime, with Google's box SA3D (Spatial Audio RFC) in the order of ACN, at the end of the entry.
TEST(SoundTrack, AmbisonicsComeAsFuMa) {
    for (const size_t order : {size_t{1}, size_t{2}}) {
        const size_t channels = (order + 1) * (order + 1);
        std::string levels,
            box = "SA3D" + std::string(2, 0) + big32(order) + std::string(2, 0) + big32(channels);
        for (size_t i = 0; i < channels; ++i) {
            levels += (i ? "|" : "") + std::to_string(0.25 / static_cast<double>(i + 1));
            box += big32(i);
        }
        box = big32(box.size() + 4) + box;
        const TemporaryFile file("pcm.mov", "");
        if (!ffmpeg("-f lavfi -i \"aevalsrc='" + levels + "':s=48000:d=1\" -c:a pcm_s16le", file.path))
            GTEST_SKIP() << "needs ffmpeg to make a sound";
        std::string bytes = readBytes(file.path);
        const size_t table = bytes.find("stsd"), begin = bytes.rfind("moov", table);
        const auto grow = [&](size_t at) { // the box whose name is there
            const auto* size = reinterpret_cast<const uint8_t*>(&bytes[at - 4]);
            const size_t old = size_t{size[0]} << 24 | size[1] << 16 | size[2] << 8 | size[3];
            bytes.replace(at - 4, 4, big32(old + box.size()));
            return at - 4 + old;
        };
        for (const char* name : {"moov", "trak", "mdia", "minf", "stbl"}) grow(bytes.find(name, begin));
        grow(table + 16);
        bytes.insert(grow(table), box);
        writeBytes(file.path, bytes);

        auto track = tests::valueOf(SoundTrack::open(file.path, 1));
        ASSERT_EQ(track.channels(), 4);
        track.seek(kSecond / 2);
        const auto samples = readAll(track, 1000);
        constexpr double kChannelLevels[] = {0.25 / std::numbers::sqrt2, 0.25 / 4, 0.25 / 2, 0.25 / 3};
        for (size_t i = 0; i < samples.size(); ++i)
            ASSERT_NEAR(samples[i] / 32768.0, kChannelLevels[i % 4], 1e-4) << i;
    }
}

TEST(SoundTrack, SharedOpusHasItsSoundOnTheLeft) {
    const Path file = sharedData("files/amb.mka");
    if (file.empty()) GTEST_SKIP() << "no shared files/amb.mka";
    auto track = tests::valueOf(SoundTrack::open(file, 0));
    ASSERT_EQ(track.channels(), 4);
    track.seek(kSecond);
    const auto samples = readAll(track, 1000);
    double loudest = 0;
    for (size_t i = 0; i < samples.size(); i += 4) {
        loudest = std::max(loudest, std::abs(static_cast<double>(samples[i + 2])));
        EXPECT_NEAR(samples[i] * std::numbers::sqrt2, samples[i + 2], 2);
        EXPECT_NEAR(std::hypot(samples[i + 1], samples[i + 3]), 0, 2);
    }
    EXPECT_GT(loudest, 8000);
}

TEST(SoundTrack, SaysWhyThereIsNone) {
    const auto reason = [](const Path& file) { return tests::errorOf(SoundTrack::open(file, 1)).reason; };
    EXPECT_EQ(reason("/nowhere/a.mp4"), "there is no such file");
    EXPECT_EQ(reason("/"), "there is no such file");
    EXPECT_EQ(reason(dataRoot() / "README.md"), "is not a file with sound that can be read");
    EXPECT_EQ(reason(TemporaryFile("empty.mp4", "").path), "is not a file with sound that can be read");
}

// Damaged files: silence or rubbish, in bounded time, never a crash or a hang.
TEST(SoundTrack, NoDamageHarmsIt) {
    const std::string whole = numbered(kSecond / 4);
    const auto packed = tests::valueOf(readText(dataRoot() / "content/sounds/touch.flac"));
    for (size_t i = 0; i < 120; ++i) {
        std::string bytes = i % 2 ? whole : packed;
        for (size_t k = 0; k < 1 + i % 5; ++k)
            bytes[(i * 7919 + k * 104729) % (i % 3 ? 60 : bytes.size())] ^=
                static_cast<char>(1 + (i + k) % 255);
        if (i % 7 == 0) bytes.resize(bytes.size() * (i + 1) / 121);
        const TemporaryFile file("damaged", bytes);
        auto track = SoundTrack::open(file.path, 0.3);
        if (!track) continue;
        track->seek(static_cast<int64_t>(i) * 100);
        readAll(*track, static_cast<size_t>(kSecond));
    }
}

} // namespace
} // namespace shoal::media
