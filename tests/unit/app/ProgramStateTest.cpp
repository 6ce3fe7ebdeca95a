// What keys, clicks and the dive itself do in each state of the program.
#include "game/app/DiveStates.h"
#include "game/app/FrameClock.h"
#include "game/settings/KeptFiles.h"
#include "tests/TestPaths.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace shoal::app {
namespace {

const SessionConfig& config() {
    static const SessionConfig loaded = makeSessionConfig({.headless = true}).value();
    return loaded;
}

class ProgramStates : public testing::Test {
  protected:
    tests::ScratchFolder folder_;
    GameSession session_{config()};
    std::string dive_ = "reef";
    int best_ = 100;
    bool leaving_ = false;
    DiveStates states_{session_, dive_, best_, true, leaving_};

    void SetUp() override { ::setenv("XDG_DATA_HOME", folder_.path().c_str(), 1); }

    void press(std::vector<int> keys) { states_.input({.keysPressed = std::move(keys)}, true); }
    void end(int score) {
        session_.after.phase = game::Phase::Results;
        session_.after.score = score;
        states_.update();
    }
};

TEST_F(ProgramStates, EscapeAndPPauseAndGoOn) {
    for (const int key : {GLFW_KEY_ESCAPE, GLFW_KEY_P}) {
        press({key});
        EXPECT_TRUE(session_.paused);
        press({key});
        EXPECT_FALSE(session_.paused);
        press({key, key}); // between two frames
        EXPECT_FALSE(session_.paused);
    }
    EXPECT_FALSE(leaving_);
}

TEST_F(ProgramStates, QLeavesOnlyWhilePausedOrAfterwards) {
    press({GLFW_KEY_Q});
    EXPECT_FALSE(leaving_);
    press({GLFW_KEY_ESCAPE, GLFW_KEY_Q});
    EXPECT_TRUE(leaving_);
}

TEST_F(ProgramStates, RStartsAgainOnlyWhilePausedOrAfterwards) {
    press({GLFW_KEY_R});
    EXPECT_FALSE(session_.restart);
    press({GLFW_KEY_P, GLFW_KEY_R});
    EXPECT_TRUE(session_.restart);
    EXPECT_FALSE(session_.paused);
}

TEST_F(ProgramStates, LosingTheFocusPausesButNotInAHeadset) {
    states_.input({.focused = false}, false);
    EXPECT_FALSE(session_.paused);
    states_.input({.focused = false}, true);
    EXPECT_TRUE(session_.paused);
    states_.input({.focused = true}, true);
    EXPECT_TRUE(session_.paused); // until the player goes on
}

TEST_F(ProgramStates, TheHeadsetMayPauseAndGoOn) {
    session_.paused = true;
    states_.update();
    press({GLFW_KEY_Q}); // as while paused by a key
    EXPECT_TRUE(leaving_);
    leaving_ = false;
    session_.paused = false;
    states_.update();
    press({GLFW_KEY_Q});
    EXPECT_FALSE(leaving_);
}

TEST_F(ProgramStates, ResultsKeepTheBestScoreAndStartAgain) {
    end(120);
    EXPECT_EQ(best_, 120);
    EXPECT_EQ(bestScore("reef"), 120);
    states_.input({.leftPressed = true}, true);
    EXPECT_TRUE(session_.restart);
    session_.restart = false;
    press({GLFW_KEY_ENTER});
    EXPECT_TRUE(session_.restart);
    session_.restart = false; // the simulation has taken it
    session_.after.phase = game::Phase::Diving;
    states_.update();
    press({GLFW_KEY_ESCAPE}); // dives again: pauses instead of leaving
    EXPECT_FALSE(leaving_);
    EXPECT_TRUE(session_.paused);
    end(110);
    EXPECT_EQ(best_, 120);
    press({GLFW_KEY_ESCAPE});
    EXPECT_TRUE(leaving_);
}

TEST_F(ProgramStates, AReplayCannotBePausedOnlyLeft) {
    session_.source = ReplaySource{sim::Recording(session_.recording.header(), 0)};
    press({GLFW_KEY_P});
    states_.input({.focused = false}, true);
    EXPECT_FALSE(session_.paused);
    press({GLFW_KEY_ESCAPE});
    EXPECT_TRUE(leaving_);
    end(500); // its score is no person's
    EXPECT_EQ(bestScore("reef"), 0);
}

TEST(FrameClock, FixedStepsAreEqualAndADisplayKnowsBetter) {
    FrameClock clock(FrameClock::Mode::FixedStep, 50);
    clock.beginFrame();
    EXPECT_EQ(clock.frame(), 0u);
    EXPECT_EQ(clock.elapsed_s({}), 0);
    clock.beginFrame();
    EXPECT_EQ(clock.frame(), 1u);
    EXPECT_EQ(clock.elapsed_s({}), 1.0 / 50);
    EXPECT_EQ(clock.elapsed_s(0.0125), 0.0125);
    EXPECT_EQ(clock.elapsed_s(3), 0.5); // a long stop is not made up for
    EXPECT_TRUE(clock.exactVideo());
    EXPECT_EQ(clock.video_s(7), 7);
}

} // namespace
} // namespace shoal::app
