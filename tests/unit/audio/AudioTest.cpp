// Sound rendered to memory, so it can be measured.
#include "Heard.h"
#include "tests/unit/Wav.h"

namespace shoal::audio {
namespace {

TEST(Audio, ASoundOnTheLeftIsLouderOnTheLeft) {
    for (const bool headphones : {false, true}) {
        const Loudness left = hear(tone(400, 1), {.position = {-1, 0, 0}}, headphones);
        EXPECT_GT(left.left, 1.2 * left.right);
        const Loudness right = hear(tone(400, 1), {.position = {1, 0, 0}}, headphones);
        EXPECT_GT(right.right, 1.2 * right.left);
        EXPECT_NEAR(left.left / right.right, 1, 0.25); // alike but for reverberation, which is not symmetric
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
    // that of air, 0.6 to 0.8 ms at the side; in water a quarter: nobody could tell left from right.
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
    // A sound inside the head has no direction: both ears hear it, within the 3 dB of panning laws.
    const Loudness inside = hear(tone(200, 1), {});
    EXPECT_NEAR(inside.left / inside.right, 1, 0.04); // the reverberation: OpenAL Soft 1.24 has 0.027
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

// Level around some frequencies, left and right: Goertzel's sum over the second half of what was rendered.
Loudness bandOf(std::span<const float> stereo, std::initializer_list<double> frequencies_Hz) {
    Loudness sum;
    const size_t frames = stereo.size() / 2, begin = frames / 4;
    for (const double frequency_Hz : frequencies_Hz)
        for (int ear = 0; ear < 2; ++ear) {
            double re = 0, im = 0;
            for (size_t i = begin; i < frames; ++i) {
                const double turn = 2 * std::numbers::pi * frequency_Hz * static_cast<double>(i) / 48000;
                re += static_cast<double>(stereo[2 * i + static_cast<size_t>(ear)]) * std::cos(turn);
                im += static_cast<double>(stereo[2 * i + static_cast<size_t>(ear)]) * std::sin(turn);
            }
            (ear ? sum.right : sum.left) += (re * re + im * im) / static_cast<double>(frames * frames);
        }
    return {std::sqrt(sum.left), std::sqrt(sum.right)};
}

// Sums of sines in whole cycles per half second, so that each falls into its own bin.
Clip chord(std::initializer_list<float> frequencies_Hz) {
    Clip sum = tone(0, 1);
    for (const float frequency_Hz : frequencies_Hz) {
        const Clip one = tone(frequency_Hz, 1);
        for (size_t i = 0; i < sum.samples.size(); ++i)
            sum.samples[i] = static_cast<int16_t>(sum.samples[i] + one.samples[i] / 4);
    }
    return sum;
}

TEST(Audio, WaterLeavesTheCuesOfDirection) {
    // Cues of direction in HRTF, at the same bearings near and far: how much louder the near ear is in the
    // high tones, and how front and back differ there. The water's filter takes from all alike.
    const auto at = [](glm::vec3 direction, float distance_m) {
        const auto samples = render(chord({6000, 7000, 8000, 9000}), {.position = direction * distance_m}, {},
                                    {.headphones = true});
        return bandOf(samples, {6000, 7000, 8000, 9000});
    };
    const auto dB = [](double a, double b) { return 20 * std::log10(a / b); };
    for (const float distance_m : {3.0f, 8.0f}) {
        const Loudness nearSide = at({-1, 0, 0}, 1), farSide = at({-1, 0, 0}, distance_m);
        EXPECT_GT(dB(nearSide.left, nearSide.right), 6); // there is a cue to be kept
        // The reverberation fills the far ear, in OpenAL Soft 1.24 by 9.5 dB at 8 m; in 1.19 by less than 2.
        EXPECT_GT(dB(farSide.left, farSide.right), 6) << distance_m;
        EXPECT_NEAR(dB(farSide.left, farSide.right), dB(nearSide.left, nearSide.right),
                    distance_m < 8 ? 2 : 11);
        const double near = dB(at({0, 0, -1}, 1).both(), at({0, 0, 1}, 1).both());
        const double far = dB(at({0, 0, -1}, distance_m).both(), at({0, 0, 1}, distance_m).both());
        EXPECT_NEAR(far, near, 2) << distance_m;
    }
    // And at any distance the high tones stay within hearing of the low ones: by the filter -24 dB at 8 kHz,
    // less what the reverberation has of the low ones, with which OpenAL Soft 1.24 comes to -30.
    const auto far = render(chord({300, 8000}), {.position = {0, 0, -20}}, {}, {});
    EXPECT_GT(dB(bandOf(far, {8000}).both(), bandOf(far, {300}).both()), -33);
}

// Returns the level after a sound that lasts a tenth of a second, by that of the sound itself.
double echo(float enclosure) {
    auto audio = Audio::open({.loopback = true});
    EXPECT_TRUE(audio);
    audio->add(tone(400, 0.1f));
    const Sound shot{.position = {0, 0, -2}};
    std::vector<float> during(9600), after(48000);
    audio->update({.enclosure = enclosure}, {}, {&shot, 1});
    audio->render(during);
    audio->render(after);
    return loudness(after).both() / loudness(during).both();
}

TEST(Audio, ATunnelReverberatesAndOpenWaterHardly) {
    const double open = echo(0), half = echo(0.5f), tunnel = echo(1);
    EXPECT_NEAR(tunnel / open, 0.8 / 0.12, 0.15 * 0.8 / 0.12); // VoicePool's gains; the sound is in both
    EXPECT_NEAR(half / open, std::sqrt(0.8 / 0.12), 0.15 * std::sqrt(0.8 / 0.12)); // geometrically between
    EXPECT_EQ(echo(7), tunnel);
    EXPECT_EQ(echo(-1), open);
}

TEST(Audio, EnteringATunnelDoesNotClick) {
    auto audio = tests::valueOf(Audio::open({.loopback = true}));
    audio.add(tone(200, 1));
    const Sound emitter{.id = 1, .position = {0, 0, -1}};
    std::vector<float> samples(2 * 800);
    float steepest = 0, before = 0, limit = 0;
    for (int frame = 0; frame < 120; ++frame) {
        audio.update({.enclosure = frame < 60 ? 0.0f : 1.0f}, {&emitter, 1}, {});
        audio.render(samples);
        steepest = 0;
        for (size_t i = 0; i < samples.size(); i += 2) {
            if (frame > 0 || i > 0) steepest = std::max(steepest, std::abs(samples[i] - before));
            before = samples[i];
        }
        if (frame > 30 && frame < 60) limit = std::max(limit, steepest);
        // The echo of a tunnel may double a tone; a click would be far steeper than twice 200 Hz.
        if (frame >= 60) {
            EXPECT_LT(steepest, 3 * limit) << frame;
        }
    }
}

TEST(Audio, NothingClipsWhenEverythingSoundsAtOnce) {
    // A busy moment of the game: a bed, tense music, creatures within reach, a bite; in a tunnel or not.
    for (const float enclosure : {0.0f, 1.0f}) {
        auto audio = tests::valueOf(Audio::open({.loopback = true}));
        for (const char* name : {"bed_open", "struggle", "shark_bite", "fish_pass_small", "music_reef_calm",
                                 "music_reef_tension"})
            audio.add(*readClip(dataRoot() / "content/sounds" / (std::string(name) + ".flac")));
        std::vector<Sound> emitters{{.id = 100, .clip = 0, .gain = 0.45f, .everywhere = true}};
        for (uint32_t i = 0; i < 2; ++i) {
            emitters.push_back({.id = 101 + i, .clip = 4 + static_cast<int>(i), .everywhere = true});
            emitters.push_back(
                {.id = i, .clip = 1, .position = {i ? 0.4f : -0.4f, -0.2f, -0.5f}, .gain = 0.8f});
        }
        std::vector<Sound> shots{{.clip = 2, .position = {0, 0, -0.7f}}};
        for (int i = 0; i < 3; ++i)
            shots.push_back(
                {.clip = 3, .position = {0.5f * static_cast<float>(i - 1), 0, -0.8f}, .gain = 0.8f});
        std::vector<float> samples(2 * 48000);
        audio.update({.enclosure = enclosure}, emitters, shots);
        audio.render(samples);
        float maximum = 0;
        for (const float sample : samples) maximum = std::max(maximum, std::abs(sample));
        EXPECT_LT(maximum, 1) << enclosure;
        EXPECT_GT(maximum, 0.1f);
    }
}

// Layers of music are made to sound together. Elsewhere they would begin at places of their own.
TEST(Audio, EmittersInStepBeginTogether) {
    const auto heard = [](bool inStep, size_t count) {
        auto audio = tests::valueOf(Audio::open({.loopback = true}));
        audio.add(tone(200.5f, 1));
        std::array<Sound, 2> emitters;
        for (uint32_t i = 0; i < 2; ++i)
            emitters[i] = {.id = i + 1, .gain = 0.4f, .everywhere = true, .inStep = inStep};
        audio.update({}, {emitters.data(), count}, {});
        std::vector<float> samples(48000);
        audio.render(samples);
        return loudness(samples).both();
    };
    EXPECT_NEAR(heard(true, 2) / heard(true, 1), 2, 1e-3);
    EXPECT_LT(heard(false, 2) / heard(false, 1), 1.9);
}

TEST(Audio, VolumeScales) {
    const Sound shot{.position = {0, 0, -1}};
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

TEST(Audio, ASourceThatComesNearerSoundsHigher) {
    // Cycles counted by zero crossings. Doppler: f' = f c / (c - k v), c = 1500 m/s, v = 20 m/s towards the
    // head: as in air (k = 4.37) 1.062. Half a second counts 500 half cycles at 500 Hz: one is 0.2 %.
    const auto crossings = [](float velocity_mps) {
        const auto samples =
            render(tone(500, 1), {.position = {0, 0, -20}, .velocity = {0, 0, velocity_mps}}, {}, {});
        int count = 0;
        for (size_t i = 9600; i + 2 < samples.size(); i += 2)
            count += (samples[i] < 0) != (samples[i + 2] < 0);
        return static_cast<double>(count);
    };
    EXPECT_NEAR(crossings(20) / crossings(0), 343.0 / (343 - 20), 0.008);
    EXPECT_LT(crossings(-20), crossings(0));
}

TEST(Audio, AMovingShotPassesFromEarToEar) {
    auto audio = tests::valueOf(Audio::open({.loopback = true}));
    audio.add(tone(400, 2));
    const Sound shot{.position = {-2, 0, -0.5f}, .velocity = {4, 0, 0}};
    audio.update({}, {}, {&shot, 1});
    std::vector<float> samples(2 * 800);
    Loudness first, last;
    for (int frame = 0; frame < 60; ++frame) { // a second at 60 Hz: from 2 m left to 2 m right
        audio.render(samples);
        if (frame == 1) first = loudness(samples);
        last = loudness(samples);
        audio.update({}, {}, {});
    }
    EXPECT_GT(first.left, 1.2 * first.right);
    EXPECT_GT(last.right, 1.2 * last.left);
}

TEST(Audio, TwoAtOnceDoNotMix) {
    auto one = tests::valueOf(Audio::open({.loopback = true}));
    {
        auto other = tests::valueOf(Audio::open({.loopback = true}));
        other.add(tone(700, 1));
        one.add(tone(300, 1));
        const Sound shot{.position = {0, 0, -1}};
        one.update({}, {}, {&shot, 1});
        EXPECT_EQ(other.sounding(), 0);
    }
    EXPECT_EQ(one.sounding(), 1);
    std::vector<float> samples(9600);
    one.render(samples);
    EXPECT_GT(loudness(samples).both(), 0.01);
}

TEST(Audio, OpensTheMachinesDevice) {
    // OpenAL's silent device (Heard.h sets it for these tests): the way of a real one.
    auto audio = tests::valueOf(Audio::open({}));
    audio.add(tone(300, 1));
    const Sound emitter{.id = 1, .position = {0, 0, -1}};
    const Sound shot{.position = {1, 0, 0}};
    for (int i = 0; i < 3; ++i) audio.update({}, {&emitter, 1}, {&shot, 1});
    EXPECT_EQ(audio.sounding(), 4);
    ASSERT_TRUE(audio.reopen());
    EXPECT_EQ(audio.sounding(), 0);
    audio.update({}, {&emitter, 1}, {});
    EXPECT_EQ(audio.sounding(), 1);
}

TEST(AudioDeathTest, WithoutADeviceThereIsAReason) {
    // OpenAL reads its drivers once a process, so this asks in another one.
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    setenv("ALSOFT_DRIVERS", "nosuch", 1);
    EXPECT_EXIT(
        {
            auto audio = Audio::open({});
            std::fprintf(stderr, "%s", audio ? "opened" : audio.error().message().c_str());
            std::exit(audio ? 1 : 0);
        },
        testing::ExitedWithCode(0), "no sound device");
    setenv("ALSOFT_DRIVERS", "null", 1);
}

Result<Clip> read(const std::string& bytes) { return readClip(TemporaryFile("clip.bin", bytes).path); }

TEST(Clip, ReadsWhatWasWritten) {
    const std::vector<int16_t> samples = {0, 1000, -1000, 32767, -32768, 5};
    auto clip = tests::valueOf(read(wavOf(2, 44100, samples)));
    EXPECT_EQ(clip.rate_Hz, 44100);
    EXPECT_EQ(clip.channels, 2);
    EXPECT_EQ(clip.samples, samples);
}

TEST(Clip, SaysWhyItCannotBeRead) {
    const auto reason = [](const auto& clip) { return tests::errorOf(clip).reason; };
    const std::vector<int16_t> some(60);
    EXPECT_EQ(reason(readClip("/nowhere/a.flac")), "there is no such sound");
    EXPECT_EQ(reason(readClip("/")), "there is no such sound");
    EXPECT_EQ(reason(readClip(dataRoot() / "content" / "species.toml")), "is not a sound that can be read");
    EXPECT_EQ(reason(read("")), "is not a sound that can be read");
    EXPECT_EQ(reason(read(wavOf(3, 48000, some))), "has neither one nor two channels");
    EXPECT_EQ(reason(read(wavOf(1, 100, some))), "has an unusable sample rate");
    EXPECT_EQ(reason(read(wavOf(1, 4000000, some))), "has an unusable sample rate");
    EXPECT_EQ(reason(read(wavOf(1, 48000, {}))), "is empty or longer than a minute");
    EXPECT_EQ(reason(read(wavOf(1, 8000, std::vector<int16_t>(8000 * 61)))),
              "is empty or longer than a minute");
}

TEST(Clip, NoDamageCrashesIt) {
    const auto whole = tests::valueOf(readText(dataRoot() / "content/sounds/touch.flac"));
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
