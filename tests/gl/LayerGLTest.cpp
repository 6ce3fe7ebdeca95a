// Objects that share the video's resolution.
#include "Spheres.h"
#include "engine/render/LayerPass.h"

namespace shoal {
namespace {

// A plane's picture is coarsest in its middle, where a pixel's angle is its size on the plane at distance 1.
TEST(LayerSize, IsAsFineAsTheVideoInTheMiddle) {
    const render::View view{.verticalFov = 1.2f, .aspect = 16.0f / 9};
    const glm::ivec2 size = render::sizeAsFine(view, {1600, 900}, 512);
    const float videoRowsPerRadian = 512 / std::numbers::pi_v<float>;
    const float layerRowsPerRadian = static_cast<float>(size.y) / (2 * std::tan(0.6f));
    EXPECT_GE(layerRowsPerRadian, videoRowsPerRadian);
    EXPECT_LT(layerRowsPerRadian, 1.01f * videoRowsPerRadian); // rounded up to a whole pixel
    EXPECT_NEAR(static_cast<float>(size.x) / static_cast<float>(size.y), 16.0f / 9, 0.02f);
    // A video that is finer than the picture is drawn into as it is.
    EXPECT_EQ(render::sizeAsFine(view, {1600, 900}, 4096), glm::ivec2(1600, 900));
}

// Against points all over the sphere, projected one by one.
TEST(LayerBox, HoldsTheWholeSphereAndLittleMore) {
    render::View view{.verticalFov = 1.1f, .aspect = 1.5f};
    view.worldFromEye = glm::normalize(glm::quat(0.9f, 0.1f, 0.3f, -0.1f));
    view.eyeWorld = {0.3f, -0.2f, 0.1f};
    view.shift = {0.1f, -0.05f};
    for (const glm::vec3 inEye :
         {glm::vec3(0, 0, -2), glm::vec3(0.9f, 0.5f, -1.5f), glm::vec3(-1.4f, 0.2f, -1)}) {
        const glm::vec3 centre = view.eyeWorld + view.worldFromEye * inEye;
        const float radius = 0.4f;
        glm::vec2 low(1e9f), high(-1e9f);
        for (int i = 0; i < 20000; ++i) { // Fibonacci's sphere
            const float y = 1 - 2 * (static_cast<float>(i) + 0.5f) / 20000,
                        turn = 2.399963f * static_cast<float>(i);
            const float r = std::sqrt(1 - y * y);
            const glm::vec4 clip =
                view.clipFromWorld() *
                glm::vec4(centre + radius * glm::vec3(r * std::cos(turn), y, r * std::sin(turn)), 1);
            low = glm::min(low, glm::vec2(clip) / clip.w), high = glm::max(high, glm::vec2(clip) / clip.w);
        }
        const render::Box box = render::boxAround(centre, radius, view);
        for (int axis = 0; axis < 2; ++axis) { // the points are a hundredth of the sphere apart
            EXPECT_NEAR(box.low[axis], low[axis], 0.01f);
            EXPECT_NEAR(box.high[axis], high[axis], 0.01f);
        }
    }
    const render::Box around = render::boxAround(view.eyeWorld + glm::vec3(0.1f), 0.4f, view);
    EXPECT_EQ(around.low, glm::vec2(-1));
    EXPECT_EQ(around.high, glm::vec2(1));
}

class LayerGL : public WithContext {};

// An object over half of a texel lets half of the picture through; beside the boxes nothing changes.
TEST_F(LayerGL, LiesOverThePictureByItsAlpha) {
    auto layer = tests::valueOf(render::LayerPass::make());
    const gl::Target target(320, 192, 1);
    for (const int samples : {1, 4}) {
        layer.begin({160, 96}, samples);
        glClearColor(0.25f, 0.1f, 0, 0.5f);
        glClear(GL_COLOR_BUFFER_BIT);
        layer.end();
        fill(target, {0.2f, 0.4f, 0.8f, 1});
        // Seen from 0.25 to 0.75 of the way to the right edge.
        const render::View view{.verticalFov = 1.2f, .aspect = 320.0f / 192};
        const float half = view.halfExtent().x, low = std::atan(0.3f * half), high = std::atan(0.7f * half);
        const scene::Sphere right{5.0f *
                                      glm::vec3(std::sin((low + high) / 2), 0, -std::cos((low + high) / 2)),
                                  5.0f * std::sin((high - low) / 2)};
        layer.layOver({&right, 1}, view);
        const ImageRgba8 picture = target.read();
        const auto expect = [&](int x, glm::vec3 colour) {
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.at(x, 96)[c], 255 * colour[c], 1) << x;
        };
        expect(160 + 80, {0.25f + 0.1f, 0.1f + 0.2f, 0.4f});
        expect(80, {0.2f, 0.4f, 0.8f});
        expect(310, {0.2f, 0.4f, 0.8f});
    }
}

// Blocks of the layer's texels are blended into each other as the video's are. Empty cells are left
// out once its pixels have been read, which changes nothing.
TEST_F(LayerGL, ScalesUpSmoothly) {
    auto layer = tests::valueOf(render::LayerPass::make());
    const gl::Target target(400, 240, 1);
    for (const bool areRead : {false, true}) {
        layer.begin({100, 60}, 1);
        fill(50, 0, 50, 60, glm::vec4(1));
        layer.end();
        if (areRead) layer.pixels();
        fill(target, {0, 0, 0, 1});
        const scene::Sphere all{{0, 0, 0}, 1}; // around the eye
        layer.layOver({&all, 1}, {});
        const ImageRgba8 picture = target.read();
        // A ramp from the middle of texel 49 (pixel 198) to that of 50 (202), at the pixels' middles.
        for (int x = 190; x < 210; ++x)
            EXPECT_NEAR(picture.at(x, 100)[0],
                        255 * glm::clamp((static_cast<float>(x) + 0.5f - 198) / 4, 0.0f, 1.0f), 2)
                << x;
    }
}

} // namespace
} // namespace shoal
