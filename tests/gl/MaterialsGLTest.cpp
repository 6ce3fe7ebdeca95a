// Materials of glTF's extensions: what is unlit shows its own colours.
#include "Spheres.h"
#include "engine/math/Colour.h"

#include <gtest/gtest.h>

namespace shoal {
namespace {

class MaterialsGL : public WithContext {};

constexpr int kAcross = 64;
// By the pixel; and as what is small where detail is lean, by the vertex.
constexpr render::Detail kDetails[] = {render::Detail::Full, render::Detail::Lean};
const render::View kSphereView{
    .eyeWorld = {0, 0, 3}, .verticalFov = 0.9f, .aspect = 1, .heightPixels = kAcross};

struct Lit {
    explicit Lit(const ImageRgb8& frame) { environment.uploadLight(lightOf(frame)); }
    render::EnvironmentGpu environment;
};

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

// One texture of this colour all over.
void addTexture(scene::Model& model, const glm::u8vec4& texel) {
    ImageRgba8 image(4, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            for (int c = 0; c < 4; ++c) image.at(x, y)[c] = texel[c];
    model.images.push_back(image);
    model.textures.push_back({.image = 0});
    model.materials[0].baseColour = {0, 0};
    model.meshes[0].primitives[0].texCoords[0].assign(model.meshes[0].primitives[0].positions.size(), {});
}

// All that it covers has this colour.
void expectColour(const ImageRgba8& picture, const glm::vec4& colour, float within) {
    int covered = 0;
    for (size_t i = 0; i < picture.pixels.size(); i += 4) {
        if (picture.pixels[i + 3] == 0) continue;
        ++covered;
        for (size_t c = 0; c < 4; ++c)
            ASSERT_NEAR(picture.pixels[i + c], colour[static_cast<int>(c)], within)
                << "channel " << c << " at " << i / 4 % kAcross << "," << i / 4 / kAcross;
    }
    EXPECT_GT(covered, 1000);
}

// KHR_materials_unlit: a base colour is shown as it is coded, in any light, at any exposure, by any curve.
TEST_F(MaterialsGL, UnlitColoursAreShownAsTheyAreCoded) {
    for (const ImageRgb8& video : {uniformFrame(0, 0, 0), uniformFrame(255, 200, 40)})
        for (const float exposure_ev : {0.0f, -2.0f, 3.0f})
            for (const render::Detail detail : kDetails) {
                const Lit lit(video);
                const glm::vec4 coded(200, 100, 3, 255);
                // A factor: half a step of rounding.
                expectColour(drawSphere(unlitSphere(linear(coded / 255.0f)), lit.environment, kSphereView,
                                        exposure_ev, kAcross, {}, detail),
                             coded, 0.5f);
                // A texture, decoded and coded: the same steps.
                scene::Model textured = unlitSphere(glm::vec4(1));
                addTexture(textured, {200, 100, 3, 255});
                expectColour(
                    drawSphere(textured, lit.environment, kSphereView, exposure_ev, kAcross, {}, detail),
                    coded, 0.5f);
            }
}

// Factor, texture and vertex colour multiply as linear values do.
TEST_F(MaterialsGL, UnlitColoursMultiplyLinearly) {
    const Lit lit(uniformFrame(90, 90, 90));
    const glm::vec4 factor(0.25f, 0.5f, 1, 1), vertex(1, 0.5f, 0.2f, 1);
    for (const render::Detail detail : kDetails) {
        scene::Model model = unlitSphere(factor);
        addTexture(model, {255, 128, 128, 255});
        model.meshes[0].primitives[0].coloursLin.assign(model.meshes[0].primitives[0].positions.size(),
                                                        vertex);
        glm::vec4 expected = factor * vertex * linear(glm::vec4(255, 128, 128, 255) / 255.0f);
        for (int c = 0; c < 3; ++c)
            expected[c] = expected[c] <= 0.0031308f ? 12.92f * expected[c]
                                                    : 1.055f * std::pow(expected[c], 1 / 2.4f) - 0.055f;
        // Half a step of rounding, and half floats' hundredth of one.
        expectColour(drawSphere(model, lit.environment, kSphereView, 0, kAcross, {}, detail),
                     255.0f * expected, 0.6f);
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
        const auto drawn = [&](scene::AlphaMode mode) {
            material.alphaMode = mode;
            return drawSphere(model, lit.environment, view, 0, kAcross, {}, detail);
        };
        expectColour(drawn(scene::AlphaMode::Opaque), {200, 100, 50, 255}, 0.5f);
        expectColour(drawn(scene::AlphaMode::Blend), {100, 50, 25, 127.5f}, 1);
        material.alphaCutoff = 0.4f;
        expectColour(drawn(scene::AlphaMode::Mask), {200, 100, 50, 255}, 0.5f);
        material.alphaCutoff = 0.6f;
        const ImageRgba8 nothing = drawn(scene::AlphaMode::Mask);
        EXPECT_TRUE(std::ranges::all_of(nothing.pixels, [](uint8_t value) { return value == 0; }));
    }
}

} // namespace
} // namespace shoal
