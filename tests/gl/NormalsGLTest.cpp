// The vertex shader's normals of surfaces that nodes and joints scale unevenly.
#include "Spheres.h"
#include "tests/unit/scene/ScaledSpheres.h"

namespace shoal {
namespace {

class NormalsGL : public WithContext, public testing::WithParamInterface<scene::ScaledSphere> {};
INSTANTIATE_TEST_SUITE_P(Of, NormalsGL, testing::ValuesIn(scene::kScaledSpheres), tests::byName);

TEST_P(NormalsGL, StandOnTheEllipsoid) {
    constexpr int kPixels = 96;
    scene::Model model = sphere(0, 1);
    model.materials[0].doubleSided = false; // and it is turned inside out by none of them
    GetParam().transform(model);
    const glm::mat3 modelFromSphere = GetParam().modelFromSphere;
    const glm::mat3 sphereFromModel = glm::inverse(modelFromSphere);
    const Lit lit(uniformFrame(128, 128, 128));
    const render::View view{.eyeWorld = {0, 0, 5}, .verticalFov = 0.5f, .aspect = 1};
    const ImageRgba8 picture =
        drawSphere(model, lit.environment, view, kPixels, {.shown = render::ShownQuantity::Normals});
    int compared = 0;
    for (int y = 0; y < kPixels; ++y)
        for (int x = 0; x < kPixels; ++x) {
            if (!picture.at(x, y)[3]) continue;
            const glm::vec3 ray = rayThrough(view, x, y, glm::vec2(kPixels));
            // The ray meets the ellipsoid at the point where it meets the sphere that this was.
            const glm::vec3 from = sphereFromModel * view.eyeWorld, along = sphereFromModel * ray;
            const float a = glm::dot(along, along), half = glm::dot(from, along);
            const float root = half * half - a * (glm::dot(from, from) - 1);
            const float t = (-half - std::sqrt(std::max(root, 0.0f))) / a;
            const glm::vec3 normal = scene::ellipsoidNormal(modelFromSphere, view.eyeWorld + t * ray);
            if (glm::dot(normal, glm::normalize(ray)) > -0.3f) continue; // a pixel spans much of the rim
            ++compared;
            // Half a step of rounding; facets of a fifteenth of a radian, seen through the scales.
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(picture.at(x, y)[c], 255 * (0.5f + 0.5f * normal[c]), 2.5f)
                    << x << "," << y << " channel " << c;
        }
    EXPECT_GT(compared, 500);
}

} // namespace
} // namespace shoal
