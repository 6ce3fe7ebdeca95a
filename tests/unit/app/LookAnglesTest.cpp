// Turning the view by hand: right and up, around without end, and never over the top.
#include "game/session/Controls.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace shoal::app {
namespace {

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

} // namespace
} // namespace shoal::app
