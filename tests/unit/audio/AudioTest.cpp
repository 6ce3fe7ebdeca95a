// Sound rendered to memory, so it can be measured.
#include "engine/audio/Audio.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shoal::audio {
namespace {

Clip tone(float frequency_Hz, float seconds) {
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

// Half a second of what is heard.
Loudness hear(const Clip& clip, const Shot& shot, bool headphones = false, float volume = 1) {
    auto audio = Audio::open({.headphones = headphones, .loopback = true, .volume = volume});
    EXPECT_TRUE(audio) << audio.error().sentence();
    if (!audio) return {};
    audio->add(clip);
    audio->update({}, {}, {&shot, 1});
    std::vector<float> samples(48000);
    audio->render(samples);
    Loudness loudness;
    for (size_t i = 0; i < samples.size(); i += 2) {
        loudness.left += static_cast<double>(samples[i] * samples[i]);
        loudness.right += static_cast<double>(samples[i + 1] * samples[i + 1]);
    }
    loudness.left = std::sqrt(loudness.left / 24000);
    loudness.right = std::sqrt(loudness.right / 24000);
    return loudness;
}

TEST(Audio, ASoundOnTheLeftIsLouderOnTheLeft) {
    for (const bool headphones : {false, true}) {
        const Loudness left = hear(tone(400, 1), {.position = {-1, 0, 0}}, headphones);
        EXPECT_GT(left.left, 1.2 * left.right);
        const Loudness right = hear(tone(400, 1), {.position = {1, 0, 0}}, headphones);
        EXPECT_GT(right.right, 1.2 * right.left);
    }
}

TEST(Audio, NearIsLouderThanFar) {
    const double near = hear(tone(200, 1), {.position = {0, 0, -1}}).both();
    const double far = hear(tone(200, 1), {.position = {0, 0, -4}}).both();
    EXPECT_GT(near, 2 * far);
    EXPECT_GT(far, 0);
}

TEST(Audio, WaterTakesTheHighTonesOfWhatIsFar) {
    const auto ratio = [](float distance_m) {
        const glm::vec3 at(0, 0, -distance_m);
        return hear(tone(8000, 1), {.position = at}).both() / hear(tone(150, 1), {.position = at}).both();
    };
    EXPECT_LT(ratio(6), 0.6 * ratio(0.7f));
}

TEST(Audio, VolumeScales) {
    const Shot shot{.position = {0, 0, -1}};
    const double full = hear(tone(300, 1), shot).both();
    EXPECT_NEAR(hear(tone(300, 1), shot, false, 0.5f).both() / full, 0.5, 0.01); // linear gain
    EXPECT_EQ(hear(tone(300, 1), shot, false, 0).both(), 0);
}

TEST(Audio, EmittersGoOnWhileListedAndEndAfter) {
    auto audio = Audio::open({.loopback = true});
    ASSERT_TRUE(audio);
    audio->add(tone(300, 0.1f)); // shorter than what is rendered: it loops
    const Emitter emitter{.id = 7, .position = {0, 0, -1}};
    std::vector<float> samples(48000);
    const auto energy = [&] {
        audio->render(samples);
        double sum = 0;
        for (size_t i = samples.size() / 2; i < samples.size(); ++i)
            sum += static_cast<double>(samples[i] * samples[i]);
        return sum;
    };
    for (int i = 0; i < 3; ++i) {
        audio->update({}, {&emitter, 1}, {});
        EXPECT_GT(energy(), 1);
    }
    audio->update({}, {}, {});
    for (int i = 0; i < 6; ++i) energy(); // the reverberation dies away
    EXPECT_LT(energy(), 1e-3);
}

TEST(Audio, TheSameCallsGiveTheSameSamples) {
    const auto once = [] {
        auto audio = Audio::open({.loopback = true});
        EXPECT_TRUE(audio);
        audio->add(tone(500, 1));
        const Shot shot{.position = {0.4f, 0.2f, -0.7f}};
        audio->update({}, {}, {&shot, 1});
        std::vector<float> samples(9600);
        audio->render(samples);
        return samples;
    };
    EXPECT_EQ(once(), once());
}

TEST(Audio, MoreSoundsThanSourcesAreLeftOut) {
    auto audio = Audio::open({.loopback = true});
    ASSERT_TRUE(audio);
    audio->add(tone(300, 1));
    const std::vector<Shot> shots(100);
    audio->update({}, {}, shots);
    std::vector<float> samples(960);
    audio->render(samples);
    for (const float sample : samples) ASSERT_TRUE(std::isfinite(sample));
}

TEST(Clip, SaysWhyItCannotBeRead) {
    EXPECT_FALSE(readClip("/nowhere/a.flac"));
    EXPECT_FALSE(readClip(dataRoot() / "content" / "species.toml"));
}

} // namespace
} // namespace shoal::audio
