// A context to draw in, and spheres in even and uneven light.
#pragma once

#include "engine/gl/Target.h"
#include "engine/light/MakeLight.h"
#include "engine/light/PackedLight.h"
#include "engine/math/LatLong.h"
#include "engine/media/Pictures.h"
#include "engine/platform/Window.h"
#include "engine/render/ObjectPass.h"
#include "tests/Cells.h"
#include "tests/Test.h"

namespace shoal {

// Base of tests that draw; they are skipped without OpenGL.
class WithContext : public testing::Test {
  protected:
    void SetUp() final {
        auto context = platform::Headless::open();
        if (!context) GTEST_SKIP() << context.error().message();
        context_ = std::move(*context);
        setUpInContext();
    }
    virtual void setUpInContext() {}

    std::optional<platform::Headless> context_;
};

inline scene::Model modelOf(scene::Primitive primitive, const scene::Material& material) {
    scene::Model model;
    primitive.material = 0;
    model.materials.push_back(material);
    model.meshes.push_back({{std::move(primitive)}, {}});
    model.nodes.push_back({.name = "it", .mesh = 0});
    model.order = {0};
    return model;
}

// A sphere of radius 1 at the origin.
inline scene::Model sphere(float metallic, float roughness) {
    scene::Primitive primitive;
    tests::addCells(primitive.positions, primitive.indices, 96, 48,
                    [](float u, float v) { return directionFromLatLong(glm::vec2(u, v)); });
    primitive.normals = primitive.positions;
    return modelOf(std::move(primitive), {.metallic = metallic, .roughness = roughness, .doubleSided = true});
}

inline scene::Pose restingPose(const scene::Model& model) {
    scene::Pose pose;
    scene::restPose(model, pose);
    scene::updateGlobals(model, pose);
    return pose;
}

// Binds the target and fills it; depth: as the depth buffer holds it.
inline void fill(const gl::Target& target, const glm::vec4& colour = glm::vec4(0), float depth = 1) {
    target.bind();
    glClearColor(colour.r, colour.g, colour.b, colour.a);
    glClearDepth(static_cast<double>(depth));
    glDepthMask(GL_TRUE);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glClearDepth(1);
}

// Fills a rectangle of the bound target's colour.
inline void fill(int x, int y, int width, int height, const glm::vec4& colour) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(x, y, width, height);
    glClearColor(colour.r, colour.g, colour.b, colour.a);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
}

inline ImageRgb8 uniformFrame(uint8_t r, uint8_t g, uint8_t b) { return evenFrame(64, 32, r, g, b); }

inline light::EnvironmentLight lightMadeOf(const ImageRgb8& frame,
                                           light::FrameRadiance frames = light::FrameRadiance::Thesis) {
    light::EnvironmentLight made;
    light::LightMaker maker({.baseWidth = 512, .minRoughness = 0.1f, .frames = frames});
    maker.make(viewOf(frame), made);
    return made;
}

inline light::PackedLight lightOf(const ImageRgb8& frame,
                                  light::FrameRadiance frames = light::FrameRadiance::Thesis) {
    light::PackedLight packed;
    light::packLight(lightMadeOf(frame, frames), light::MirrorMaps::Mirrors, packed);
    return packed;
}

// Light of one radiance from all directions.
constexpr float kEvenLight = 0.8f;
inline light::PackedLight evenLight() {
    constexpr uint16_t kHalf = 0x3a66; // 0.8 as a half float
    light::PackedLight light = lightOf(uniformFrame(0, 0, 0));
    for (size_t i = 0; i < light.atlas.pixels.size(); ++i)
        if (i % 4 != 3) light.atlas.pixels[i] = kHalf;
    for (light::HalfImage& mirror : light.mirrors) std::ranges::fill(mirror.pixels, kHalf);
    return light;
}

// An environment that shows a frame and is lit by it.
struct Lit {
    explicit Lit(const ImageRgb8& frame, light::FrameRadiance frames = light::FrameRadiance::Thesis) {
        media::toBgra(frame, false, shown);
        environment.setFrame({shown.pixels.data(), shown.width, shown.height, shown.width});
        environment.uploadLight(lightOf(frame, frames));
    }
    ImageRgba8 shown;
    render::EnvironmentGpu environment;
};

