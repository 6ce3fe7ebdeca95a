// Hands that nearly reach a fish: the fish that they aim at, the help that they get, and why they missed.
#include "game/rules/Intent.h"
#include "Fixture.h"

namespace shoal::game {
namespace {

// Fish at all places around the hand: those that show as catchable are caught, with every strength of help.
TEST(Intent, AFishShownAsCatchableIsCaughtByAHandThatCloses) {
    int shown = 0, caught = 0;
    for (Assist assist : {Assist::Normal, Assist::Strong})
        for (float x = -0.2f; x <= 0.2f; x += 0.05f)
            for (float y = -0.2f; y <= 0.2f; y += 0.1f)
                for (float z = -0.3f; z <= 0.31f; z += 0.1f) {
                    OneFish one({.rules = {assist}});
                    one.show(kPlace, kPlace + glm::vec3(x, y, z));
                    if (one.fish().catchable < 0.5f) continue;
                    EXPECT_EQ(one.fish().catchableBy, 1);
                    ++shown;
                    one.close(kPlace);
                    caught += one.took();
                }
    EXPECT_GT(shown, 60);
    EXPECT_EQ(caught, shown);
}

TEST(Intent, TheHelpReachesFartherWithEachStrengthAndNotAtAllWithNone) {
    const auto reachAlong = [](Assist assist) {
        float farthest = 0;
        for (float beyond = 0; beyond < 0.5f; beyond += 0.01f) {
            OneFish one({.rules = {assist}});
            one.show(kPlace, kPlace * (1 + beyond / glm::length(kPlace)));
            one.close(kPlace);
            if (one.took()) farthest = beyond;
        }
        return farthest;
    };
    const float none = reachAlong(Assist::None), normal = reachAlong(Assist::Normal),
                strong = reachAlong(Assist::Strong);
    // The grasp centre is as far from the body's middle as the range along the line of sight and the body's
    // radius allow.
    EXPECT_LT(none, 0.11f);
    EXPECT_GT(normal, 0.15f);
    EXPECT_LT(normal, 0.25f);
    EXPECT_GT(strong, normal + 0.05f);
}

TEST(Intent, TheHelpMovesNothingByMuchOrFast) {
    OneFish one({.rules = {Assist::Normal}});
    const glm::vec3 fish = kPlace + glm::vec3(0.09f, 0, -0.09f);
    one.show(kPlace, fish);
    const glm::vec3 alone = hands::graspCentre(handAt(kPlace).joints);
    float farthest = 0;
    for (int i = 1; i <= 45; ++i) {
        const glm::vec3 before = one.world.hands[1].graspCentre;
        one.hand(kPlace, std::min(1.0f, static_cast<float>(i) / 15));
        // The fingers' bending leaves the grasp centre where it is; a micrometre of rounding a tick.
        EXPECT_LE(glm::distance(one.world.hands[1].graspCentre, before) * 120, 0.8f + 2e-3f);
        farthest = std::max(farthest, glm::distance(one.world.hands[1].graspCentre, alone));
        if (!one.took()) {
            EXPECT_LE(glm::length(one.fish().velocity), 1.6f);
        }
    }
    EXPECT_TRUE(one.took());
    EXPECT_GT(farthest, 0.02f);
    EXPECT_LE(farthest, 0.05f + 1e-4f);
    // Open and empty again, it goes back to where the player has it.
    for (int i = 0; i < 60; ++i) one.hand(kPlace);
    EXPECT_LT(glm::distance(one.world.hands[1].graspCentre, alone), 1e-4f);
}

TEST(Intent, AFishOnceMeantIsStillMeantWhenItHasJustSlippedOutOfRange) {
    const glm::vec3 edge = kPlace + glm::vec3(0.11f, 0, 0), beyond = kPlace + glm::vec3(0.165f, 0, 0);
    OneFish meant({.rules = {Assist::Normal}});
    meant.show(kPlace, edge);
    ASSERT_GT(meant.fish().catchable, 0.5f);
    meant.show(kPlace, beyond, 20);
    meant.close(kPlace);
    EXPECT_TRUE(meant.took());
    OneFish stranger({.rules = {Assist::Normal}});
    stranger.show(kPlace, beyond, 60);
    EXPECT_LT(stranger.fish().catchable, 0.5f);
    stranger.close(kPlace);
    EXPECT_FALSE(stranger.took());
}

TEST(Intent, NothingIsCatchableWithoutAHandOrInAFist) {
    OneFish one({.rules = {Assist::Strong}});
    one.show(kPlace, kPlace);
    EXPECT_GT(one.fish().catchable, 0.9f);
    one.input.hands[1].tracked = false;
    one.step(60);
    EXPECT_EQ(one.fish().catchable, 0);
    EXPECT_EQ(one.fish().catchableBy, -1);
    OneFish fist({.rules = {Assist::Strong}});
    fist.close(kPlace + glm::vec3(0.6f, 0, 0), 60);
    fist.input.hands[1] = handAt(kPlace + glm::vec3(0.1f, 0, 0), 1);
    fist.rest();
    fist.step(30);
    EXPECT_LT(fist.fish().catchable, 0.1f);
}

// Why it missed, by where the fish was as the hand closed; without help, so that it does miss.
TEST(Misses, SayWhy) {
    struct Case {
        const char* what;
        glm::vec3 fish;     // against the hand
        glm::vec3 velocity; // velocity of the fish as the hand closes, m/s
        EventKind says;
    };
    const glm::vec3 sight = glm::normalize(kPlace);
    const Case cases[] = {
        {"half a metre beyond", 0.5f * sight, {0, 0, 0}, EventKind::MissTooFar},
        {"just beyond", 0.16f * sight, {0, 0, 0}, EventKind::MissTooFar},
        {"before the back of the hand", -0.2f * sight, {0, 0, 0}, EventKind::MissBehind},
        {"beside, coming", {-0.17f, 0, 0}, {0.3f, 0, 0}, EventKind::MissTooEarly},
        {"beside, gone by", {0.17f, 0, 0}, {0.3f, 0, 0}, EventKind::MissBehind},
        {"far to the side", {0.6f, 0, 0}, {0, 0, 0}, EventKind::Miss},
    };
    for (const Case& c : cases) {
        OneFish one({.rules = {Assist::None}});
        one.show(kPlace, kPlace + c.fish, 10);
        for (int i = 1; i <= 30; ++i) {
            one.rest(kPlace + c.fish);
            one.fish().velocity = c.velocity;
            one.hand(kPlace, std::min(1.0f, static_cast<float>(i) / 15));
        }
        EXPECT_EQ(std::ranges::count(one.events, c.says, &Event::kind), 1) << c.what;
        const Hand& hand = one.world.hands[1];
        EXPECT_EQ(eventOf(hand.lastMiss), c.says) << c.what;
        EXPECT_LT(hand.sinceMiss_s, 0.3f);
    }
}

} // namespace
} // namespace shoal::game
