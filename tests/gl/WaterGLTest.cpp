// Drawn water, and the particles that drift in it.
#include "Spheres.h"
#include "engine/render/ParticlePass.h"
#include "tests/unit/water/SeenThrough.h"

namespace shoal {
namespace {

class WaterGL : public WithContext {};

water::Water someWater() {
    water::Water water;
    water.veil = {{{0.02f, 0.13f, 0.25f}, {0.01f, 0.03f, 0.02f}, {0.01f, 0.03f, 0.06f}, {0, 0.01f, 0.01f}}};
    water.veil[7] = {0.005f, -0.03f, 0.02f};
    water.attenuation_perM = {0.22f, 0.12f, 0.09f};
    return water;
}

// The shader's water agrees with the formulas on the processor: a white matte sphere in even light sends back
// that light, dimmed and veiled by the water between.
TEST_F(WaterGL, ASphereSinksIntoTheVeilAsComputed) {
    const Lit lit(uniformFrame(150, 140, 120));
    const glm::vec3 display(150 / 255.0f, 140 / 255.0f, 120 / 255.0f);
    for (const float distance_m : {0.5f, 4.0f, 30.0f})
        for (const glm::vec3 ahead :
             {glm::vec3(0, 0, -1), glm::vec3(0.6f, 0.8f, 0), glm::vec3(0, -0.6f, 0.8f)}) {
            const glm::vec3 eye = -ahead * (distance_m + 1); // to the sphere's near side
            const glm::vec3 side = glm::normalize(glm::cross(ahead, glm::vec3(0.9f, 0.1f, 0.2f)));
            const render::View view{.eyeWorld = eye,
                                    .worldFromEye =
                                        glm::quat_cast(glm::mat3(side, glm::cross(-ahead, side), -ahead)),
                                    .verticalFov = 0.02f,
                                    .aspect = 1};
            const ImageRgba8 picture =
                drawSphere(sphere(0, 1), lit.environment, view, 9, {.water = someWater()});
            const glm::vec3 expected = 255.0f * water::seenThrough(someWater(), display, ahead, distance_m);
            // Rounding of the picture and the frame's light as half floats; vertices a few hundredths of a
            // radian apart on the sphere are at most a millimetre behind its surface.
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(picture.at(4, 4)[c], expected[c], 1.5f) << distance_m << " m, channel " << c;
        }
}

struct Snowfall {
    ImageRgba8 picture;
    int specks = 0; // pixels that are not black
};

// layer: see EyePicture; it is twice as wide as the picture.
Snowfall snowAt(double time_s, GLuint layer = 0) {
    const Lit lit(uniformFrame(150, 140, 120));
    auto pass = tests::valueOf(render::ParticlePass::make());
    const gl::Target target(320, 180, 1);
    fill(target);
    const render::View view{.heightPixels = 180};
    const render::EyePicture picture{
        .environment = lit.environment, .view = view, .canvas = target, .layer = layer, .layerWidth = 2};
    EXPECT_TRUE(pass.draw(layer ? render::ParticlePass::On::Picture : render::ParticlePass::On::Everything,
                          picture, someWater(), time_s));
    Snowfall fall{target.read()};
    for (size_t i = 0; i < fall.picture.pixels.size(); i += 4) fall.specks += fall.picture.pixels[i + 1] > 4;
    return fall;
}

TEST_F(WaterGL, SnowIsThereAndFollowsTimeAlone) {
    const Snowfall one = snowAt(3), same = snowAt(3), later = snowAt(3.5);
    EXPECT_GT(one.specks, 20); // of 600 in all directions
    EXPECT_LT(one.specks, 320 * 180 / 50);
    EXPECT_EQ(one.picture.pixels, same.picture.pixels);
    EXPECT_NE(one.picture.pixels, later.picture.pixels);
    EXPECT_GT(snowAt(7200).specks, 20); // after hours too
}

// An object from the layer's left edge to 5/8 of its width reaches to 3/4 of the picture's.
TEST_F(WaterGL, ObjectsHideSnow) {
    const gl::Target layer(320, 180, 1);
    fill(layer, {0, 0, 0, 0});
    fill(0, 0, 200, 180, glm::vec4(1));
    const Snowfall all = snowAt(3), left = snowAt(3, layer.texture());
    for (int y = 0; y < 180; ++y)
        for (int x = 0; x < 320; ++x) {
            if (x >= 238 && x < 242) continue; // the filter's pixels
            EXPECT_EQ(left.picture.at(x, y)[1], x < 240 ? 0 : all.picture.at(x, y)[1]) << x << ", " << y;
        }
    EXPECT_GT(left.specks, 0);
}

} // namespace
} // namespace shoal