inline glm::quat looking(const glm::vec3& direction) {
    const glm::vec3 up =
        std::abs(direction.y) > 0.9f * glm::length(direction) ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    return glm::quatLookAt(glm::normalize(direction), up);
}

// Returns the ray through the middle of a pixel of a picture with that many, row 0 at the top; as long as to
// the plane z = -1 of the eye's frame, in the world's.
inline glm::vec3 rayThrough(const render::View& view, int x, int y, glm::vec2 pixels) {
    const glm::vec2 share = (glm::vec2(x, y) + 0.5f) / pixels;
    const glm::vec2 ndc(2 * share.x - 1, 1 - 2 * share.y);
    return view.worldFromEye * glm::vec3(ndc * view.halfExtent(), -1);
}

// Returns the depth buffer's value for a place so far ahead.
inline float depthAt(float away_m, const render::View& view) {
    return (view.far_m - view.near_m * view.far_m / away_m) / (view.far_m - view.near_m);
}

// Draws these objects over nothing.
inline ImageRgba8 drawObjects(render::ObjectPass& pass,
                              const std::vector<render::ObjectPass::Object>& objects,
                              const render::EyePicture& picture, const water::Water& water = {}) {
    fill(picture.canvas);
    pass.begin();
    for (const auto& object : objects) pass.add(object);
    EXPECT_TRUE(pass.draw(picture, water, render::Glossy::Prefiltered));
    return picture.canvas.read();
}

struct SphereLook {
    float exposure_ev = 0;
    water::Water water = {};
    render::Detail detail = render::Detail::Full;
    float highlight = 0;
    render::ShownQuantity shown = render::ShownQuantity::Light;
    render::FrameCoding frames = render::FrameCoding::Thesis;
    const depth::LightHarmonics* beside = nullptr; // as render::ObjectPass has it
    render::ToneCurve curve = render::ToneCurve::InverseOfVideo;
    const render::BodyOccluders* body = nullptr;
    const occlusion::LayersGpu* layers = nullptr;
    float radius = 1; // around the origin, of what is drawn
};

// size: pixels of a side.
inline ImageRgba8 drawSphere(const scene::Model& model, const render::EnvironmentGpu& environment,
                             const render::View& view, int size, const SphereLook& look = {}) {
    auto pass = tests::valueOf(render::ObjectPass::make(look.detail, true, look.shown));
    const render::Exposure exposure{look.curve, look.exposure_ev, look.frames};
    const render::ModelGpu gpu = render::uploadModel(
        model, exposure.isLinear() ? render::Reflectance::Linear : render::Reflectance::Coded, look.detail);
    const scene::Pose pose = restingPose(model);
    const gl::Target target(size, size, 1);
    pass.setLayers(look.layers);
    return drawObjects(pass,
                       {{.model = model,
                         .gpu = gpu,
                         .pose = pose,
                         .bound = {{}, look.radius},
                         .body = look.body,
                         .highlight = look.highlight,
                         .lightDifference = look.beside}},
                       {.environment = environment, .view = view, .exposure = exposure, .canvas = target},
                       look.water);
}

// Expects that pixels which both pictures cover wholly differ by at most `within`.
inline void expectAlike(const ImageRgba8& a, const ImageRgba8& b, int within) {
    int covered = 0;
    for (size_t i = 0; i < a.pixels.size(); i += 4) {
        if (a.pixels[i + 3] != 255 || b.pixels[i + 3] != 255) continue;
        ++covered;
        for (size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(a.pixels[i + c], b.pixels[i + c], within) << "channel " << c << " of pixel " << i / 4;
    }
    EXPECT_GT(covered, 1000);
}

// Expects this colour in all covered pixels.
inline void expectColour(const ImageRgba8& picture, const glm::vec4& colour, float within) {
    int covered = 0;
    for (size_t i = 0; i < picture.pixels.size(); i += 4) {
        if (picture.pixels[i + 3] == 0) continue;
        ++covered;
        for (size_t c = 0; c < 4; ++c)
            ASSERT_NEAR(picture.pixels[i + c], colour[static_cast<int>(c)], within)
                << "channel " << c << " of pixel " << i / 4;
    }
    EXPECT_GT(covered, 1000);
}

} // namespace shoal
