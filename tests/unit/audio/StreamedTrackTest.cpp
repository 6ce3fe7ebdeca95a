// A sound in step with a picture, on a device whose clock is not the picture's.
#include "engine/audio/StreamedTrack.h"
#include "Heard.h"

namespace shoal::audio {
namespace {

// A click of a millisecond at the start of each second, else silence; as much as is asked for, at once.
struct Clicks {
    int64_t length = 0, at = 0;
    int seeks = 0;
    size_t maximum = SIZE_MAX; // frames that are ready for a read

    TrackSource sound() {
        return {.length = length,
                .seek = [this](int64_t frame) { at = frame % length, ++seeks; },
                .read =
                    [this](std::span<int16_t> stereo) {
                        const size_t frames = std::min(stereo.size() / 2, maximum);
                        for (size_t i = 0; i < frames; ++i, at = (at + 1) % length)
                            stereo[2 * i] = stereo[2 * i + 1] = at % 48000 < 48 ? 20000 : 0;
                        return frames;
                    }};
    }
};

struct Show {
    Clicks clicks;
    Audio audio;
    std::vector<float> samples;
    std::vector<double> heard_s; // the picture's time at which each click began
    double picture_s = 0, owed = 0;
    float loudest = 0;
    int quiet = 48000;

    explicit Show(double length_s) : audio(std::move(*Audio::open({.loopback = true}))) {
        clicks.length = std::llround(length_s * 48000);
        audio.setTrack(clicks.sound());
    }

