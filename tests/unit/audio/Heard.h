// Measurements of one rendered sound.
#pragma once

#include "engine/audio/Audio.h"
#include "tests/Test.h"

namespace shoal::audio {

// Selects OpenAL's null driver: tests are silent and need no sound card.
inline const int kSilentDevice = setenv("ALSOFT_DRIVERS", "null", 0);

inline Clip tone(float frequency_Hz, float seconds) {
    Clip clip;
    for (int i = 0; i < static_cast<int>(seconds * 48000); ++i)
        clip.samples.push_back(static_cast<int16_t>(
            16000 * std::sin(2 * std::numbers::pi_v<float> * frequency_Hz * static_cast<float>(i) / 48000)));
    return clip;
}

struct Loudness {
    double left = 0, right = 0; // root mean square
    double both() const { return std::sqrt((left * left + right * right) / 2); }
};

inline Loudness loudness(std::span<const float> stereo) {
    Loudness sum;
    for (size_t i = 0; i < stereo.size(); i += 2) {
        sum.left += static_cast<double>(stereo[i] * stereo[i]);
        sum.right += static_cast<double>(stereo[i + 1] * stereo[i + 1]);
    }
    const double frames = static_cast<double>(stereo.size()) / 2;
    return {std::sqrt(sum.left / frames), std::sqrt(sum.right / frames)};
}

// Renders half a second of what the listener hears.
inline std::vector<float> render(const Clip& clip, const Sound& shot, const Listener& listener,
                                 AudioOptions options) {
    options.loopback = true;
    auto audio = tests::valueOf(Audio::open(options));
    EXPECT_EQ(audio.headphones(), options.headphones);
    audio.add(clip);
    audio.update(listener, {}, {&shot, 1});
    std::vector<float> samples(48000);
    audio.render(samples);
    return samples;
}

inline Loudness hear(const Clip& clip, const Sound& shot, bool headphones = false, float volume = 1) {
    return loudness(render(clip, shot, {}, {.headphones = headphones, .volume = volume}));
}

} // namespace shoal::audio
