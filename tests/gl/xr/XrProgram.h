// `shoal --xr` on the fake runtime, from its start to its exit status.
#pragma once

#include "engine/core/Log.h"
#include "game/rules/Dive.h"
#include "game/tools/Commands.h"
#include "input/hands/MouseHands.h"
#include "tests/TestRig.h"
#include "tests/gl/xr/Fixture.h"
#include "tests/playthrough/Play.h"

namespace shoal::app {

using tests::inputAt;

class XrProgram : public test::WithFakeRuntime {
  protected:
    using FakeRuntime = test::FakeRuntime;
    struct Outcome {
        int status = -1;
        std::string said; // on standard error
    };
    const std::string firstCatch_ = "script:" + (dataRoot() / "tests/playthrough/first_catch.toml").string();

    tests::ScratchFolder scratch_;
    Path folder_ = scratch_.path();

    void SetUp() override {
        WithFakeRuntime::SetUp();
        for (const char* name : {"XDG_DATA_HOME", "XDG_CONFIG_HOME"}) setenv(name, folder_.c_str(), 1);
        fake.eyeWidth = 96;
        fake.eyeHeight = 112;
    }

    PlayOptions options() const {
        PlayOptions o;
        o.xr = true;
        o.start = Start::Dive;
        o.seed = 1; // with a window each run would choose another seed
        o.mute = true;
        o.quality = QualityControl::Fixed;
        o.shadows = ShadowChoice::Off; // half of a frame's time on the processor
        o.look.size = {160, 90};
        o.environment.photo = ""; // the dive's own video
        return o;
    }
    // Runs the program; ends it after maxFrames, even if the test's script does not.
    Outcome run(const PlayOptions& o, uint64_t maxFrames = 2000) {
        const auto scripted = fake.onWait;
        fake.onWait = [scripted, maxFrames](FakeRuntime& f) {
            if (scripted) scripted(f);
            if (f.framesWaited == maxFrames) f.sayExit();
        };
        testing::internal::CaptureStderr();
        log::setUp(false);
        Outcome outcome;
        const Status played = play(o);
        if (!played) std::fprintf(stderr, "%s\n", played.error().message().c_str());
        outcome.status = played ? 0 : 1;
        outcome.said = testing::internal::GetCapturedStderr();
        // The validation layer greets each instance.
        for (size_t at; (at = outcome.said.find("Core Validation output")) != std::string::npos;)
            outcome.said.erase(at, outcome.said.find('\n', at) + 1 - at);
        return outcome;
    }
    // Plays so many frames of a dive, which must succeed without messages, and returns its recording.
    tests::Recorded recorded(PlayOptions o, uint64_t frames) {
        o.record = folder_ / "a.replay";
        const Outcome outcome = run(o, frames);
        EXPECT_EQ(outcome.status, 0);
        EXPECT_EQ(outcome.said, "");
        return tests::valueOf(tests::readRecorded(o.record));
    }
    static void expectOneMessage(const Outcome& outcome, const std::string& about) {
        EXPECT_EQ(outcome.status, 1);
        EXPECT_EQ(std::count(outcome.said.begin(), outcome.said.end(), '\n'), 1) << outcome.said;
        EXPECT_NE(outcome.said.find(about), std::string::npos) << outcome.said;
    }

    // Mean of the left eye's picture, display values up to 191; 0 where there is none.
    static double brightness(const FakeRuntime& f) {
        if (!f.last.eyes) return 0;
        double sum = 0;
        const auto& rgba = (*f.last.eyes)[0].rgba;
        for (size_t i = 0; i < rgba.size(); i += 4) sum += rgba[i] + rgba[i + 1] + rgba[i + 2];
        return sum / static_cast<double>(rgba.size());
    }

    void closeHand(size_t side, float closed) {
        const auto pose =
            hands::reachingHand(tests::rig(), side == 0 ? hands::Side::Left : hands::Side::Right,
                                {side == 0 ? -0.2f : 0.2f, -0.15f, -0.5f}, closed);
        fake.hands[side].active = true;
        for (size_t i = 0; i < pose.joints.size(); ++i) {
            const hands::Joint& joint = pose.joints[i];
            fake.hands[side].joints[i] = {
                0xf,
                {{joint.orientation.x, joint.orientation.y, joint.orientation.z, joint.orientation.w},
                 {joint.position.x, joint.position.y, joint.position.z}},
                joint.radius};
        }
    }

    static void expectReplays(const tests::Recorded& recording) {
        auto files = tests::valueOf(game::loadDiveFiles("reef"));
        if (game::needsFilmSpace(recording.header())) {
            ASSERT_TRUE(game::roomOf(files.dive.video).moveTo(files.dive.space));
        }
        EXPECT_TRUE(tests::succeeded(game::replay(recording, files)));
    }

    // Returns lengths, in ticks, of the stretches with and without `pause`, in turn, first one with it.
    static std::vector<int> pauses(const tests::Recorded& recording) {
        std::vector<int> lengths{0};
        bool paused = true;
        for (size_t tick = 0; tick < recording.ticks(); ++tick) {
            const game::TickInput input = inputAt(recording, tick);
            if (input.pause != paused) {
                paused = input.pause;
                lengths.push_back(0);
            }
            ++lengths.back();
        }
        return lengths;
    }
    // Returns the pauses() of so many frames of a dive.
    std::vector<int> pausesWithin(uint64_t frames) { return pauses(recorded(options(), frames)); }
};

} // namespace shoal::app
