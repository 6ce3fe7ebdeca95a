// Tests which sounds play, how long they play, and which sounds give up their voices to others.
#include "Heard.h"
#include "tests/unit/Heap.h"

namespace shoal::audio {
namespace {

// Audio that renders into memory; `samples` holds one frame at 60 Hz: 800 stereo samples.
struct LoopbackScene {
    Audio audio;
    std::vector<float> samples = std::vector<float>(2 * 800);

    LoopbackScene() : audio(std::move(*Audio::open({.loopback = true}))) { audio.add(tone(300, 0.5f)); }

    void frame(std::span<const Sound> emitters, std::span<const Sound> shots = {}) {
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

const Sound kAhead{.id = 7, .position = {0, 0, -0.5f}};

TEST(VoicePool, EmittersGoOnWhileListedAndEndAfter) {
    LoopbackScene scene;
    for (int i = 0; i < 90; ++i) scene.frame({&kAhead, 1}); // three times the clip's length: it loops
    EXPECT_GT(scene.level(), 0.1);
    for (int i = 0; i < 6; ++i) scene.frame({});
    EXPECT_EQ(scene.audio.sounding(), 0);
    for (int i = 0; i < 180; ++i) scene.frame({}); // the reverberation dies away
    EXPECT_LT(scene.level(), 1e-4);
}

TEST(VoicePool, AnEmitterEndsWithoutAClick) {
    LoopbackScene scene;
    for (int i = 0; i < 20; ++i) scene.frame({&kAhead, 1});
    const float steepest = scene.steepest();
    for (int i = 0; i < 6; ++i) {
        scene.frame({});
        // Fading within 800 samples makes a tone at most 1/30 steeper; a cut makes it 25 times as steep.
        EXPECT_LT(scene.steepest(), 1.1f * steepest) << i;
    }
}

TEST(VoicePool, AnEmitterThatComesBackGoesOn) {
    LoopbackScene scene;
    scene.frame({&kAhead, 1});
    scene.frame({});
    scene.frame({&kAhead, 1});
    EXPECT_EQ(scene.audio.sounding(), 1);
    for (int i = 0; i < 10; ++i) scene.frame({&kAhead, 1});
    EXPECT_GT(scene.level(), 0.1);
}

TEST(VoicePool, AnEmitterMoves) {
    LoopbackScene scene;
    Sound emitter = kAhead;
    emitter.position = {-0.7f, 0, 0};
    for (int i = 0; i < 10; ++i) scene.frame({&emitter, 1});
    EXPECT_GT(loudness(scene.samples).left, 1.2 * loudness(scene.samples).right);
    emitter.position = {0.7f, 0, 0};
    for (int i = 0; i < 10; ++i) scene.frame({&emitter, 1});
    EXPECT_GT(loudness(scene.samples).right, 1.2 * loudness(scene.samples).left);
    EXPECT_EQ(scene.audio.sounding(), 1);
}

TEST(VoicePool, TheNearTakesThePlaceOfTheFar) {
    LoopbackScene scene;
    const std::vector<Sound> far(Audio::kSources, Sound{.position = {-300, 0, 0}});
    scene.frame({}, far);
    EXPECT_EQ(scene.audio.sounding(), Audio::kSources);
    const Sound near{.position = {0.5f, 0, 0}};
    scene.frame({}, {&near, 1});
    EXPECT_EQ(scene.audio.sounding(), Audio::kSources);
    // The near sound has full level on the right, the other 31 have 0.7 / 300 each on the left.
    EXPECT_GT(loudness(scene.samples).right, loudness(scene.samples).left);
}

TEST(VoicePool, TheFarDoesNotTakeThePlaceOfTheNear) {
    LoopbackScene scene;
    const std::vector<Sound> near(Audio::kSources, Sound{.position = {0.5f, 0, 0}, .gain = 0.02f});
    scene.frame({}, near);
    const std::vector<float> before = [&] {
        LoopbackScene alone;
        alone.frame({}, near);
        alone.frame({});
        return alone.samples;
    }();
    const std::vector<Sound> far(10, Sound{.position = {-50, 0, 0}});
    scene.frame({}, far);
    EXPECT_EQ(scene.samples, before);
}

TEST(VoicePool, TheBedGivesWayToNobody) {
    LoopbackScene scene;
    const Sound bed{.id = 1, .gain = 0.1f, .everywhere = true};
    scene.frame({&bed, 1});
    const std::vector<Sound> crowd(100, Sound{.position = {0, 0, -0.2f}, .gain = 0});
    scene.frame({&bed, 1}, crowd);
    EXPECT_EQ(scene.audio.sounding(), Audio::kSources);
    scene.frame({&bed, 1});
    EXPECT_GT(scene.level(), 0.02); // the crowd has gain 0, so this is the bed
}

TEST(VoicePool, PauseStandsStill) {
    LoopbackScene scene;
    const Sound shot{.position = {0, 0, -1}};
    scene.frame({&kAhead, 1}, {&shot, 1});
    scene.audio.setPaused(true);
    for (int i = 0; i < 240; ++i) scene.frame({&kAhead, 1}, {&shot, 1}); // 4 s, far beyond the clip
    EXPECT_EQ(scene.audio.sounding(), 2);
    EXPECT_LT(scene.level(), 1e-4);
    scene.audio.setPaused(false);
    scene.frame({&kAhead, 1});
    EXPECT_EQ(scene.audio.sounding(), 2);
    EXPECT_GT(scene.level(), 0.1);
}

TEST(VoicePool, APauseIsSilenceAndDoesNotClick) {
    LoopbackScene scene;
    for (int i = 0; i < 30; ++i) scene.frame({&kAhead, 1});
    const float steepest = scene.steepest();
    for (const bool paused : {true, false}) {
        scene.audio.setPaused(paused);
        for (int i = 0; i < 30; ++i) {
            scene.frame({&kAhead, 1});
            EXPECT_LT(scene.steepest(), 1.1f * steepest) << paused << i; // the limit for an emitter's end
        }
        EXPECT_EQ(scene.level() > 0, !paused);
    }
    scene.audio.setPaused(true);
    scene.audio.setVolume(0.7f); // a change of volume leaves the pause silent
    for (int i = 0; i < 10; ++i) scene.frame({&kAhead, 1});
    EXPECT_EQ(scene.level(), 0);
    scene.audio.setPaused(false); // the next pause ends before its fade has ended
    scene.audio.setPaused(true);
    scene.audio.setPaused(false);
    for (int i = 0; i < 10; ++i) scene.frame({&kAhead, 1});
    EXPECT_GT(scene.level(), 0.05);
    EXPECT_EQ(scene.audio.sounding(), 1);
}

TEST(VoicePool, ItsDeviceIsLostAndReopenedAThousandTimes) {
    LoopbackScene scene;
    scene.frame({&kAhead, 1});
    for (int round = 0; round < 1000; ++round) {
        ASSERT_TRUE(scene.audio.reopen()) << round;
        scene.frame({&kAhead, 1});
        ASSERT_EQ(scene.audio.sounding(), 1) << round;
    }
    for (int i = 0; i < 5; ++i) scene.frame({&kAhead, 1});
    EXPECT_GT(scene.level(), 0.1);
}

TEST(VoicePool, MoreThanFitAreLeftOut) {
    LoopbackScene scene;
    std::vector<Sound> emitters;
    for (uint32_t i = 0; i < 60; ++i) emitters.push_back({.id = i, .position = {0, 0, -1}});
    scene.frame(emitters, std::vector<Sound>(100));
    EXPECT_EQ(scene.audio.sounding(), Audio::kSources);
    for (const float sample : scene.samples) ASSERT_TRUE(std::isfinite(sample));
    emitters.resize(3);
    for (int i = 0; i < 60; ++i) scene.frame(emitters);
    EXPECT_EQ(scene.audio.sounding(), 3);
}

TEST(Allocation, AnUpdateTakesNoMemory) {
    auto audio = tests::valueOf(Audio::open({.loopback = true}));
    audio.add(tone(300, 0.2f));
    std::vector<float> samples(2 * 800);
    std::array<Sound, 6> emitters;
    std::array<Sound, 8> shots;
    heap::counting = true;
    for (uint32_t i = 0; i < 300; ++i) {
        for (uint32_t k = 0; k < emitters.size(); ++k)
            emitters[k] = {.id = k, .position = {0.01f * static_cast<float>(i), 0, -1}};
        audio.update({}, {emitters.data(), i % 7}, {shots.data(), i % 9}); // some start, some end
        audio.render(samples);
    }
    heap::counting = false;
    EXPECT_LE(heap::allocations, 2); // names that OpenAL Soft 1.24 makes itself by std::string
}

} // namespace
} // namespace shoal::audio
