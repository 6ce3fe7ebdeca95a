// Tests when a paused dive in a headset goes on, for players who have only their hands.
#include "game/app/Display.h"
#include "game/session/Controls.h"
#include "game/session/GameSession.h"
#include "tests/Test.h"

namespace shoal::app {
namespace {

constexpr float kDt = 1.0f / 90;

constexpr HeadsetMoment kWell{.plays = true, .headTracked = true, .grip = {0.1f, 0.1f}};
constexpr HeadsetMoment with(float left, float right, HeadsetMoment moment = kWell) {
    moment.grip = {left, right};
    return moment;
}
constexpr HeadsetMoment kOff{.headTracked = true, .grip = {0.1f, 0.1f}};
constexpr HeadsetMoment kLost{.plays = true, .grip = {0.1f, 0.1f}};
constexpr HeadsetMoment kMenu{.plays = true, .headTracked = true, .menu = true, .grip = {0.1f, 0.1f}};
constexpr HeadsetMoment kOver{.plays = true, .headTracked = true, .results = true, .grip = {0.1f, 0.1f}};

struct PauseStep {
    HeadsetMoment moment;
    float seconds;
    bool paused, restart = false; // then
};
struct PauseStory {
    const char* name;
    std::vector<PauseStep> steps;
};

class HeadsetPauses : public testing::TestWithParam<PauseStory> {};
TEST_P(HeadsetPauses, AndGoOn) {
    HeadsetPause pause;
    bool paused = false, restart = false;
    for (size_t step = 0; step < GetParam().steps.size(); ++step) {
        const PauseStep& now = GetParam().steps[step];
        const long frames = std::lround(now.seconds / kDt);
        for (long i = 0; i < frames; ++i) pause.step(now.moment, kDt, paused, restart);
        EXPECT_EQ(paused, now.paused) << step;
        EXPECT_EQ(restart, now.restart) << step;
    }
}
INSTANTIATE_TEST_SUITE_P(
    When, HeadsetPauses,
    testing::Values(
        PauseStory{"WornItBeginsByItself",
                   {{kOff, 2, true}, {kWell, HeadsetPause::kSteady_s - 0.1f, true}, {kWell, 0.2f, false}}},
        PauseStory{"TakenOffUntilAHandCloses",
                   {{kWell, 1, false},
                    {kOff, kDt, true},
                    {kWell, 5, true},
                    {with(0.1f, 0.9f), HeadsetPause::kResume_s - 0.05f, true},
                    {with(0.1f, 0.9f), 0.1f, false}}},
        PauseStory{"AHandWasClosedBeforeItMustOpenFirst", // it holds a fish
                   {{kWell, 1, false},
                    {with(0.9f, 0.1f), 1, false},
                    {with(0.9f, 0.1f, kOff), 1, true},
                    {with(0.9f, -1), 3, true},
                    {with(0.2f, -1), 0.1f, true},
                    {with(0.9f, -1), 0.5f, false}}},
        PauseStory{"TheHeadIsLostItComesBackByItself",
                   {{kWell, 2, false}, {kLost, 0.3f, true}, {kWell, HeadsetPause::kSteady_s + 0.05f, false}}},
        PauseStory{"TakenOffWhileLostItStaysPaused",
                   {{kWell, 1, false}, {kLost, 0.1f, true}, {HeadsetMoment{}, 0.1f, true}, {kWell, 3, true}}},
        PauseStory{"TheMenuButtonIsPressedOnce",
                   {{kWell, 1, false}, {kMenu, 1, true}, {kWell, 1, true}, {kMenu, kDt, false}}},
        PauseStory{"BothHandsCloseOverTheResults", // they still are from the dive; one is not enough
                   {{kWell, 1, false},
                    {with(0.9f, 0.9f, kOver), 3, false},
                    {kOver, 0.2f, false},
                    {with(0.9f, 0.1f, kOver), 3, false},
                    {with(0.9f, 0.9f, kOver), HeadsetPause::kRestart_s + 0.05f, false, true}}}),
    tests::byName);

TEST(HeadsetPause, APlayersOwnDoesNotEndByItself) {
    HeadsetPause pause;
    bool paused = false, restart = false;
    const auto run = [&](const HeadsetMoment& moment, int frames) {
        for (int i = 0; i < frames; ++i) pause.step(moment, kDt, paused, restart);
        return paused;
    };
    EXPECT_FALSE(run(kWell, 90));
    paused = true; // by a key
    EXPECT_TRUE(run(kWell, 270));
    EXPECT_FALSE(run(with(0.9f, 0.1f), 45));
}

TEST(HeadsetPause, LosingTheHeadFadesSlowly) {
    HeadsetPause pause;
    bool paused = false, restart = false;
    const auto fadeAfter = [&](const HeadsetMoment& moment, float seconds) {
        for (float t = 0; t < seconds; t += kDt) pause.step(moment, kDt, paused, restart);
        return pause.fade();
    };
    EXPECT_EQ(fadeAfter(kWell, 2), 0);
    const float first = fadeAfter(kLost, kDt / 2);
    EXPECT_GT(first, 0);
    EXPECT_LT(first, 0.1f);
    EXPECT_EQ(fadeAfter(kLost, HeadsetPause::kFadeOut_s), 1);
    EXPECT_EQ(fadeAfter(kWell, HeadsetPause::kFadeIn_s + 0.1f), 0);
}

TEST(PanelPlacement, HangsAheadAndStaysWhileTheHeadLooksAround) {
    PanelPlacement place;
    const auto yawed = [](float yaw, float pitch = 0) {
        return xr::Pose{{0, 0, 0},
                        glm::angleAxis(yaw, glm::vec3(0, 1, 0)) * glm::angleAxis(pitch, glm::vec3(1, 0, 0))};
    };
    const xr::Pose first = place.follow(yawed(0), kDt);
    EXPECT_NEAR(glm::length(first.position - glm::vec3(0, -PanelPlacement::kBelow_m, 0)),
                PanelPlacement::kDistance_m, 1e-6f);
    // The panel does not move while the head looks about within the lag, and nods.
    for (int i = 0; i < 180; ++i) {
        const float t = static_cast<float>(i) * kDt;
        const xr::Pose now = place.follow(yawed(0.55f * std::sin(3 * t), 0.5f * std::sin(2 * t)), kDt);
        EXPECT_LT(glm::distance(now.position, first.position), 1e-6f);
        EXPECT_EQ(now.orientation, first.orientation);
    }
    // The panel follows a head that turns far aside, upright and never faster than the head.
    glm::vec3 last = first.position;
    for (int i = 0; i < 270; ++i) {
        const xr::Pose now = place.follow(yawed(1.5f, 0.4f), kDt);
        EXPECT_LT(glm::distance(now.position, last), 0.08f);
        EXPECT_NEAR((now.orientation * glm::vec3(0, 1, 0)).y, 1, 1e-6f);
        last = now.position;
    }
    const glm::vec3 ahead =
        glm::angleAxis(1.5f, glm::vec3(0, 1, 0)) * glm::vec3(0, 0, -PanelPlacement::kDistance_m);
    EXPECT_LT(glm::distance(last + glm::vec3(0, PanelPlacement::kBelow_m, 0), ahead),
              (PanelPlacement::kSettled_rad + 0.01f) * PanelPlacement::kDistance_m);
}

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kNear = 1e-5f; // of single precision

glm::vec3 ahead(const LookAngles& look) { return look.worldFromView() * glm::vec3(0, 0, -1); }

TEST(LookAngles, TurnRightAndUp) {
    LookAngles look;
    look.turnBy({kPi / 2, 0});
    EXPECT_LT(glm::distance(ahead(look), {1, 0, 0}), kNear);
    look.turnBy({0, kPi / 4});
    EXPECT_LT(glm::distance(ahead(look), glm::normalize(glm::vec3(1, 1, 0))), kNear);
    look.turnBy({10 * kPi, 10}); // five times around, and up as far as it goes
    EXPECT_NEAR(ahead(look).y, std::sin(LookAngles::kPitchMax_rad), kNear);
    EXPECT_GT(ahead(look).x, 0);
}

TEST(LookAngles, AreThoseOfTheViewThatTheyMake) {
    for (const float yaw : {-3.0f, -1.0f, 0.0f, 0.5f, 2.5f})
        for (const float pitch : {-1.4f, 0.0f, 0.7f}) {
            const LookAngles look = LookAngles::of(LookAngles{yaw, pitch}.worldFromView());
            EXPECT_NEAR(look.yaw_rad, yaw, 1e-4f); // near the pole the sine of the pitch tells less
            EXPECT_NEAR(look.pitch_rad, pitch, 1e-4f);
        }
}

// The seed of a dive: the same in dives that can be compared, and another each time in dives for pleasure.

uint64_t seedOf(const PlayOptions& options) { return tests::valueOf(makeSessionConfig(options)).seed; }

TEST(Seed, IsDrawnForADiveInAWindow) {
    std::set<uint64_t> seeds;
    for (int i = 0; i < 4; ++i) seeds.insert(seedOf({.hands = {.source = "mouse"}}));
    EXPECT_GT(seeds.size(), 1u); // all equal once in 10^18 runs
    EXPECT_GE(*seeds.begin(), 100'000u);
    EXPECT_LE(*seeds.rbegin(), 999'999u);
}

TEST(Seed, IsOneWhereRunsAreComparedAndWhatIsAskedFor) {
    EXPECT_EQ(seedOf({.headless = true}), 1u);
    EXPECT_EQ(seedOf({.hands = {.source = "mouse"}, .timedemo = true}), 1u);
    const std::string script = "script:" + (dataRoot() / "tests/playthrough/first_catch.toml").string();
    EXPECT_EQ(seedOf({.hands = {.source = script}}), seedOf({.hands = {.source = script}}));
    EXPECT_EQ(seedOf({.seed = 7, .hands = {.source = "mouse"}}), 7u);
    EXPECT_EQ(seedOf({.seed = 7, .headless = true}), 7u);
}

} // namespace
} // namespace shoal::app
