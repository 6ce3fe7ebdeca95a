// The flicker of waves' light on animals is what the film's ground shows where the light's ray meets it.
#include "engine/depth/Caustics.h"
#include "tests/Test.h"
#include "tests/unit/light/Environments.h"
#include "tests/unit/shadow/ShadowScene.h"

namespace shoal::depth {
namespace {

constexpr float kPicture_s = 1 / 30.0f;
const glm::vec3 kTowards = glm::normalize(glm::vec3(0.3f, 1, 0));

struct Film {
    DepthMap map = tests::levelGround(-1.5f);
    Caustics caustics;
    // Shows a frame in which the ground to the right, x > 0, has this radiance, and all else has 1.
    void show(float right, float passed_s = kPicture_s) {
        caustics.follow(
            light::paint(64, 32, [=](const glm::dvec3& d) { return glm::dvec3(d.x > 0 ? right : 1); }),
            passed_s);
    }
    float at(const glm::vec3& place, float length_m = 0.1f) const {
        return caustics.changeAt(place, kTowards, length_m, map);
    }
};

TEST(Caustics, NothingChangesUntilTheGroundDoes) {
    Film film;
    EXPECT_EQ(film.at({1, -0.5f, 0}), 0); // before the first frame
    for (int picture = 0; picture < 30; ++picture) film.show(2);
    EXPECT_NEAR(film.at({1, -0.5f, 0}), 0, 1e-6f);
}

// A picture's share of a mean of half a second is 1 - exp(-2 / 30) = 0.0645: the mean goes from 1 to 1.0645.
TEST(Caustics, FollowTheGroundWhereTheRayMeetsIt) {
    Film film;
    film.show(1);
    film.show(2);
    constexpr float kChange = 2 / 1.0645f - 1;
    EXPECT_NEAR(film.at({1, -0.5f, 0}), kChange, 1e-3f);
    EXPECT_NEAR(film.at({-1, -0.5f, 0}), 0, 1e-6f);
    // The ray goes 0.3 m to the left for each metre down: it meets the ground at x = -0.1.
    EXPECT_NEAR(film.at({0.2f, -0.5f, -1}), 0, 1e-6f);
    EXPECT_NEAR(film.at({0.6f, -0.5f, -1}), kChange, 1e-3f);
    // A body 3 m long has five points: three lie at the middle's x, and one lies on either side of it.
    EXPECT_NEAR(film.at({0.6f, -0.5f, -1}, 3), 0.8f * kChange, 1e-3f);
}

TEST(Caustics, AreNoneWithoutGroundNear) {
    Film film;
    film.show(1);
    film.show(2);
    EXPECT_EQ(film.at({1, 2.5f, 0}), 0);  // 4 m above the ground
    EXPECT_EQ(film.at({1, -1.8f, 0}), 0); // below it
    film.map = mapOf([](const glm::vec3&) { return 0.0f; });
    EXPECT_EQ(film.at({1, -0.5f, 0}), 0);
}

TEST(Caustics, BeginAnewAfterACut) {
    Film film;
    film.show(1);
    film.show(2, 1.0f);
    EXPECT_EQ(film.at({1, -0.5f, 0}), 0);
    film.show(1, -10.0f); // the film begins again
    EXPECT_EQ(film.at({1, -0.5f, 0}), 0);
}

TEST(Caustics, AreLimitedWhereTheEdgeOfARockPasses) {
    Film film;
    film.show(0.01f);
    film.show(10);
    EXPECT_LE(film.at({1, -0.5f, 0}), 1.5f);
    film.show(0);
    EXPECT_GE(film.at({1, -0.5f, 0}), -1.0f);
}

} // namespace
} // namespace shoal::depth
