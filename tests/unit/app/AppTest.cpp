// Effects of keys and of the dive in each state of the program, and the pages shown over the picture then.
#include "game/app/FirstSteps.h"
#include "game/app/PhotoMode.h"
#include "game/app/Screens.h"
#include "game/rules/DiveFile.h"
#include "game/session/GameSession.h"
#include "tests/Recorded.h"
#include "tests/Test.h"
#include "tests/TestRig.h"

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
    EXPECT_EQ(tests::valueOf(back()).kind, Request::Kind::Resume);
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

TEST_F(ProgramStatesTest, ResultsKeepScoreAndStarsAndLeadToTheTitle) {
    session_.after.goals = {{.reached = true}, {.reached = false}, {.reached = true}};
    end(120);
    EXPECT_EQ(readScores()["reef"].stars, 2) << "one for each goal that was reached";
    EXPECT_EQ(starsIn(screens_.facts.allScores), 2);
    EXPECT_EQ(screens_.top(), Screen::Results);
    EXPECT_EQ(readScores()["reef"].top, std::vector<int>{120});
    states_->update(); // counts once
    EXPECT_EQ(readScores()["reef"].top, std::vector<int>{120});
    EXPECT_EQ(tests::valueOf(back()).kind, Request::Kind::Title);
    session_.after.phase = game::Phase::Diving; // dives again
    states_->update();
    EXPECT_FALSE(screens_.isOpen());
    press(Action::Pause);
    EXPECT_TRUE(session_.paused);
}

TEST_F(ProgramStatesTest, AReplayCannotBePausedOnlyLeft) {
    tests::ScratchFolder folder;
    ASSERT_TRUE(tests::write(folder / "a.replay", tests::Recorded(game::recordingHeader(session_.dive))));
    session_.source = ReplaySource{sim::RecordingReader::open(folder / "a.replay").value()};
    states_->input({}, true, leaving_);
    EXPECT_FALSE(session_.paused);
    press(Action::Pause);
    EXPECT_FALSE(session_.paused);
    EXPECT_TRUE(leaving_);
    end(500); // its score was not played by a person
    EXPECT_TRUE(readScores()["reef"].top.empty());
}

TEST_F(ProgramStatesTest, TheGuideCountsEachCatchOnceAndKeepsTheLongest) {
    ASSERT_FALSE(session_.after.tally.empty());
    session_.after.tally[1] = {.caught = 2, .touched = true, .largest_m = 0.3f};
    press(Action::Pause);
    const MetAnimal met = readGuide().at(0);
    EXPECT_EQ(met.species, config().species[1].name);
    EXPECT_EQ(met.dive, "The reef");
    EXPECT_THAT(met.date, testing::MatchesRegex("2[0-9]{3}-[0-9]{2}-[0-9]{2}"));
    session_.paused = false;
    states_->update();
    session_.after.tally[1] = {.caught = 3, .touched = true, .largest_m = 0.3f};
    end(10);
    EXPECT_EQ(readGuide().at(0).caught, 3);
    ASSERT_EQ(screens_.menu().page().gallery.size(), 1u);
    EXPECT_EQ(screens_.menu().page().gallery[0].note, "30 cm  new");
    EXPECT_TRUE(screens_.menu().page().gallery[0].marked);
    // Another dive of the session, with the next seed.
    game::Events events;
    session_.dive.step({.restart = true}, events);
    session_.after = {};
    session_.after.tally.resize(config().species.size());
    states_->update();
    session_.after.tally[0] = {.caught = 1, .touched = true, .largest_m = 0.1f};
    session_.after.tally[1] = {.caught = 1, .touched = true, .largest_m = 0.4f};
    session_.after.tally[2] = {.caught = 1, .touched = true};
    end(10);
    EXPECT_EQ(readGuide().at(0).caught, 4);
    EXPECT_EQ(readGuide().at(0).largest_m, 0.4f);
    const auto& gallery = screens_.menu().page().gallery;
    ASSERT_EQ(gallery.size(), 3u);
    EXPECT_EQ(gallery[0].note, "40 cm  record");
    EXPECT_TRUE(screens_.isRecord(config().species[1], 0.31f)) << "the guide had 30 cm";
    EXPECT_FALSE(screens_.isRecord(config().species[1], 0.3f));
    EXPECT_FALSE(screens_.isRecord(config().species[0], 0.3f)) << "the first of its species";
    EXPECT_EQ(gallery[1].file, "guide/" + config().species[2].name + ".png") << "the longest first";
    EXPECT_EQ(gallery[2].note, "10 cm  new");
}

