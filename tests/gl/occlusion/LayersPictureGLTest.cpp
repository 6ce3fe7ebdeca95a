// A body in the light of its own layered fragment buffers: it shadows and reflects itself.
#include "content/make/models/occlusion/Bvh.h"
#include "content/make/models/occlusion/TraceSelfOcclusion.h"
#include "engine/math/Colour.h"
#include "engine/occlusion/Directions.h"
#include "tests/gl/Spheres.h"
#include "tests/unit/occlusion/Bodies.h"

namespace shoal {
namespace {

using occlusion::LayerMethod, occlusion::LayersGpu;

constexpr int kSize = 32;

class LayersPicture : public WithContext {
  protected:
    void setUpInContext() override {
        if (epoxy_gl_version() < 43) GTEST_SKIP() << "layers need OpenGL 4.3";
    }
    const occlusion::Body body_ = occlusion::torus(1, 0.4f, 96, 48); // around +Y

    scene::Model modelOf(const glm::vec3& base, float metallic, float roughness) const {
        scene::Primitive primitive;
        primitive.positions = body_.positions;
        primitive.normals = body_.normals;
        for (const glm::uvec3& t : body_.triangles)
            primitive.indices.insert(primitive.indices.end(), {t.x, t.y, t.z});
        return shoal::modelOf(
            std::move(primitive),
            {.baseColourLin = glm::vec4(base, 1), .metallic = metallic, .roughness = roughness});
    }

    // Mean radiance around the middle of a picture of a place of the body. No method: nothing hides light.
    glm::vec3 radianceAt(const scene::Model& model, const glm::vec3& place, const glm::vec3& towardsEye,
                         std::optional<LayerMethod> method,
                         const occlusion::Ollfb::Options& options = {}) const {
        render::EnvironmentGpu environment;
        environment.uploadLight(evenLight());
        std::optional<LayersGpu> layers;
        if (method) {
            auto made = tests::valueOf(LayersGpu::make(body_.mesh(), *method, options));
            EXPECT_EQ(made.method(), *method);
            layers = std::move(made);
        }
        const glm::vec3 towards = glm::normalize(towardsEye);
        const render::View view{.eyeWorld = place + 5.0f * towards,
                                .worldFromEye = glm::quatLookAt(-towards, glm::vec3(0, 0, 1)),
                                .verticalFov = 0.01f, // 50 mm across
                                .aspect = 1};
        const render::BodyOccluders body{.albedo = glm::vec3(model.materials[0].baseColourLin)};
        const ImageRgba8 picture = drawSphere(model, environment, view, kSize,
                                              {.curve = render::ToneCurve::Linear,
                                               .body = &body,
                                               .layers = layers ? &*layers : nullptr,
                                               .radius = 1.5f});
        glm::dvec3 sum(0);
        for (int y = kSize / 4; y < kSize * 3 / 4; ++y)
            for (int x = kSize / 4; x < kSize * 3 / 4; ++x)
                for (int c = 0; c < 3; ++c) sum[c] += math::linearFromSrgb(picture.at(x, y)[c] / 255.0);
        return glm::vec3(sum * 4.0 / static_cast<double>(kSize * kSize));
    }

    // Place and normal: at `down` radians below the middle of the hole's wall.
    static glm::vec3 wall(float down) { return {1 - 0.4f * std::cos(down), -0.4f * std::sin(down), 0}; }
    static glm::vec3 wallNormal(float down) { return {-std::cos(down), -std::sin(down), 0}; }
};

// A matte body sends the share of the light that is free, and its own colour times the rest.
TEST_F(LayersPicture, AHolesWallIsAsDarkAsTheLightThatReachesIt) {
    const float base = 0.4f;
    const scene::Model model = modelOf(glm::vec3(base), 0, 1);
    const glm::vec3 place = wall(0), normal = wallNormal(0), eye(-1, 0.8f, 0);
    const occlusion::Bvh bvh(body_.positions, model.meshes[0].primitives[0].indices);
    const auto directions = occlusion::cosineDirections(4000);
    float open = 0;
    for (const glm::vec3& d : directions)
        open += !bvh.blocked(place + 1e-3f * normal, occlusion::frameAround(normal) * d, 0, INFINITY);
    open /= static_cast<float>(directions.size());
    ASSERT_LT(open, 0.8f) << "a place with something in its light's way";
    const float expected = open + base * (1 - open);
    const float off = radianceAt(model, place, eye, {}).g;
    // tests/bench/figures/occlusion.md: of 32 directions in the hemisphere, 6 % where light is taken.
    for (const LayerMethod method : {LayerMethod::Ollfb, LayerMethod::Thesis})
        EXPECT_NEAR(radianceAt(model, place, eye, method).g / off, expected, 0.06f * expected)
            << static_cast<int>(method);
    // A surface that faces away from all of the body keeps its light.
    const glm::vec3 outside(1.4f, 0, 0);
    const float free = radianceAt(model, outside, {1, 0.3f, 0}, {}).g;
    EXPECT_NEAR(radianceAt(model, outside, {1, 0.3f, 0}, LayerMethod::Ollfb).g, free, 0.01f * free);
}

// Light that another part of a red metal reflects first is redder by that reflection.
TEST_F(LayersPicture, AMirrorShowsItselfOnceMore) {
    const scene::Model model = modelOf({1, 0.3f, 0.3f}, 1, 0);
    const glm::vec3 place = wall(-0.4f), eye(-0.5f, 0.866f, 0); // reflected to the other side of the hole
    const auto colour = [&](std::optional<LayerMethod> method) {
        const glm::vec3 seen = radianceAt(model, place, eye, method);
        return seen.g / seen.r;
    };
    const float once = colour({});
    EXPECT_NEAR(once, 0.3f, 0.03f);
    for (const LayerMethod method : {LayerMethod::Ollfb, LayerMethod::Thesis})
        EXPECT_LT(colour(method), 0.4f * once) << static_cast<int>(method);
}

// A surface that sends all light on is as bright as the light around it, whatever it sees of itself.
TEST_F(LayersPicture, WhiteInEvenLightStaysWhite) {
    for (const float metallic : {0.0f, 1.0f})
        for (const LayerMethod method : {LayerMethod::Ollfb, LayerMethod::Thesis}) {
            const scene::Model model = modelOf(glm::vec3(1), metallic, 0.3f);
            const glm::vec3 place = wall(-0.4f), eye(-0.5f, 0.866f, 0);
            // The split sum's own loss at the surface itself is in both.
            const float off = radianceAt(model, place, eye, {}).g;
            EXPECT_NEAR(off, kEvenLight, 0.03f);
            for (const auto& [views, size] : {std::pair{150, 64}, {6, 8}, {54, 32}, {486, 64}})
                EXPECT_NEAR(radianceAt(model, place, eye, method, {views, size}).g, off, 0.03f)
                    << metallic << ", " << views << " views of " << size;
        }
}

TEST(ThesisViews, AreSixTimesASquare) {
    for (const auto& [views, cells] : {std::pair{6, 1}, {54, 3}, {150, 5}, {486, 9}, {1536, 16}})
        EXPECT_EQ(occlusion::ThesisViews::cellsFor(views), cells);
    for (const int views : {7, 53, 55, 100, 485})
        EXPECT_EQ(occlusion::ThesisViews::cellsFor(views), std::nullopt);
}

} // namespace
} // namespace shoal
