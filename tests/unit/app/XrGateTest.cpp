// When a dive in a headset goes on: hands are all that a player has.
#include "game/app/XrGate.h"
#include "game/app/HudPlace.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>

namespace shoal::app {
namespace {

constexpr float kDt = 1.0f / 90;

struct Gate {
    XrGate gate;
    bool paused = false, restart = false;

    void run(const XrMoment& moment, float seconds) {
        const int steps = static_cast<int>(std::lround(seconds / kDt));
        for (int i = 0; i < steps; ++i) gate.step(moment, kDt, paused, restart);
    }
};

constexpr XrMoment kWell{.plays = true, .headTracked = true, .grip = {0.1f, 0.1f}};
XrMoment fists(float left, float right) {
    XrMoment moment = kWell;
    moment.grip = {left, right};
    return moment;
}
XrMoment off() {
    XrMoment moment = kWell;
    moment.plays = false;
    return moment;
}

TEST(XrGate, BeginsByItselfOnceTheHeadsetIsWorn) {
    Gate g;
    g.run(off(), 2);
    EXPECT_TRUE(g.paused);
    g.run(kWell, XrGate::kSteady_s - 0.1f);
    EXPECT_TRUE(g.paused);
    g.run(kWell, 0.2f);
    EXPECT_FALSE(g.paused);
}

TEST(XrGate, TakingItOffPausesUntilAHandCloses) {
    Gate g;
    g.run(kWell, 1);
    g.run(off(), kDt);
    EXPECT_TRUE(g.paused);
    g.run(kWell, 5);
    EXPECT_TRUE(g.paused);
    g.run(fists(0.1f, 0.9f), XrGate::kGoOn_s - 0.05f);
    EXPECT_TRUE(g.paused);
    g.run(fists(0.1f, 0.9f), 0.1f);
    EXPECT_FALSE(g.paused);
    EXPECT_FALSE(g.restart);
}

TEST(XrGate, AHandThatWasClosedBeforeMustOpenFirst) {
    Gate g;
    g.run(kWell, 1);
    g.run(fists(0.9f, 0.1f), 1); // holds a fish
    XrMoment away = off();
    away.grip = {0.9f, 0.1f};
    g.run(away, 1);
    g.run(fists(0.9f, -1), 3);
    EXPECT_TRUE(g.paused);
    g.run(fists(0.2f, -1), 0.1f);
    g.run(fists(0.9f, -1), 0.5f);
    EXPECT_FALSE(g.paused);
}

TEST(XrGate, LosingTheHeadFadesAndPausesAndComesBackByItself) {
    Gate g;
    g.run(kWell, 2);
    EXPECT_EQ(g.gate.fade(), 0);
    XrMoment lost = kWell;
    lost.headTracked = false;
    g.run(lost, kDt);
    EXPECT_TRUE(g.paused);
    EXPECT_GT(g.gate.fade(), 0);
    EXPECT_LT(g.gate.fade(), 0.1f); // not at once
    g.run(lost, XrGate::kFadeOut_s);
    EXPECT_EQ(g.gate.fade(), 1);
    g.run(kWell, XrGate::kSteady_s + 0.05f);
    EXPECT_FALSE(g.paused);
    g.run(kWell, XrGate::kFadeIn_s);
    EXPECT_EQ(g.gate.fade(), 0);
}

TEST(XrGate, TakenOffWhileLostStaysPaused) {
    Gate g;
    g.run(kWell, 1);
    XrMoment lost = kWell;
    lost.headTracked = false;
    g.run(lost, 0.1f);
    lost.plays = false;
    g.run(lost, 0.1f);
    g.run(kWell, 3);
    EXPECT_TRUE(g.paused);
}

TEST(XrGate, ThePlayersOwnPauseDoesNotEndByItself) {
    Gate g;
    g.run(kWell, 1);
    g.paused = true; // by a key
    g.run(kWell, 3);
    EXPECT_TRUE(g.paused);
    g.run(fists(0.9f, 0.1f), 0.5f);
    EXPECT_FALSE(g.paused);
}

TEST(XrGate, TheMenuButtonPausesAndGoesOnOncePerPress) {
    Gate g;
    g.run(kWell, 1);
    XrMoment menu = kWell;
    menu.menu = true;
    g.run(menu, 1);
    EXPECT_TRUE(g.paused);
    g.run(kWell, 1);
    EXPECT_TRUE(g.paused);
    g.run(menu, kDt);
    EXPECT_FALSE(g.paused);
}

TEST(XrGate, BothHandsClosedOverTheResultsDiveAgain) {
    Gate g;
    g.run(kWell, 1);
    XrMoment over = kWell;
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
    g.run(over, XrGate::kAgain_s + 0.05f);
    EXPECT_TRUE(g.restart);
}

TEST(HudPlace, HangsAheadAndStaysWhileTheHeadLooksAround) {
    HudPlace place;
    const auto yawed = [](float yaw, float pitch = 0) {
        return xr::Pose{{0, 0, 0},
                        glm::angleAxis(yaw, glm::vec3(0, 1, 0)) * glm::angleAxis(pitch, glm::vec3(1, 0, 0))};
    };
    const xr::Pose first = place.follow(yawed(0), kDt);
    EXPECT_NEAR(glm::length(first.position - glm::vec3(0, -HudPlace::kBelow_m, 0)), HudPlace::kDistance_m,
                1e-6f);
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
        glm::angleAxis(1.5f, glm::vec3(0, 1, 0)) * glm::vec3(0, 0, -HudPlace::kDistance_m);
    EXPECT_LT(glm::distance(last + glm::vec3(0, HudPlace::kBelow_m, 0), ahead),
              (HudPlace::kSettled_rad + 0.01f) * HudPlace::kDistance_m);
}

} // namespace
} // namespace shoal::app
