// Measures the drift between sound and picture over a clip of ten minutes, with a sound card whose clock is
// fast.
#include "engine/audio/Audio.h"
#include "engine/media/SoundTrack.h"

#include "tests/unit/Wav.h"
#include "tests/unit/video_sound/ReadAll.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace shoal {
namespace {

// Clicks at each full second, through the decoder's thread and the mixer, against the picture's time.
TEST(VideoSound, DriftsLessThanFortyMillisecondsInTenMinutes) {
    constexpr int kRate_Hz = 8000, kLength_s = 600;
    constexpr double kFrame_s = 1.0 / 60, kSkew = 200e-6; // a sound card's crystal
    std::vector<int16_t> clip(kRate_Hz * kLength_s);
    for (size_t i = 0; i < clip.size(); ++i)
        if (i % kRate_Hz < 16) clip[i] = 20000; // 2 ms
    const TemporaryFile file("ten_minutes.wav", wavOf(1, kRate_Hz, clip));
    auto track = media::SoundTrack::open(file.path, kLength_s);
    ASSERT_TRUE(track) << track.error().message();
    auto audio = audio::Audio::open({.loopback = true});
    ASSERT_TRUE(audio);
    int seeks = 0;
    audio->setTrack(
        {.length = track->passLength(),
         .seek = [&](int64_t frame) { track->seek(frame), ++seeks; },
         // Waits, because here a second passes in a hundredth.
         .read = [&](std::span<int16_t> stereo) { return media::test::readAll(*track, stereo); }});
    double owed = 0, worst_s = 0, maximum = 0;
    int clicks = 0, quiet = 0;
    std::vector<float> samples;
    for (int64_t frame = 0; frame < static_cast<int64_t>(kLength_s + 5) * 60;
         ++frame) { // and into the next pass
        const double picture_s = static_cast<double>(frame) * kFrame_s;
        audio->syncTrack(std::fmod(picture_s, kLength_s), 1, false);
        owed += kFrame_s * 48000 * (1 + kSkew);
        samples.resize(2 * static_cast<size_t>(owed));
        owed -= std::floor(owed);
        audio->render(samples);
        for (size_t i = 0; i < samples.size(); i += 2) {
            maximum = std::max(maximum, std::abs(static_cast<double>(samples[i])));
            if (++quiet < 4800 || std::abs(samples[i]) < 0.3f) continue;
            quiet = 0;
            const double heard_s = picture_s + static_cast<double>(i) / 96000;
            worst_s = std::max(worst_s, std::abs(heard_s - std::round(heard_s)));
            ++clicks;
        }
    }
    std::printf("video sound: %d clicks in 10 minutes, worst drift %.2f ms\n", clicks, worst_s * 1e3);
    EXPECT_LT(worst_s, 0.040);
    EXPECT_NEAR(clicks, kLength_s + 4, 1);
    EXPECT_EQ(seeks, 1);
    EXPECT_LT(maximum, 1); // nothing clips
}

} // namespace
} // namespace shoal
