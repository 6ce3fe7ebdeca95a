// Objects that are not in the view are not drawn.
#include "Spheres.h"

namespace shoal {
namespace {

class CullingGL : public WithContext {};

// Draws of an object in the sphere `bound`, by these smaller ones.
int drawsOf(const Sphere& bound, std::span<const Sphere> parts) {
    const Lit lit(uniformFrame(90, 90, 90));
    const scene::Model model = sphere(0, 0.5f);
    const render::ModelGpu gpu = render::uploadModel(model, render::Reflectance::Coded, render::Detail::Full);
    const scene::Pose pose = restingPose(model);
    auto pass = tests::valueOf(render::ObjectPass::make());
    const gl::Target target(16, 16, 1);
    const render::View view{.verticalFov = 1}; // from the origin towards -Z
    drawObjects(pass, {{.model = model, .gpu = gpu, .pose = pose, .bound = bound, .parts = parts}},
                {.environment = lit.environment, .view = view, .canvas = target});
    std::vector<scene::Sphere> visible;
    pass.addVisible(view, visible);
    EXPECT_EQ(visible.empty(), pass.drawCount() == 0);
    return pass.drawCount();
}

TEST_F(CullingGL, AModelIsCulledByItsSphere) {
    EXPECT_EQ(drawsOf({{0, 0, -3}, 1}, {}), 1);
    EXPECT_EQ(drawsOf({{0, 0, 3}, 1}, {}), 0);
}

// An arm beside the head: the sphere around it holds the eye, but no part of it is ahead.
TEST_F(CullingGL, PartsInTheSphereAreCulled) {
    const Sphere around{{0, -1, -0.2f}, 1.5f};
    const Sphere below{{0, -1.5f, -0.3f}, 0.4f}, ahead{{0, -0.2f, -1}, 0.3f};
    EXPECT_EQ(drawsOf(around, {}), 1);
    EXPECT_EQ(drawsOf(around, std::array{below}), 0);
    EXPECT_EQ(drawsOf(around, std::array{below, ahead}), 1);
}

} // namespace
} // namespace shoal
