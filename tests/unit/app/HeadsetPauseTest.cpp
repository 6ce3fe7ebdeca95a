// When a dive in a headset goes on: hands are all that a player has.
#include "game/session/HeadsetPause.h"
#include "game/ui/PanelPlacement.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>

namespace shoal::app {
namespace {

constexpr float kDt = 1.0f / 90;

struct Gate {
    HeadsetPause gate;
    bool paused = false, restart = false;

    void run(const HeadsetMoment& moment, float seconds) {
        const int steps = static_cast<int>(std::lround(seconds / kDt));
        for (int i = 0; i < steps; ++i) gate.step(moment, kDt, paused, restart);
    }
};

constexpr HeadsetMoment kWell{.plays = true, .headTracked = true, .grip = {0.1f, 0.1f}};
HeadsetMoment fists(float left, float right) {
    HeadsetMoment moment = kWell;
    moment.grip = {left, right};
    return moment;
}
HeadsetMoment off() {
    HeadsetMoment moment = kWell;
    moment.plays = false;
    return moment;
}

TEST(HeadsetPause, BeginsByItselfOnceTheHeadsetIsWorn) {
    Gate g;
    g.run(off(), 2);
    EXPECT_TRUE(g.paused);
    g.run(kWell, HeadsetPause::kSteady_s - 0.1f);
    EXPECT_TRUE(g.paused);
    g.run(kWell, 0.2f);
    EXPECT_FALSE(g.paused);
}

TEST(HeadsetPause, TakingItOffPausesUntilAHandCloses) {
    Gate g;
    g.run(kWell, 1);
    g.run(off(), kDt);
    EXPECT_TRUE(g.paused);
    g.run(kWell, 5);
    EXPECT_TRUE(g.paused);
    g.run(fists(0.1f, 0.9f), HeadsetPause::kGoOn_s - 0.05f);
    EXPECT_TRUE(g.paused);
    g.run(fists(0.1f, 0.9f), 0.1f);
    EXPECT_FALSE(g.paused);
    EXPECT_FALSE(g.restart);
}

TEST(HeadsetPause, AHandThatWasClosedBeforeMustOpenFirst) {
    Gate g;
    g.run(kWell, 1);
    g.run(fists(0.9f, 0.1f), 1); // holds a fish
    HeadsetMoment away = off();
    away.grip = {0.9f, 0.1f};
    g.run(away, 1);
    g.run(fists(0.9f, -1), 3);
    EXPECT_TRUE(g.paused);
    g.run(fists(0.2f, -1), 0.1f);
    g.run(fists(0.9f, -1), 0.5f);
    EXPECT_FALSE(g.paused);
}

TEST(HeadsetPause, LosingTheHeadFadesAndPausesAndComesBackByItself) {
    Gate g;
    g.run(kWell, 2);
    EXPECT_EQ(g.gate.fade(), 0);
    HeadsetMoment lost = kWell;
    lost.headTracked = false;
    g.run(lost, kDt);
    EXPECT_TRUE(g.paused);
    EXPECT_GT(g.gate.fade(), 0);
    EXPECT_LT(g.gate.fade(), 0.1f); // not at once
    g.run(lost, HeadsetPause::kFadeOut_s);
    EXPECT_EQ(g.gate.fade(), 1);
    g.run(kWell, HeadsetPause::kSteady_s + 0.05f);
    EXPECT_FALSE(g.paused);
    g.run(kWell, HeadsetPause::kFadeIn_s);
    EXPECT_EQ(g.gate.fade(), 0);
}

TEST(HeadsetPause, TakenOffWhileLostStaysPaused) {
    Gate g;
    g.run(kWell, 1);
    HeadsetMoment lost = kWell;
    lost.headTracked = false;
    g.run(lost, 0.1f);
    lost.plays = false;
    g.run(lost, 0.1f);
    g.run(kWell, 3);
    EXPECT_TRUE(g.paused);
}

TEST(HeadsetPause, ThePlayersOwnPauseDoesNotEndByItself) {
    Gate g;
    g.run(kWell, 1);
    g.paused = true; // by a key
    g.run(kWell, 3);
    EXPECT_TRUE(g.paused);
    g.run(fists(0.9f, 0.1f), 0.5f);
    EXPECT_FALSE(g.paused);
}

TEST(HeadsetPause, TheMenuButtonPausesAndGoesOnOncePerPress) {
    Gate g;
    g.run(kWell, 1);
    HeadsetMoment menu = kWell;
    menu.menu = true;
    g.run(menu, 1);
    EXPECT_TRUE(g.paused);
    g.run(kWell, 1);
    EXPECT_TRUE(g.paused);
    g.run(menu, kDt);
    EXPECT_FALSE(g.paused);
}

TEST(HeadsetPause, BothHandsClosedOverTheResultsDiveAgain) {
    Gate g;
    g.run(kWell, 1);
    HeadsetMoment over = kWell;
    over.results = true;
    over.grip = {0.9f, 0.9f}; // still, from the dive
    g.run(over, 3);
    EXPECT_FALSE(g.restart);
    over.grip = {0.1f, 0.1f};
    g.run(over, 0.2f);
    over.grip = {0.9f, 0.1f};
    g.run(over, 3);
    EXPECT_FALSE(g.restart); // one is not enough
    over.grip = {0.9f, 0.9f};
    g.run(over, HeadsetPause::kAgain_s + 0.05f);
    EXPECT_TRUE(g.restart);
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
    // Looking about within the lag, and nodding: it does not stir.
    for (int i = 0; i < 180; ++i) {
        const float t = static_cast<float>(i) * kDt;
        const xr::Pose now = place.follow(yawed(0.55f * std::sin(3 * t), 0.5f * std::sin(2 * t)), kDt);
        EXPECT_LT(glm::distance(now.position, first.position), 1e-6f);
        EXPECT_EQ(now.orientation, first.orientation);
    }
    // Turned well aside: it comes after, never faster than the head, and upright.
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

} // namespace
} // namespace shoal::app
