// Normals of surfaces that nodes and joints scale unevenly: at right angles to what they become.
#include "ScaledSpheres.h"
#include "engine/math/LatLong.h"
#include "engine/scene/Surface.h"

#include <gtest/gtest.h>

namespace shoal::scene {
namespace {

class Normals : public testing::TestWithParam<ScaledSphere> {};
INSTANTIATE_TEST_SUITE_P(Of, Normals, testing::ValuesIn(kScaledSpheres),
                         [](const auto& spec) { return std::string(spec.param.name); });

TEST_P(Normals, StandOnTheEllipsoid) {
    Primitive primitive;
    for (int y = 0; y <= 8; ++y)
        for (int x = 0; x < 16; ++x)
            primitive.positions.push_back(
                directionFromLatLong(glm::vec2(static_cast<float>(x) / 16, static_cast<float>(y) / 8)));
    primitive.normals = primitive.positions;
    Model model;
    model.meshes.push_back({"ball", {primitive}, {}});
    model.nodes.push_back({.mesh = 0});
    model.order = {0};
    GetParam().transform(model);
    Pose pose;
    restPose(model, pose);
    const Surface surface = posedSurface(model, pose);
    ASSERT_EQ(surface.positions.size(), primitive.positions.size());
    for (size_t i = 0; i < surface.positions.size(); ++i) {
        const glm::vec3 expected = ellipsoidNormal(GetParam().modelFromSphere, surface.positions[i]);
        for (int c = 0; c < 3; ++c) // some ten float operations on numbers near 1
            EXPECT_NEAR(surface.normals[i][c], expected[c], 1e-5f) << i;
    }
}

} // namespace
} // namespace shoal::scene
