// Who sounds, for how long, and who gives way.
#include "Heard.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shoal::audio {
namespace {

// One frame at 60 Hz.
struct Stage {
    Audio audio;
    std::vector<float> samples = std::vector<float>(2 * 800);

    Stage() : audio(std::move(*Audio::open({.loopback = true}))) { audio.add(tone(300, 0.5f)); }

    void frame(std::span<const Emitter> emitters, std::span<const Shot> shots = {}) {
        audio.update({}, emitters, shots);
        audio.render(samples);
    }
    double level() const { return loudness(samples).both(); }
    float steepest() const {
        float step = 0;
        for (size_t i = 2; i < samples.size(); ++i)
            step = std::max(step, std::abs(samples[i] - samples[i - 2]));
        return step;
    }
};

const Emitter kAhead{.id = 7, .position = {0, 0, -0.5f}};

TEST(Voices, EmittersGoOnWhileListedAndEndAfter) {
    Stage stage;
    for (int i = 0; i < 90; ++i) stage.frame({&kAhead, 1}); // thrice the clip: it loops
    EXPECT_GT(stage.level(), 0.1);
    for (int i = 0; i < 6; ++i) stage.frame({});
    EXPECT_EQ(stage.audio.sounding(), 0);
    for (int i = 0; i < 180; ++i) stage.frame({}); // the reverberation dies away
    EXPECT_LT(stage.level(), 1e-4);
}

TEST(Voices, AnEmitterEndsWithoutAClick) {
    Stage stage;
    for (int i = 0; i < 20; ++i) stage.frame({&kAhead, 1});
    const float steepest = stage.steepest();
    for (int i = 0; i < 6; ++i) {
        stage.frame({});
        // A tone that is faded within 800 samples is steeper by a part in 30 at most; a cut would be by 25.
        EXPECT_LT(stage.steepest(), 1.1f * steepest) << i;
    }
}

TEST(Voices, AnEmitterThatComesBackGoesOn) {
    Stage stage;
    stage.frame({&kAhead, 1});
    stage.frame({});
    stage.frame({&kAhead, 1});
    EXPECT_EQ(stage.audio.sounding(), 1);
    for (int i = 0; i < 10; ++i) stage.frame({&kAhead, 1});
    EXPECT_GT(stage.level(), 0.1);
}

TEST(Voices, AnEmitterMoves) {
    Stage stage;
    Emitter emitter = kAhead;
    emitter.position = {-0.7f, 0, 0};
    for (int i = 0; i < 10; ++i) stage.frame({&emitter, 1});
    EXPECT_GT(loudness(stage.samples).left, 1.2 * loudness(stage.samples).right);
    emitter.position = {0.7f, 0, 0};
    for (int i = 0; i < 10; ++i) stage.frame({&emitter, 1});
    EXPECT_GT(loudness(stage.samples).right, 1.2 * loudness(stage.samples).left);
    EXPECT_EQ(stage.audio.sounding(), 1);
}

TEST(Voices, ShotsEndByThemselves) {
    Stage stage;
    const Shot shot{.position = {0, 0, -1}};
    stage.frame({}, {&shot, 1});
    EXPECT_EQ(stage.audio.sounding(), 1);
    for (int i = 0; i < 40; ++i) stage.frame({}); // 0.67 s of a clip of 0.5
    EXPECT_EQ(stage.audio.sounding(), 0);
}

TEST(Voices, TheNearTakesThePlaceOfTheFar) {
    Stage stage;
    const std::vector<Shot> far(Audio::kSources, Shot{.position = {-300, 0, 0}});
    stage.frame({}, far);
    EXPECT_EQ(stage.audio.sounding(), Audio::kSources);
    const Shot near{.position = {0.5f, 0, 0}};
    stage.frame({}, {&near, 1});
    EXPECT_EQ(stage.audio.sounding(), Audio::kSources);
    // One at full level right against 31 times 0.7 / 300 left.
    EXPECT_GT(loudness(stage.samples).right, loudness(stage.samples).left);
}

TEST(Voices, TheFarDoesNotTakeThePlaceOfTheNear) {
    Stage stage;
    const std::vector<Shot> near(Audio::kSources, Shot{.position = {0.5f, 0, 0}, .gain = 0.02f});
    stage.frame({}, near);
    const std::vector<float> before = [&] {
        Stage alone;
        alone.frame({}, near);
        alone.frame({});
        return alone.samples;
    }();
    const std::vector<Shot> far(10, Shot{.position = {-50, 0, 0}});
    stage.frame({}, far);
    EXPECT_EQ(stage.samples, before);
}

TEST(Voices, TheBedGivesWayToNobody) {
    Stage stage;
    const Emitter bed{.id = 1, .gain = 0.1f, .everywhere = true};
    stage.frame({&bed, 1});
    const std::vector<Shot> crowd(100, Shot{.position = {0, 0, -0.2f}, .gain = 0});
    stage.frame({&bed, 1}, crowd);
    EXPECT_EQ(stage.audio.sounding(), Audio::kSources);
    stage.frame({&bed, 1});
    EXPECT_GT(stage.level(), 0.02); // the crowd is mute
}

TEST(Voices, PauseStandsStill) {
    Stage stage;
    const Shot shot{.position = {0, 0, -1}};
    stage.frame({&kAhead, 1}, {&shot, 1});
    stage.audio.setPaused(true);
    for (int i = 0; i < 240; ++i) stage.frame({&kAhead, 1}, {&shot, 1}); // 4 s, far beyond the clip
    EXPECT_EQ(stage.audio.sounding(), 2);
    EXPECT_LT(stage.level(), 1e-4);
    stage.audio.setPaused(false);
    stage.frame({&kAhead, 1});
    EXPECT_EQ(stage.audio.sounding(), 2);
    EXPECT_GT(stage.level(), 0.1);
}

TEST(Voices, APauseIsSilenceAndDoesNotClick) {
    Stage stage;
    for (int i = 0; i < 30; ++i) stage.frame({&kAhead, 1});
    const float steepest = stage.steepest();
    for (const bool paused : {true, false}) {
        stage.audio.setPaused(paused);
        for (int i = 0; i < 30; ++i) {
            stage.frame({&kAhead, 1});
            EXPECT_LT(stage.steepest(), 1.1f * steepest) << paused << i; // as where an emitter ends
        }
        EXPECT_EQ(stage.level() > 0, !paused);
    }
    stage.audio.setPaused(true);
    stage.audio.setVolume(0.7f); // turned while paused: still silent
    for (int i = 0; i < 10; ++i) stage.frame({&kAhead, 1});
    EXPECT_EQ(stage.level(), 0);
    stage.audio.setPaused(false); // and back before anything stood still
    stage.audio.setPaused(true);
    stage.audio.setPaused(false);
    for (int i = 0; i < 10; ++i) stage.frame({&kAhead, 1});
    EXPECT_GT(stage.level(), 0.05);
    EXPECT_EQ(stage.audio.sounding(), 1);
}

TEST(Voices, AReopenedDeviceGoesOnWithWhatIsListed) {
    Stage stage;
    stage.frame({&kAhead, 1});
    ASSERT_TRUE(stage.audio.reopen());
    for (int i = 0; i < 5; ++i) stage.frame({&kAhead, 1});
    EXPECT_EQ(stage.audio.sounding(), 1);
    EXPECT_GT(stage.level(), 0.1);
}

TEST(Voices, MoreThanFitAreLeftOut) {
    Stage stage;
    std::vector<Emitter> emitters;
    for (uint32_t i = 0; i < 60; ++i) emitters.push_back({.id = i, .position = {0, 0, -1}});
    const std::vector<Shot> shots(100);
    stage.frame(emitters, shots);
    EXPECT_EQ(stage.audio.sounding(), Audio::kSources);
    for (const float sample : stage.samples) ASSERT_TRUE(std::isfinite(sample));
    emitters.resize(3);
    for (int i = 0; i < 60; ++i) stage.frame(emitters);
    EXPECT_EQ(stage.audio.sounding(), 3);
}

} // namespace
} // namespace shoal::audio
