// An ellipsoid that hides what a skin of just its shape hides is found from one that does not.
#include "content/make/models/occlusion/FitToHidden.h"
#include "tests/Cells.h"
#include "tests/Test.h"

namespace shoal::make {
namespace {

const glm::vec3 kSemiAxes(0.01f, 0.015f, 0.03f);

scene::Surface skinOf(const glm::mat4& modelFromSkin) {
    scene::Surface skin;
    tests::addCells(skin.positions, skin.indices, 32, 16, [](float u, float v) {
        const float a = 6.2831853f * u, b = 3.1415927f * v;
        return glm::vec3(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
    });
    for (glm::vec3& p : skin.positions) { // from the unit sphere
        skin.normals.push_back(glm::normalize(glm::mat3(modelFromSkin) * (p / kSemiAxes)));
        p = glm::vec3(modelFromSkin * glm::vec4(p * kSemiAxes, 1));
    }
    return skin;
}

TEST(FitToHidden, FindsTheEllipsoidThatASkinIs) {
    const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1), glm::vec3(0.2f, 0, 0.1f)), 1.0f,
                                         glm::normalize(glm::vec3(1, 2, 3)));
    const std::vector<Around> poses = {lookAround(skinOf(glm::mat4(1)), {glm::mat4(1)}, {}, 400, 1),
                                       lookAround(skinOf(turned), {turned}, {}, 400, 2)};
    ASSERT_GT(poses[0].places.size(), 350u);
    for (const Around& pose : poses)
        for (const auto& hidden : pose.hidden)
            for (const float share : hidden) {
                EXPECT_GE(share, 0);
                EXPECT_LE(share, 1.00001f);
            }
    const glm::vec3 off(0.0008f, -0.001f, 0.0015f);
    std::vector<occlusion::BodyPart> parts = {
        {{off, glm::mat3(1), kSemiAxes * glm::vec3(1.1f, 0.92f, 1.08f)}, 0}};
    const double before = missed(parts, poses);
    fitToHidden(parts, poses);
    EXPECT_LT(missed(parts, poses), 0.8 * before);
    EXPECT_LT(glm::distance(parts[0].atRest.centre, {}), 0.4f * glm::length(off));
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(parts[0].atRest.semiAxes[axis], kSemiAxes[axis], 0.06f * kSemiAxes[axis]) << axis;
    EXPECT_EQ(parts[0].joint, 0);
}

TEST(FitToHidden, NothingHiddenFitsToNothing) {
    std::vector<occlusion::BodyPart> none;
    fitToHidden(none, {});
    EXPECT_TRUE(none.empty());
    EXPECT_EQ(missed(none, {}), 0);
}

} // namespace
} // namespace shoal::make
