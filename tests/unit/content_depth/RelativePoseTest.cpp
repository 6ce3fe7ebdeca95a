#include "content/make/depth/RelativePose.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace shoal::depth {
namespace {

const glm::dmat3 kTurned = glm::mat3_cast(glm::angleAxis(0.12, glm::normalize(glm::dvec3(0.2, 1, -0.3))));

glm::dvec3 anyDirection(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

// Points all around, 1 to 10 m away, seen before and after the camera has moved by `moved` metres and turned;
// a share of them goes its own way, as animals do.
std::vector<Correspondence> seen(const glm::dvec3& moved, double noise_rad, double animals) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform;
    std::vector<Correspondence> points;
    for (int i = 0; i < 800; ++i) {
        const glm::dvec3 first = anyDirection(random);
        glm::dvec3 at = first * (1 + 9 * uniform(random)) - moved;
        if (uniform(random) < animals) at += 0.3 * anyDirection(random);
        points.push_back(
            {first, glm::normalize(kTurned * glm::normalize(at) + noise_rad * anyDirection(random))});
    }
    return points;
}

double angleBetween(const glm::dmat3& a, const glm::dmat3& b) {
    const glm::dmat3 off = a * glm::transpose(b);
    return std::acos(std::clamp((off[0][0] + off[1][1] + off[2][2] - 1) / 2, -1.0, 1.0));
}

} // namespace

TEST(RelativePose, ExactDirectionsGiveTheMovementAndTheDistances) {
    for (const glm::dvec3 axis : {glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0),
                                  glm::normalize(glm::dvec3(-0.3, 0.2, 0.8))}) {
        const auto points = seen(0.2 * axis, 0, 0);
        const RelativePose pose = relativePose(points);
        ASSERT_TRUE(isTranslation(pose));
        EXPECT_LT(glm::length(pose.towards - axis), 1e-4);
        EXPECT_LT(angleBetween(pose.secondFromFirst, kTurned), 1e-5);
        for (const Correspondence& p : points) {
            const Triangulated t = triangulate(pose, p);
            if (t.sinToMovement < 0.2) continue;
            // The law of sines, from the directions and the true movement.
            const glm::dvec3 back = glm::transpose(kTurned) * p.second;
            const double inverse =
                glm::length(glm::cross(p.first, back)) / glm::length(glm::cross(back, axis));
            EXPECT_NEAR(t.inverse, inverse, 1e-3 * inverse + 1e-5);
        }
    }
}

// A third of the points moves otherwise; with a noise of half a milliradian, 530 points determine the
// direction of a movement that turns points by 40 milliradians to about 0.5 / 40 / sqrt(530 / 5), a
// milliradian: ten times.
TEST(RelativePose, AnimalsCountLittle) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.6, 0.1, -0.7));
    const RelativePose pose = relativePose(seen(0.2 * axis, 5e-4, 0.33));
    EXPECT_LT(glm::length(pose.towards - axis), 0.012);
}

TEST(RelativePose, ACameraThatOnlyTurnsHasNotMoved) {
    EXPECT_FALSE(isTranslation(relativePose(seen({0, 0, 0}, 5e-4, 0))));
    EXPECT_FALSE(isTranslation(relativePose(seen({0, 0, 0}, 5e-4, 0.33))));
}

TEST(RelativePose, InvertedIsThePoseOfExchangedFrames) {
    const auto points = seen({0.1, 0, -0.2}, 0, 0);
    const RelativePose pose = relativePose(points), back = inverted(pose);
    for (const Correspondence& p : points) {
        const double there = triangulate(pose, p).parallax_rad;
        EXPECT_NEAR(triangulate(back, {p.second, p.first}).parallax_rad, there, 1e-9);
    }
}

} // namespace shoal::depth
