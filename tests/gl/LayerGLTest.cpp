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

class LayerGL : public WithContext {};

// An object over half of a texel lets half of the picture through.
TEST_F(LayerGL, LiesOverThePictureByItsAlpha) {
    auto layer = tests::valueOf(render::LayerPass::make());
    const gl::Target target(320, 192, 1);
    for (const int samples : {1, 4}) {
        layer.begin({160, 96}, samples);
        fill(80, 0, 80, 96, {0.25f, 0.1f, 0, 0.5f});
        layer.end();
        fill(target, {0.2f, 0.4f, 0.8f, 1});
        layer.layOver();
        const ImageRgba8 picture = target.read();
        const glm::vec3 under(0.35f, 0.3f, 0.4f), beside(0.2f, 0.4f, 0.8f);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(picture.at(160 + 80, 96)[c], 255 * under[c], 1);
            EXPECT_NEAR(picture.at(80, 96)[c], 255 * beside[c], 1);
        }
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
        layer.layOver();
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
