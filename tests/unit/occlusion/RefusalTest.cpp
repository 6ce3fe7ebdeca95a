// Meshes that cannot be drawn are refused with a reason, before memory is allocated.
#include "Odd.h"
#include "tests/baselines/occlusion/OllfbThesis.h"
#include "tests/baselines/occlusion/TracedOllfb.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace shoal::occlusion {
namespace {

TEST(Refusal, SaysWhyAMeshIsBroken) {
    const Body good = oneTriangle();
    const auto refused = [](const Body& body, const char* why) {
        const auto cured = TracedOllfb::make(body.mesh());
        const auto thesis = OllfbThesis::make(body.mesh());
        ASSERT_FALSE(cured);
        ASSERT_FALSE(thesis);
        EXPECT_THAT(cured.error().reason, testing::HasSubstr(why));
        EXPECT_THAT(thesis.error().reason, testing::HasSubstr(why));
    };
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Body body = good;
        body.positions[1].y = bad;
        refused(body, "position 1 is not finite");
        body = good;
        body.normals[2].z = bad;
        refused(body, "normal 2 is not finite");
    }
    Body body = good;
    body.triangles.emplace_back(0, 1, 3);
    refused(body, "triangle 1");
    body = good;
    body.normals.pop_back();
    refused(body, "normals");
    // Normals of no length are taken from the triangle.
    body = good;
    body.normals.assign(3, glm::vec3(0));
    const auto flat = TracedOllfb::make(body.mesh());
    ASSERT_TRUE(flat);
    EXPECT_TRUE(flat->trace({0, 0, 1}, {0, 0, -1}, 0));
}

// Rays that are no rays end, and meet nothing.
TEST(Refusal, OddRaysHitNothing) {
    const TracedOllfb cured = TracedOllfb::make(sphere(1, 24, 12).mesh(), {.views = 20}).value();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const glm::vec3 origin : {glm::vec3(1e30f, 0, 0), glm::vec3(nan, 0, 0), glm::vec3(0, 0, -1e8f)})
        for (const glm::vec3 direction : {glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(-1, 0, 0)})
            if (const auto hit = cured.trace(origin, direction, 0)) {
                EXPECT_GE(hit->distance, 0);
            }
    EXPECT_FALSE(cured.trace({0, 0, 3}, {0, 0, -1}, INFINITY));
    EXPECT_FALSE(cured.trace({0, 0, 3}, {0, 0, -1}, 0, 1.5f)); // ends before it
}

} // namespace
} // namespace shoal::occlusion
