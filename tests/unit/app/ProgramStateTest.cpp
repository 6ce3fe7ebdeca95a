// Effects of keys and of the dive in each state of the program, and the pages shown over the picture then.
#include "game/app/Screens.h"
#include "tests/Recorded.h"
#include "tests/TestPaths.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace shoal::app {
namespace {

const SessionConfig& config() {
    static const SessionConfig loaded = makeSessionConfig({.headless = true}).value();
    return loaded;
}

class ProgramStatesTest : public testing::Test {
  protected:
    tests::ScratchFolder folder_;
    PlayOptions options_;
    Bindings bindings_;
    Screens screens_{options_, bindings_};
    GameSession session_{config()};
    bool leaving_ = false;
    std::optional<ProgramStates> states_;

    void SetUp() override {
        ::setenv("XDG_CONFIG_HOME", folder_.path().c_str(), 1);
        ::setenv("XDG_DATA_HOME", folder_.path().c_str(), 1);
        screens_.facts.species = &config().species;
        screens_.facts.dive = &config().dive;
        states_.emplace(session_, screens_, Mode::Dive, true);
    }

    void press(Action action) {
        Controls controls;
        controls.pressed[static_cast<size_t>(action)] = true;
        states_->input(controls, false, leaving_);
        states_->update();
    }
    void end(int score) {
        session_.after.phase = game::Phase::Results;
        session_.after.score = score;
        states_->update();
    }
    // Escape, or B on a gamepad, on the page that is shown.
    std::optional<Request> back() {
        screens_.input({.back = true});
        return screens_.takeRequest();
    }
};

TEST_F(ProgramStatesTest, PauseOpensItsPageAndBackGoesOn) {
    EXPECT_FALSE(screens_.isOpen());
    press(Action::Pause);
    EXPECT_TRUE(session_.paused);
    EXPECT_EQ(screens_.top(), Screen::Paused);
    const auto request = back();
    ASSERT_TRUE(request);
    EXPECT_EQ(request->kind, Request::Kind::Resume);
    session_.paused = false; // as the program answers
    states_->update();
    EXPECT_FALSE(screens_.isOpen());
    EXPECT_FALSE(leaving_);
}

TEST_F(ProgramStatesTest, LosingTheFocusPausesUntilThePlayerGoesOn) {
    states_->input({}, true, leaving_);
    EXPECT_TRUE(session_.paused);
    states_->update();
    states_->input({}, false, leaving_);
    EXPECT_TRUE(session_.paused);
}

TEST_F(ProgramStatesTest, ResultsKeepTheScoreAndLeadToTheTitle) {
    end(120);
    EXPECT_EQ(screens_.top(), Screen::Results);
    EXPECT_EQ(readScores("reef").top, std::vector<int>{120});
    states_->update(); // counts once
    EXPECT_EQ(readScores("reef").top, std::vector<int>{120});
    const auto request = back();
    ASSERT_TRUE(request);
    EXPECT_EQ(request->kind, Request::Kind::Title);
    session_.after.phase = game::Phase::Diving; // dives again
    states_->update();
    EXPECT_FALSE(screens_.isOpen());
    press(Action::Pause);
    EXPECT_TRUE(session_.paused);
}

TEST_F(ProgramStatesTest, AReplayCannotBePausedOnlyLeft) {
    tests::ScratchFolder folder;
    ASSERT_TRUE(tests::write(folder / "a.replay", tests::Recorded(game::recordingHeader(session_.dive))));
    session_.source = ReplaySource(sim::RecordingReader::open(folder / "a.replay").value());
    states_->input({}, true, leaving_);
    EXPECT_FALSE(session_.paused);
    press(Action::Pause);
    EXPECT_FALSE(session_.paused);
    EXPECT_TRUE(leaving_);
    end(500); // its score was not played by a person
    EXPECT_TRUE(readScores("reef").top.empty());
}

TEST_F(ProgramStatesTest, TouchedSpeciesComeIntoTheGuide) {
    ASSERT_FALSE(session_.after.tally.empty());
    session_.after.tally[1].touched = true;
    press(Action::Pause);
    EXPECT_EQ(readGuide(), std::vector<std::string>{config().species[1].name});
}

TEST_F(ProgramStatesTest, TheTitleStandsOverAnIdleReef) {
    states_.emplace(session_, screens_, Mode::Title, true);
    EXPECT_EQ(states_->state(), ProgramStates::State::Title);
    EXPECT_EQ(screens_.top(), Screen::Title);
    EXPECT_FALSE(back()); // Escape does not leave by mistake
    EXPECT_EQ(screens_.top(), Screen::Title);
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
