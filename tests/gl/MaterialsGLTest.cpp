// Materials of glTF's extensions: unlit ones show their own colours, dielectrics reflect what theirs say.
#include "Spheres.h"
#include "engine/light/InverseToneMap.h"
#include "engine/math/Brdf.h"
#include "engine/math/Colour.h"

namespace shoal {
namespace {

class MaterialsGL : public WithContext {};

constexpr int kAcross = 64;
// Light by the pixel; and by the vertex, as for small objects where detail is lean.
constexpr render::Detail kDetails[] = {render::Detail::Full, render::Detail::Lean};
const render::View kSphereView{
    .eyeWorld = {0, 0, 3}, .verticalFov = 0.9f, .aspect = 1, .heightPixels = kAcross};

ImageRgba8 drawn(const scene::Model& model, const Lit& lit, render::Detail detail, float exposure_ev = 0) {
    return drawSphere(model, lit.environment, kSphereView, kAcross,
                      {.exposure_ev = exposure_ev, .detail = detail});
}

// A dielectric that reflects this share of light head on and at the rim.
scene::Model dielectric(float roughness, const glm::vec3& base, const glm::vec3& f0, float f90) {
    scene::Model model = sphere(0, roughness);
    model.materials[0].baseColourLin = glm::vec4(base, 1);
    model.materials[0].dielectricF0 = f0;
    model.materials[0].dielectricF90 = f90;
    return model;
}

scene::Model unlitSphere(const glm::vec4& colourLin) {
    scene::Model model = sphere(1, 1);
    model.materials[0].unlit = true;
    model.materials[0].baseColourLin = colourLin;
    return model;
}

glm::vec4 linear(const glm::vec4& coded) {
    glm::vec4 lin = coded;
    for (int c = 0; c < 3; ++c) lin[c] = math::linearFromSrgb(coded[c]);
    return lin;
}

using RgbaTexel = std::array<uint8_t, 4>;
using Use = scene::TextureUse scene::Material::*;

// Gives the model one texture, of this colour all over.
void setTexture(scene::Model& model, const RgbaTexel& texel, Use use = &scene::Material::baseColour) {
    model.images = {ImageRgba8(1, 1)};
    std::ranges::copy(texel, model.images[0].pixels.begin());
    model.textures = {{.image = 0}};
    model.materials[0].*use = {0, 0};
    model.meshes[0].primitives[0].texCoords[0].assign(model.meshes[0].primitives[0].positions.size(), {});
}

// KHR_materials_unlit: a base colour is shown as it is coded, in any light, at any exposure, by any curve.
TEST_F(MaterialsGL, UnlitColoursAreShownAsTheyAreCoded) {
    for (const ImageRgb8& video : {uniformFrame(0, 0, 0), uniformFrame(255, 200, 40)})
        for (const float exposure_ev : {0.0f, -2.0f, 3.0f})
            for (const render::Detail detail : kDetails) {
                const Lit lit(video);
                const glm::vec4 coded(200, 100, 3, 255);
                // A factor: half a step of rounding.
                expectColour(drawn(unlitSphere(linear(coded / 255.0f)), lit, detail, exposure_ev), coded,
                             0.5f);
                // A texture, decoded and coded: the same steps.
                scene::Model textured = unlitSphere(glm::vec4(1));
                setTexture(textured, {200, 100, 3, 255});
                expectColour(drawn(textured, lit, detail, exposure_ev), coded, 0.5f);
            }
}

// Factor, texture and vertex colour multiply as linear values do.
TEST_F(MaterialsGL, UnlitColoursMultiplyLinearly) {
    const Lit lit(uniformFrame(90, 90, 90));
    const glm::vec4 factor(0.25f, 0.5f, 1, 1), vertex(1, 0.5f, 0.2f, 1);
    for (const render::Detail detail : kDetails) {
        scene::Model model = unlitSphere(factor);
        setTexture(model, {255, 128, 128, 255});
        model.meshes[0].primitives[0].coloursLin.assign(model.meshes[0].primitives[0].positions.size(),
                                                        vertex);
        glm::vec4 expected = factor * vertex * linear(glm::vec4(255, 128, 128, 255) / 255.0f);
        for (int c = 0; c < 3; ++c) expected[c] = math::srgbFromLinear(expected[c]);
        // Half a step of rounding, and half floats' hundredth of one.
        expectColour(drawn(model, lit, detail), 255.0f * expected, 0.6f);
    }
}

// Its opacity counts as any other's: blended it is premultiplied, masked it is there or not.
TEST_F(MaterialsGL, UnlitSurfacesHaveAlphaModes) {
    const Lit lit(uniformFrame(90, 90, 90));
    for (const render::Detail detail : kDetails) {
        scene::Model model = unlitSphere(linear(glm::vec4(200, 100, 50, 0) / 255.0f));
        scene::Material& material = model.materials[0];
        material.doubleSided = false; // once over each pixel, in its finest, convex detail
        render::View view = kSphereView;
        view.heightPixels = 0;
        material.baseColourLin.a = 0.5f;
        const auto drawnAs = [&](scene::AlphaMode mode) {
            material.alphaMode = mode;
            return drawSphere(model, lit.environment, view, kAcross, {.detail = detail});
        };
        expectColour(drawnAs(scene::AlphaMode::Opaque), {200, 100, 50, 255}, 0.5f);
        expectColour(drawnAs(scene::AlphaMode::Blend), {100, 50, 25, 127.5f}, 1);
        material.alphaCutoff = 0.4f;
        expectColour(drawnAs(scene::AlphaMode::Mask), {200, 100, 50, 255}, 0.5f);
        material.alphaCutoff = 0.6f;
        const ImageRgba8 nothing = drawnAs(scene::AlphaMode::Mask);
        EXPECT_TRUE(std::ranges::all_of(nothing.pixels, [](uint8_t value) { return value == 0; }));
    }
}

// A black dielectric sends back the split sum's share of even light, and what its facets pass on.
TEST_F(MaterialsGL, DielectricsReflectTheirShareHeadOn) {
    const Lit lit(uniformFrame(200, 180, 160));
    const glm::vec3 arrives = light::radianceFromDisplay(glm::vec3(200, 180, 160) / 255.0f);
    struct Case {
        glm::vec3 f0;
        float f90;
    };
    for (const auto& [f0, f90] : {Case{glm::vec3(0), 1}, Case{glm::vec3(0.172f), 1}, Case{glm::vec3(1), 1},
                                  Case{{0.5f, 0.04f, 0}, 0.5f}, Case{glm::vec3(0), 0}})
        for (const float roughness : {0.3f, 1.0f})
            for (const render::Detail detail : kDetails) {
                const scene::Model model = dielectric(roughness, glm::vec3(0), f0, f90);
                // The table of 64 steps ends here: at the middle of its last texels.
                constexpr double kLast = 127.0 / 128;
                const math::Dfg dfg = math::dfg(kLast, std::min(static_cast<double>(roughness), kLast));
                const auto scale = static_cast<float>(dfg.scale), bias = static_cast<float>(dfg.bias);
                const glm::vec3 single = f0 * scale + f90 * bias, average = f0 + (f90 - f0) / 21.0f;
                const float lost = 1 - scale - bias;
                const glm::vec3 all = single + single * average / (1.0f - lost * average) * lost;
                const glm::vec3 shown = light::displayFromRadiance(all * arrives) * 255.0f;
                const ImageRgba8 picture = drawn(model, lit, detail);
                // Rounding, and the table between its steps, where dark colours are steep.
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(picture.at(32, 32)[c], shown[c], 1.5f)
                        << "channel " << c << " F0 " << f0.x << " roughness " << roughness;
            }
}

// KHR_materials_specular with a factor of 0: from the middle to the rim nothing is reflected, all enters.
TEST_F(MaterialsGL, WithoutSpecularASurfaceIsMatte) {
    const Lit lit(uniformFrame(200, 180, 160));
    for (const float base : {1.0f, 0.3f})
        for (const float roughness : {0.1f, 1.0f})
            for (const render::Detail detail : kDetails) {
                const scene::Model model = dielectric(roughness, glm::vec3(base), glm::vec3(0), 0);
                const glm::vec3 left =
                    std::pow(base, 1 / 2.2f) * light::radianceFromDisplay(glm::vec3(200, 180, 160) / 255.0f);
                // A step of the display; half floats hold radiance to 1 in 2048.
                expectColour(drawn(model, lit, detail),
                             glm::vec4(light::displayFromRadiance(left) * 255.0f, 255), 1);
            }
}

// An index of refraction next to 1.5 differs as little, though another program draws it; no metal knows it.
TEST_F(MaterialsGL, DielectricsNextToTheUsualOneLookLikeIt) {
    const Lit lit(uniformFrame(200, 180, 160));
    for (const float metallic : {0.0f, 1.0f})
        for (const render::Detail detail : kDetails) {
            scene::Model model = sphere(metallic, 0.4f);
            model.materials[0].baseColourLin = {0.6f, 0.3f, 0.1f, 1};
            const ImageRgba8 usual = drawn(model, lit, detail);
            model.materials[0].dielectricF0 = glm::vec3(0.0400001f);
            if (metallic == 1) model.materials[0].dielectricF0 = {1, 0, 0.5f};
            expectAlike(usual, drawn(model, lit, detail), 1);
        }
}

// A coloured reflection takes as much as its strongest channel: matte light has no opposite colour.
TEST_F(MaterialsGL, ColouredReflectionsLeaveTheMatteLightWithoutColour) {
    const Lit lit(uniformFrame(128, 128, 128));
    for (const render::Detail detail : kDetails) {
        scene::Model model = sphere(0, 0.2f);
        model.materials[0].dielectricF0 = {1, 0, 0}; // of a white base, whose channels would fill up
        const ImageRgba8 picture = drawn(model, lit, detail);
        EXPECT_NEAR(picture.at(32, 32)[0], 128, 1);
        EXPECT_LT(picture.at(32, 32)[1], 40);
        EXPECT_LT(picture.at(32, 32)[2], 40);
    }
}

// KHR_materials_clearcoat. Head on, over what reflects nothing, its own share of even light.
TEST_F(MaterialsGL, ClearcoatsReflectTheirShareHeadOn) {
    const Lit lit(uniformFrame(250, 240, 230));
    const glm::vec3 arrives = light::radianceFromDisplay(glm::vec3(250, 240, 230) / 255.0f);
    for (const float coat : {1.0f, 0.5f})
        for (const float coatRoughness : {0.0f, 0.5f})
            for (const render::Detail detail : kDetails) {
                scene::Model model = dielectric(1, glm::vec3(0), glm::vec3(0), 0);
                model.materials[0].clearcoat = coat;
                model.materials[0].clearcoatRoughness = coatRoughness;
                const math::Dfg dfg =
                    math::dfg(127.0 / 128, std::max(static_cast<double>(coatRoughness), 1.0 / 128));
                const auto share = coat * static_cast<float>(0.04 * dfg.scale + dfg.bias);
                const glm::vec3 shown = light::displayFromRadiance(share * arrives) * 255.0f;
                const ImageRgba8 picture = drawn(model, lit, detail);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(picture.at(32, 32)[c], shown[c], 1.5f)
                        << "channel " << c << " coat " << coat << " roughness " << coatRoughness;
            }
}

// Each texture of KHR_materials_specular and KHR_materials_clearcoat that is the same all over is another
// factor: in its own channels, a colour decoded, all others without meaning.
TEST_F(MaterialsGL, TexturesOfLayersMultiplyTheirFactors) {
    const Lit lit(uniformFrame(200, 180, 160));
    struct Case {
        Use use;
        RgbaTexel texel;
        void (*factor)(scene::Material&);
    };
    const auto cases = std::to_array<Case>({
        {&scene::Material::specular,
         {0, 9, 99, 51},
         [](scene::Material& m) { m.dielectricF0 *= 0.2f, m.dielectricF90 *= 0.2f; }},
        {&scene::Material::specularColour,
         {255, 188, 0, 9},
         [](scene::Material& m) { m.dielectricF0 *= glm::vec3(1, linear(glm::vec4(188 / 255.0f)).x, 0); }},
        {&scene::Material::coat, {102, 9, 99, 0}, [](scene::Material& m) { m.clearcoat *= 0.4f; }},
        {&scene::Material::coatRoughness,
         {9, 153, 99, 0},
         [](scene::Material& m) { m.clearcoatRoughness *= 0.6f; }},
    });
    for (const Case& each : cases)
        for (const render::Detail detail : kDetails) {
            scene::Model model = sphere(0, 0.4f);
            scene::Material& material = model.materials[0];
            material.baseColourLin = {0.2f, 0.1f, 0.1f, 1};
            material.dielectricF0 = glm::vec3(0.3f);
            material.clearcoat = 0.8f;
            material.clearcoatRoughness = 0.7f;
            const auto draw = [&] { return drawn(model, lit, detail); };
            const auto drawWith = [&](const RgbaTexel& texel) {
                setTexture(model, texel, each.use);
                return draw();
            };
            const ImageRgba8 textured = drawWith(each.texel), white = drawWith({255, 255, 255, 255});
            EXPECT_NE(textured.pixels, white.pixels);
            each.factor(material);
            expectAlike(textured, drawWith({255, 255, 255, 255}), 1);
            if (detail == render::Detail::Lean) continue; // without textures they are drawn by the vertex
            material.*each.use = {};
            expectAlike(textured, draw(), 1);
        }
}

// Light that a coat reflects does not reach below it: white in even light stays white, a glow is dimmed.
TEST_F(MaterialsGL, ClearcoatsTakeFromBelowWhatTheyReflect) {
    const glm::vec4 video(200, 180, 160, 255);
    const Lit lit(uniformFrame(200, 180, 160));
    for (const float coatRoughness : {0.0f, 0.4f, 1.0f})
        for (const render::Detail detail : kDetails) {
            scene::Model model = sphere(0, 1);
            model.materials[0].clearcoat = 1;
            model.materials[0].clearcoatRoughness = coatRoughness;
            // A step of the display; half floats hold radiance to 1 in 2048.
            expectColour(drawn(model, lit, detail), video, 1);
        }
    scene::Model glowing = dielectric(1, glm::vec3(0), glm::vec3(0), 0);
    glowing.materials[0].emissiveLin = light::radianceFromDisplay(glm::vec3(video) / 255.0f);
    glowing.materials[0].clearcoat = 1;
    expectColour(drawn(glowing, lit, render::Detail::Full), video, 1);
}

} // namespace
} // namespace shoal