TEST_F(ProgramStatesTest, TheTitleStandsOverAnIdleReef) {
    states_.emplace(session_, screens_, Mode::Title, true);
    EXPECT_EQ(states_->state(), ProgramStates::State::Title);
    EXPECT_EQ(screens_.top(), Screen::Title);
    EXPECT_FALSE(back()); // Escape does not leave by mistake
    EXPECT_EQ(screens_.top(), Screen::Title);
}

// Mouse and keys move one hand; the other is in the picture only while it holds something.
TEST(MouseSource, ShowsTheHandsThatDoSomething) {
    GameSession session(config());
    auto& mouse = std::get<MouseSource>(session.source);
    const auto shown = [&](int frames, bool swap = false, int leftHolds = -1) {
        Controls controls;
        for (int i = 0; i < frames; ++i) {
            controls.pressed[static_cast<size_t>(Action::SwapHands)] = swap && i == 0;
            session.shown.hands[0].holds = leftHolds;
            mouse.frame(&controls, {}, session.shown, 1 / 60.0f, 1, 1);
            session.advance(1 / 60.0);
        }
        return std::array{session.shown.hands[0].visible, session.shown.hands[1].visible};
    };
    EXPECT_EQ(shown(2), (std::array{false, true}));
    EXPECT_TRUE(session.after.hands[0].visible) << "to the rules it is there";
    EXPECT_EQ(shown(3, true), (std::array{true, true})) << "the right hand sinks";
    EXPECT_EQ(shown(60), (std::array{true, false}));
    game::Snapshot marked{
        .creatures = {{.catchable = 1, .catchableBy = 0}, {.catchable = 1, .catchableBy = 1}}};
    mouse.show(marked);
    EXPECT_GT(marked.creatures[0].catchable, 0.95f);
    EXPECT_LT(marked.creatures[1].catchable, 0.05f) << "no mark says what a hand can take that is not there";
    EXPECT_EQ(shown(60, true, 3), (std::array{true, true})) << "the left hand holds something";
}