    // Shows a picture and plays the sound until the next. skew: share by which the device's clock is fast.
    double frame(double frame_s = 1.0 / 60, double skew = 0, bool paused = false) {
        const double ahead_s = audio.syncTrack(picture_s, 1, paused);
        owed += frame_s * 48000 * (1 + skew);
        const auto frames = static_cast<size_t>(owed);
        owed -= static_cast<double>(frames);
        samples.resize(2 * frames);
        audio.render(samples);
        loudest = 0;
        for (size_t i = 0; i < frames; ++i) {
            loudest = std::max(loudest, std::abs(samples[2 * i]));
            if (std::abs(samples[2 * i]) > 0.2f && quiet > 4800)
                heard_s.push_back(picture_s + static_cast<double>(i) / (48000 * (1 + skew)));
            quiet = std::abs(samples[2 * i]) > 0.2f ? 0 : quiet + 1;
        }
        if (!paused) picture_s += frame_s;
        return ahead_s;
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i) frame();
    }
    // Shows so many pictures; expects that so many clicks or more were heard meanwhile, in step.
    void expectInStep(int pictures, size_t least = 2, double tolerance_ms = 1.5) {
        heard_s.clear();
        frames(pictures);
        ASSERT_GE(heard_s.size(), least);
        for (const double each_s : heard_s) EXPECT_NEAR(offBeat_ms(each_s), 0, tolerance_ms) << each_s;
    }
    static double offBeat_ms(double seconds) { return 1000 * (seconds - std::round(seconds)); }
};

TEST(StreamedTrack, RatesAreBoundedAndSigned) {
    EXPECT_EQ(rateFor(0), 1);
    EXPECT_LT(rateFor(0.004), 1); // ahead: slower
    EXPECT_GT(rateFor(-0.004), 1);
    EXPECT_NEAR(rateFor(10), 0.995, 1e-9);
    EXPECT_NEAR(rateFor(-10), 1.005, 1e-9);
}

TEST(StreamedTrack, StartsInStepToTheMillisecond) {
    for (const double start_s : {0.0, 0.3, 7.77}) {
        Show show(20);
        show.picture_s = start_s;
        show.expectInStep(180);
        EXPECT_EQ(show.clicks.seeks, 1);
    }
}

// Ten minutes on a device that runs 300 parts in a million fast, or slow: alone that would be 180 ms.
TEST(StreamedTrack, StaysInStepForTenMinutes) {
    for (const double skew : {300e-6, -300e-6}) {
        Show show(600);
        while (show.picture_s < 599.5) show.frame(1.0 / 60, skew);
        EXPECT_EQ(show.clicks.seeks, 1) << "without starting anew";
        EXPECT_NEAR(static_cast<double>(show.heard_s.size()), 599, 1);
        double worst_ms = 0;
        for (const double heard_s : show.heard_s)
            worst_ms = std::max(worst_ms, std::abs(Show::offBeat_ms(heard_s)));
        EXPECT_LT(worst_ms, 5); // a hundred times closer than alone; the demand is 40
    }
}

TEST(StreamedTrack, LoopsWithThePicture) {
    Show show(2.5); // clicks at 0, 1 and 2 s of each pass
    while (show.picture_s < 12.4) show.frame();
    ASSERT_EQ(show.clicks.seeks, 1);
    std::vector<double> expected;
    for (int pass = 0; pass < 5; ++pass)
        for (int second = 0; second < 3; ++second) expected.push_back(2.5 * pass + second);
    // The first may be missed: it takes a moment to begin.
    ASSERT_GE(show.heard_s.size() + 1, expected.size());
    const size_t missed = expected.size() - show.heard_s.size();
    for (size_t i = 0; i < show.heard_s.size(); ++i)
        EXPECT_NEAR(show.heard_s[i], expected[i + missed], 0.003);
}

TEST(StreamedTrack, AJumpOfThePictureIsFollowed) {
    Show show(60);
    show.frames(90); // not to a click, which OpenAL Soft 1.24 would fade out
    show.picture_s = 40.5;
    show.expectInStep(180);
    EXPECT_EQ(show.clicks.seeks, 2);
}

TEST(StreamedTrack, PausedItIsSilentAndThenGoesOnInStep) {
    Show show(60);
    show.frames(90);
    for (int i = 0; i < 4; ++i) show.frame(1.0 / 60, 0, true);
    for (int i = 0; i < 240; ++i) {
        show.frame(1.0 / 60, 0, true);
        ASSERT_EQ(show.loudest, 0) << i;
    }
    show.expectInStep(300, 4, 20);
    EXPECT_NEAR(Show::offBeat_ms(show.heard_s.back()), 0, 10); // what the pause left is being corrected
}

TEST(StreamedTrack, AFrameThatTakesLongIsBridgedOrCaughtUpWith) {
    Show show(60);
    show.frames(60);
    show.frame(0.3); // within what is queued
    EXPECT_EQ(show.clicks.seeks, 1);
    show.frames(60);
    EXPECT_EQ(show.clicks.seeks, 1);
    show.frame(2); // far beyond
    show.expectInStep(180);
}

TEST(StreamedTrack, ADecoderThatIsNotReadyIsWaitedFor) {
    Show show(60);
    show.clicks.maximum = 0;
    show.frames(60);
    EXPECT_EQ(show.loudest, 0);
    show.clicks.maximum = SIZE_MAX;
    show.expectInStep(180);
}

TEST(StreamedTrack, AnotherDeviceGoesOnInStep) {
    Show show(60);
    show.frames(90);
    ASSERT_TRUE(show.audio.reopen());
    show.expectInStep(180);
    show.audio.setTrack({});
    for (int i = 0; i < 10; ++i) EXPECT_EQ(show.frame(), 0);
    EXPECT_EQ(show.loudest, 0);
}

TEST(StreamedTrack, HasItsVolume) {
    Show loud(60), soft(60);
    float maximum[2] = {};
    for (int i = 0; i < 100; ++i) {
        for (auto [show, gain, out] : {std::tuple{&loud, 1.0f, &maximum[0]}, {&soft, 0.5f, &maximum[1]}}) {
            show->audio.syncTrack(show->picture_s, gain, false);
            show->samples.resize(1600);
            show->audio.render(show->samples);
            show->picture_s += 1.0 / 60;
            for (const float sample : show->samples) *out = std::max(*out, std::abs(sample));
        }
    }
    EXPECT_NEAR(maximum[0], 20000 / 32768.0, 0.02);
    EXPECT_NEAR(maximum[1] / maximum[0], 0.5, 0.01);
}

// A tone from 45 degrees left of straight ahead (FuMa: X and Y are equal to W), heard by a turned head.
TEST(StreamedTrack, BFormatSurroundsTheHead) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const glm::vec3 up(0, 1, 0);
    const auto heard = [&](float headYaw, float trackYaw) {
        Audio audio = std::move(*Audio::open({.loopback = true}));
        int64_t at = 0;
        audio.setTrack({.length = 480000,
                        .channels = 4,
                        .seek = [&](int64_t frame) { at = frame; },
                        .read =
                            [&](std::span<int16_t> samples) {
                                for (size_t i = 0; i < samples.size(); i += 4, ++at) {
                                    const double tone = 9000 * std::sin(static_cast<double>(at) / 20);
                                    std::fill_n(&samples[i], 3, static_cast<int16_t>(tone));
                                    samples[i + 3] = 0;
                                }
                                return samples.size() / 4;
                            }});
        std::vector<float> samples(1600);
        for (int i = 0; i < 60; ++i) {
            audio.update({.position = {3, 1, -2},
                          .worldFromHead = glm::angleAxis(headYaw, up),
                          .worldFromTrack = glm::angleAxis(trackYaw, up)},
                         {}, {});
            audio.syncTrack(i / 60.0, 1, false);
            audio.render(samples);
        }
        return loudness(samples);
    };
    const double ahead = heard(kPi / 4, 0).both();
    EXPECT_GT(ahead, 0.02);
    constexpr std::array<float, 3> kTurns[] = {{0, 0, -1},       {kPi / 2, 0, 1},  {-kPi / 2, 0, -1},
                                               {0, kPi / 2, -1}, {0, -kPi / 2, 1}, {kPi / 2, kPi / 2, -1},
                                               {kPi / 4, 0, 0},  {0, -kPi / 4, 0}};
    for (const auto& [head, track, side] : kTurns) {
        const Loudness at = heard(head, track);
        const std::string where = testing::PrintToString(std::array{head, track});
        const double balance = at.left / at.right;
        EXPECT_TRUE(side == 0  ? std::abs(balance - 1) < 0.02
                    : side < 0 ? balance > 1.3
                               : balance < 0.77)
            << where << balance;
        EXPECT_NEAR(at.both() / ahead, 1, 0.6) << where;
    }
}

} // namespace
} // namespace shoal::audio
