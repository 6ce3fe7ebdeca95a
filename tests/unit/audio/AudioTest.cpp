// Sound rendered to memory, so it can be measured.
#include "Heard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace shoal::audio {
namespace {

TEST(Audio, ASoundOnTheLeftIsLouderOnTheLeft) {
    for (const bool headphones : {false, true}) {
        const Loudness left = hear(tone(400, 1), {.position = {-1, 0, 0}}, headphones);
        EXPECT_GT(left.left, 1.2 * left.right);
        const Loudness right = hear(tone(400, 1), {.position = {1, 0, 0}}, headphones);
        EXPECT_GT(right.right, 1.2 * right.left);
        EXPECT_NEAR(left.left / right.right, 1,
                    0.25); // alike but for the reverberation, which is not symmetric
    }
}

TEST(Audio, TheHeadTurnsTheWorld) {
    // A quarter turn to the left about +Y: what was ahead is now to the right.
    const glm::quat turned = glm::angleAxis(std::numbers::pi_v<float> / 2, glm::vec3(0, 1, 0));
    const auto samples = render(tone(400, 1), {.position = {0, 0, -1}}, {.worldFromHead = turned}, {});
    const Loudness heard = loudness(samples);
    EXPECT_GT(heard.right, 1.2 * heard.left);
}

TEST(Audio, HeadphonesLetTheNearEarHearFirst) {
    // Low noise-free click from the left: the right ear hears it later by the width of a head. The HRTF is
    // that of air, 0.6 to 0.8 ms at the side; in water it would be a quarter, and nobody could tell left from
    // right.
    Clip click;
    click.samples.assign(4800, 0);
    for (int i = 0; i < 24; ++i) click.samples[200 + i] = 16000;
    const auto samples = render(click, {.position = {-1, 0, 0}}, {}, {.headphones = true, .loopback = true});
    double best = 0;
    int lag = 0;
    for (int shift = -60; shift <= 60; ++shift) {
        double sum = 0;
        for (int i = 100; i < 1500; ++i)
            sum += static_cast<double>(samples[2 * i]) * static_cast<double>(samples[2 * (i + shift) + 1]);
        if (sum > best) best = sum, lag = shift;
    }
    EXPECT_GE(lag, 19); // 0.4 ms
    EXPECT_LE(lag, 48); // 1.0 ms
}

TEST(Audio, NearIsLouderThanFar) {
    // Nine times the reference distance: 1 / 9 of the level but for the reverberation, which falls less.
    const double near = hear(tone(200, 1), {.position = {0, 0, -0.7f}}).both();
    const double far = hear(tone(200, 1), {.position = {0, 0, -6.3f}}).both();
    EXPECT_GT(near, 5 * far);
    EXPECT_LT(near, 10 * far);
}

TEST(Audio, WithinReachOfTheHeadASoundKeepsItsLevel) {
    const double at07 = hear(tone(200, 1), {.position = {0, 0, -0.7f}}).both();
    for (const float distance_m : {0.05f, 0.3f, 0.6f}) {
        const double level = hear(tone(200, 1), {.position = {0, 0, -distance_m}}).both();
        EXPECT_NEAR(20 * std::log10(level / at07), 0, 0.5) << distance_m; // dB
    }
    // In the very head it has no direction: both ears, at most the 3 dB that panning law may differ by.
    const Loudness inside = hear(tone(200, 1), {});
    EXPECT_NEAR(inside.left / inside.right, 1, 0.02);
    EXPECT_NEAR(20 * std::log10(inside.both() / at07), 0, 3.1);
}

TEST(Audio, WaterTakesTheHighTonesOfWhatIsFar) {
    const auto ratio = [](float distance_m) {
        const glm::vec3 at(0, 0, -distance_m);
        return hear(tone(8000, 1), {.position = at}).both() / hear(tone(150, 1), {.position = at}).both();
    };
    double before = 1;
    for (const float distance_m : {0.7f, 2.0f, 6.0f}) { // each further one duller
        const double now = ratio(distance_m);
        EXPECT_LT(now, before) << distance_m;
        before = now;
    }
    EXPECT_LT(ratio(6), 0.6 * ratio(0.7f));
}

TEST(Audio, VolumeScales) {
    const Shot shot{.position = {0, 0, -1}};
    const double full = hear(tone(300, 1), shot).both();
    EXPECT_NEAR(hear(tone(300, 1), shot, false, 0.5f).both() / full, 0.5, 0.01); // linear gain
    EXPECT_EQ(hear(tone(300, 1), shot, false, 0).both(), 0);
}

TEST(Audio, AStereoBedComesOutAsItIs) {
    Clip bed{48000, 2, {}};
    for (int i = 0; i < 48000; ++i) {
        bed.samples.push_back(static_cast<int16_t>(9000 * std::sin(i * 0.05)));
        bed.samples.push_back(static_cast<int16_t>(4000 * std::sin(i * 0.11)));
    }
    for (const bool headphones : {false, true}) {
        const auto samples =
            render(bed, {.everywhere = true}, {}, {.headphones = headphones, .loopback = true});
        const Loudness heard = loudness(samples);
        // Sines of these amplitudes; OpenAL's own filters on the way to the ears leave 5 % of the other side.
        EXPECT_NEAR(heard.left, 9000 / 32768.0 / std::numbers::sqrt2, 0.01) << headphones;
        EXPECT_NEAR(heard.right, 4000 / 32768.0 / std::numbers::sqrt2, 0.01) << headphones;
    }
}

TEST(Audio, WhatComesNearerSoundsHigher) {
    // Cycles counted by zero crossings. Doppler: f' = f c / (c - k v), c = 1480 m/s, k = 4 (Medium.cpp),
    // v = 20 m/s towards the head: 1.057. Half a second counts 500 half cycles at 500 Hz: one is 0.2 %.
    const auto crossings = [](float velocity_mps) {
        const auto samples =
            render(tone(500, 1), {.position = {0, 0, -20}, .velocity = {0, 0, velocity_mps}}, {}, {});
        int count = 0;
        for (size_t i = 9600; i + 2 < samples.size(); i += 2)
            count += (samples[i] < 0) != (samples[i + 2] < 0);
        return static_cast<double>(count);
    };
    EXPECT_NEAR(crossings(20) / crossings(0), 1480.0 / (1480 - 80), 0.008);
    EXPECT_LT(crossings(-20), crossings(0));
}

TEST(Audio, AMovingShotPassesFromEarToEar) {
    auto audio = Audio::open({.loopback = true});
    ASSERT_TRUE(audio);
    audio->add(tone(400, 2));
    const Shot shot{.position = {-2, 0, -0.5f}, .velocity = {4, 0, 0}};
    audio->update({}, {}, {&shot, 1});
    std::vector<float> samples(2 * 800);
    Loudness first, last;
    for (int frame = 0; frame < 60; ++frame) { // a second at 60 Hz: from 2 m left to 2 m right
        audio->render(samples);
        if (frame == 1) first = loudness(samples);
        last = loudness(samples);
        audio->update({}, {}, {});
    }
    EXPECT_GT(first.left, 1.2 * first.right);
    EXPECT_GT(last.right, 1.2 * last.left);
}

TEST(Audio, TheSameCallsGiveTheSameSamples) {
    const auto once = [](bool headphones) {
        return render(tone(500, 1), {.position = {0.4f, 0.2f, -0.7f}}, {},
                      {.headphones = headphones, .loopback = true});
    };
    EXPECT_EQ(once(false), once(false));
    EXPECT_EQ(once(true), once(true));
    EXPECT_NE(once(false), once(true));
}

TEST(Audio, TwoAtOnceDoNotMix) {
    auto one = Audio::open({.loopback = true});
    ASSERT_TRUE(one);
    {
        auto other = Audio::open({.loopback = true});
        ASSERT_TRUE(other);
        other->add(tone(700, 1));
        one->add(tone(300, 1));
        const Shot shot{.position = {0, 0, -1}};
        one->update({}, {}, {&shot, 1});
        EXPECT_EQ(other->sounding(), 0);
    }
    EXPECT_EQ(one->sounding(), 1);
    std::vector<float> samples(9600);
    one->render(samples);
    EXPECT_GT(loudness(samples).both(), 0.01);
}

TEST(Audio, OpensTheMachinesDevice) {
    // OpenAL's silent device (Heard.h sets it for these tests): the way of a real one.
    auto audio = Audio::open({});
    ASSERT_TRUE(audio) << audio.error().sentence();
    audio->add(tone(300, 1));
    const Emitter emitter{.id = 1, .position = {0, 0, -1}};
    const Shot shot{.position = {1, 0, 0}};
    for (int i = 0; i < 3; ++i) audio->update({}, {&emitter, 1}, {&shot, 1});
    EXPECT_EQ(audio->sounding(), 4);
    ASSERT_TRUE(audio->reopen());
    EXPECT_EQ(audio->sounding(), 0);
    audio->update({}, {&emitter, 1}, {});
    EXPECT_EQ(audio->sounding(), 1);
}

TEST(AudioDeathTest, WithoutADeviceThereIsAReason) {
    // OpenAL reads its drivers once a process, so this asks in another one.
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    setenv("ALSOFT_DRIVERS", "nosuch", 1);
    EXPECT_EXIT(
        {
            auto audio = Audio::open({});
            std::fprintf(stderr, "%s", audio ? "opened" : audio.error().sentence().c_str());
            std::exit(audio ? 1 : 0);
        },
        testing::ExitedWithCode(0), "no sound device");
    setenv("ALSOFT_DRIVERS", "null", 1);
}

} // namespace
} // namespace shoal::audio