// The camera moves, and the player's arms stay with the player.
TEST(PhotoMode, ShowsTheDivesHandsWhenTheyAreAskedFor) {
    game::Snapshot dive;
    dive.hands[1].visible = true;
    PhotoMode photo(dive, 65, false, Bindings());
    float fov_deg = 65;
    Controls controls;
    controls.pressed.set(static_cast<size_t>(Action::SwapHands));
    controls.down.set(static_cast<size_t>(Action::LookUp));
    for (const bool shown : {false, true, false}) {
        EXPECT_EQ(photo.shown.hands[1].visible, shown);
        EXPECT_FALSE(photo.shown.hands[0].visible);
        photo.step(controls, 1, 0.1f, fov_deg);
    }
    EXPECT_NE(photo.shown.headWorld, glm::vec3(0));
    EXPECT_EQ(photo.player.positionWorld, glm::vec3(0));
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

using Step = Tutorial::Step;

constexpr float kFrame_s = 1.0f / 60;

glm::quat turned(float angle_rad) { return glm::angleAxis(angle_rad, glm::vec3(0, 1, 0)); }

struct Pupil {
    game::SpeciesTable species{{.name = "jellyfish", .stings = true}, {.name = "snapper"}};
    Tutorial steps{Mode::FirstSteps, tests::rig(), species};
    game::Snapshot shown;

    void follow(float seconds) {
        for (float t = 0; t < seconds; t += kFrame_s) steps.follow(shown, {}, kFrame_s);
    }
};

TEST(FirstSteps, LeadFromLookingToHolding) {
    Pupil p;
    p.shown.creatures = {{.species = 1, .position = {0, 0, -1}}};
    p.follow(1);
    EXPECT_EQ(p.steps.step(), Step::Look);
    p.shown.worldFromView = turned(1.1f * Tutorial::kTurned_rad);
    p.follow(0.1f);
    EXPECT_EQ(p.steps.step(), Step::Reach);
    p.shown.creatures[0].catchable = 1;
    p.follow(0.5f * Tutorial::kNear_s);
    EXPECT_EQ(p.steps.step(), Step::Reach) << "the hand only swept past the fish";
    p.follow(Tutorial::kNear_s);
    EXPECT_EQ(p.steps.step(), Step::Hold);
    p.shown.caught = 1;
    p.follow(0.1f);
    EXPECT_EQ(p.steps.step(), Step::Done);
}

// The fish that was in reach has swum on: there is nothing to close the hand on.
TEST(FirstSteps, HoldingWaitsForAFishInReach) {
    Pupil p;
    p.shown.creatures = {{.species = 1, .position = {0, 0, -1}, .catchable = 1}};
    p.follow(0.1f);
    p.shown.worldFromView = turned(1.1f * Tutorial::kTurned_rad);
    p.follow(1);
    ASSERT_EQ(p.steps.step(), Step::Hold);
    p.shown.creatures[0].catchable = 0;
    p.shown.hands[0].holds = 0;
    p.follow(2 * Tutorial::kAway_s);
    EXPECT_EQ(p.steps.step(), Step::Hold) << "it is in the hand";
    p.shown.hands[0].holds = -1;
    p.follow(0.5f * Tutorial::kAway_s);
    EXPECT_EQ(p.steps.step(), Step::Hold);
    p.follow(Tutorial::kAway_s);
    EXPECT_EQ(p.steps.step(), Step::Reach);
}

TEST(FirstSteps, ACatchSkipsThemAll) {
    Pupil p;
    p.shown.caught = 1;
    p.follow(0.1f);
    EXPECT_EQ(p.steps.step(), Step::Done);
}

// A tracked head trembles by a tenth of a degree.
TEST(FirstSteps, ATremblingHeadHasNotLookedAround) {
    Pupil p;
    for (int i = 0; i < 60 * 60; ++i) {
        p.shown.worldFromView = turned(i % 2 ? 0.002f : -0.002f);
        p.follow(kFrame_s / 2);
    }
    EXPECT_EQ(p.steps.step(), Step::Look);
}

// A picture of 65 degrees ends 33 degrees below its middle.
TEST(FirstSteps, TheGhostHandReachesForNothingThatStingsNorBelowThePicture) {
    Pupil p;
    p.shown.creatures = {{.species = 0, .position = {0, 0, -0.9f}},
                         {.species = 1, .position = {0, -0.57f, -0.81f}}}; // 35 degrees below
    p.follow(0.1f);
    EXPECT_FALSE(p.steps.target());
    p.shown.creatures.push_back({.species = 1, .position = {0.2f, 0, -1}});
    p.follow(1.1f * Tutorial::kShown_s);
    ASSERT_TRUE(p.steps.target());
    EXPECT_EQ(*p.steps.target(), p.shown.creatures[2].position);
}

TEST(FirstSteps, TheGhostHandReachesForWhatTheTurnedViewSees) {
    Pupil p;
    p.shown.creatures = {{.species = 1, .position = {0, 0, -0.9f}}};
    p.follow(0.1f);
    ASSERT_TRUE(p.steps.target());
    p.shown.worldFromView = turned(1.5f);
    p.follow(0.1f);
    ASSERT_EQ(p.steps.step(), Step::Reach);
    EXPECT_FALSE(p.steps.target());
}

// First steps are made from a copy of the session, which no longer exists when they are drawn.
TEST(FirstSteps, TheGhostHandDoesNotDependOnWhatItWasMadeFrom) {
    auto rig = std::make_unique<hands::HandRig>(tests::rig());
    const Tutorial steps(Mode::FirstSteps, *rig, {});
    *rig = {};
    rig.reset();
    const render::View view;
    const hands::HandPose ghost = steps.ghost(view),
                          whole = Tutorial(Mode::FirstSteps, tests::rig(), {}).ghost(view);
    for (size_t i = 0; i < ghost.joints.size(); ++i)
        EXPECT_EQ(ghost.joints[i].position, whole.joints[i].position) << i;
}

TEST(Hints, StopOnceTheyAreUnderstood) {
    const game::Events tooFast{{.kind = game::EventKind::MissTooFast}};
    const auto timesSaid = [&](int caught) {
        Tutorial hints(Mode::Dive, {}, {});
        const game::Snapshot shown{.caught = caught};
        int said = 0;
        for (int i = 0; i < 10; ++i) {
            hints.follow(shown, tooFast, 0.1f);
            const auto hint = hints.hint();
            said += hint && hint->in(game::Language::English) == std::string("A fast hand frightens fish");
            hints.follow(shown, {}, Tutorial::kHintStay_s);
        }
        return said;
    };
    EXPECT_EQ(timesSaid(0), Tutorial::kHintTimes);
    EXPECT_EQ(timesSaid(Tutorial::kUnderstood), 0);
}

} // namespace
} // namespace shoal::app
