// Objects in the video's texels as its own camera would have filmed them.
#include "Spheres.h"
#include "engine/render/EquirectComposite.h"
#include "engine/render/software/FrameSampler.h"
#include "engine/render/software/PaintTexels.h"

namespace shoal {
namespace {

constexpr int kWidth = 512, kHeight = kWidth / 2;

// The middle 128 x 64 texels of a frame of one grey, before which two halves stand: left and right,
// premultiplied. scattered: the light about them all.
ImageRgba8 paintedBy(bool processor, const camera::CameraResponse& look, const glm::vec4& left,
                     const glm::vec4& right, float behind = 0, float scattered = 0, int64_t index = 0) {
    ImageRgba8 frame(kWidth, kHeight);
    std::ranges::fill(frame.pixels, static_cast<uint8_t>(255 * behind + 0.5f));
    render::EnvironmentGpu environment;
    environment.setFrame({frame.pixels.data(), kWidth, kHeight, kWidth});
    ImageRgbF around(8, 4);
    std::ranges::fill(around.pixels, scattered);
    environment.uploadScattered(around);

    constexpr int kSize = 512;
    const gl::Target layer(kSize, kSize, 1);
    layer.bind();
    fill(0, 0, kSize / 2, kSize, left);
    fill(kSize / 2, 0, kSize / 2, kSize, right);
    render::View view{.verticalFov = 2.0f, .aspect = 1};
    const Sphere sphere{{0, 0, -2}, 1.4f};
    auto pass = tests::valueOf(render::EquirectComposite::make());
    const render::FilmedFrame filmed{look, index};
    render::FrameTiles tiles;
    tiles.choose({kWidth, kHeight}, glm::mat3(1), {&sphere, 1}, glm::vec3(0));
    ImageRgba8 all(kWidth, kHeight), middle(128, 64);
    if (processor) {
        std::vector<uint32_t> pixels(size_t{kSize} * kSize);
        layer.bind();
        glReadPixels(0, 0, kSize, kSize, GL_BGRA, GL_UNSIGNED_BYTE, pixels.data());
        const render::TexelPaint paint{.layer = pixels.data(),
                                       .layerSize = {kSize, kSize},
                                       .rayScale = view.halfExtent(),
                                       .filmed = render::cameraUniforms(filmed),
                                       .scattered = &environment.scatteredLight()};
        all = frame;
        for (int k = 0; k < render::FrameTiles::kCount.x * render::FrameTiles::kCount.y; ++k) {
            const glm::ivec2 tile(k % render::FrameTiles::kCount.x, k / render::FrameTiles::kCount.x);
            if (tiles.chosen()[static_cast<size_t>(k)])
                render::paintTexels(paint, tiles.lowOf(tile), tiles.lowOf(tile + 1), {kWidth, kHeight},
                                    reinterpret_cast<uint32_t*>(all.pixels.data()));
        }
        for (size_t k = 0; k < all.pixels.size(); k += 4) std::swap(all.pixels[k], all.pixels[k + 2]);
    } else {
        const std::vector<bool> everywhere(tiles.chosen().size(), true);
        pass.paint(environment, tiles, everywhere, layer.texture(), view, glm::mat3(1), &filmed);
        glBindTexture(GL_TEXTURE_2D, pass.texture());
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, all.pixels.data());
    }
    for (int y = 0; y < middle.height; ++y)
        std::copy_n(all.at((kWidth - middle.width) / 2, (kHeight - middle.height) / 2 + y), 4 * middle.width,
                    middle.at(0, y));
    return middle;
}

// Tests that run by OpenGL and, on processors that can, in software.
class CameraCompositeGL : public WithContext, public testing::WithParamInterface<bool> {
  protected:
    void setUpInContext() override {
        if (GetParam() && !render::canSampleFrames()) GTEST_SKIP() << "this processor has no AVX2";
    }
    ImageRgba8 painted(const camera::CameraResponse& look, const glm::vec4& left, const glm::vec4& right,
                       float behind = 0, float scattered = 0, int64_t index = 0) const {
        return paintedBy(GetParam(), look, left, right, behind, scattered, index);
    }
};
INSTANTIATE_TEST_SUITE_P(By, CameraCompositeGL, testing::Bool(),
                         [](const auto& spec) { return spec.param ? "Processor" : "Graphics"; });

TEST_P(CameraCompositeGL, EdgesMixLight) {
    const ImageRgba8 picture =
        painted({}, glm::vec4(0, 0, 0, 0.5f), glm::vec4(0.25f, 0.25f, 0.25f, 0.5f), 0.8f);
    // Half of black's, of a half's, and of 0.8's square.
    EXPECT_NEAR(picture.at(20, 30)[0], 255 * std::sqrt(0.5 * 0.64), 1.5);
    EXPECT_NEAR(picture.at(100, 30)[0], 255 * std::sqrt(0.5 * 0.64 + 0.5 * 0.25), 1.5);
}

TEST_P(CameraCompositeGL, NothingIsChangedWhereNothingStands) {
    camera::CameraResponse look{.glare = 0.1f, .chromaTexels = {2, 2}};
    look.fineNoise.fill(0.02f);
    EXPECT_EQ(painted(look, glm::vec4(0), glm::vec4(1), 0.4f, 0.9f).at(20, 30)[0], 102);
}

TEST_P(CameraCompositeGL, PortAndLensScatterTheLightAround) {
    const ImageRgba8 picture =
        painted({.glare = 0.06f}, glm::vec4(0, 0, 0, 1), glm::vec4(0.5f, 0.5f, 0.5f, 1), 0, 0.6f);
    EXPECT_NEAR(picture.at(20, 30)[1], 255 * std::sqrt(0.06 * 0.6), 1.5);
    EXPECT_NEAR(picture.at(100, 30)[1], 255 * std::sqrt(0.94 * 0.25 + 0.06 * 0.6), 1.5);
}

TEST_P(CameraCompositeGL, GrainIsAsStrongAsTheFilmsAndItsFramesOwn) {
    camera::CameraResponse look;
    for (size_t band = 4; band < camera::kBrightnesses; ++band) look.fineNoise[band] = 6 / 255.0f;
    const auto shot = [&](int64_t index) {
        return painted(look, glm::vec4(0.2f, 0.2f, 0.2f, 1), glm::vec4(0.8f, 0.8f, 0.8f, 1), 0, 0, index);
    };
    const ImageRgba8 one = shot(1);
    EXPECT_EQ(one.pixels, shot(1).pixels);
    EXPECT_NE(one.pixels, shot(2).pixels);
    const auto deviation = [&](int left) {
        double sum = 0, square = 0;
        int count = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = left; x < left + 56; ++x, ++count) {
                sum += one.at(x, y)[1];
                square += one.at(x, y)[1] * one.at(x, y)[1];
            }
        return std::sqrt(square / count - std::pow(sum / count, 2));
    };
    EXPECT_LT(deviation(4), 0.5) << "dark: none";
    EXPECT_NEAR(deviation(68), 6, 0.4); // 3584 texels: 1.2 %, and the grain's own steps
}

TEST_P(CameraCompositeGL, LevelsAreTakenOnlyWhereBothEndsAreMissing) {
    camera::CameraResponse look{.black = glm::vec3(30 / 255.0f)};
    const glm::vec4 black(0, 0, 0, 1), white(1);
    EXPECT_EQ(painted(look, black, white).at(20, 20)[0], 0) << "the scene has nothing dark";
    look.white = glm::vec3(225 / 255.0f);
    const ImageRgba8 both = painted(look, black, white);
    EXPECT_NEAR(both.at(20, 20)[0], 16, 1);
    EXPECT_NEAR(both.at(100, 20)[0], 235, 1);
}

// Red beside grey: with 4:2:0 squares of two texels have one hue.
TEST_P(CameraCompositeGL, ColoursAreShared) {
    const camera::CameraResponse look{.chromaTexels = {2, 2}};
    const ImageRgba8 picture = painted(look, glm::vec4(0.4f, 0.4f, 0.4f, 1), glm::vec4(0.8f, 0.3f, 0.2f, 1));
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; x += 2) {
            const auto hue = [&](int at) { return picture.at(at, y)[0] - picture.at(at, y)[2]; };
            EXPECT_NEAR(hue(x + 1), hue(x), 2);
        }
}

// With all effects of a camera at once, both ways give the same picture up to the rounding of bytes.
TEST_P(CameraCompositeGL, IsTheSameByEitherWay) {
    camera::CameraResponse look{.black = glm::vec3(14, 15, 16) / 255.0f,
                                .white = glm::vec3(240 / 255.0f),
                                .glare = 0.05f,
                                .chromaTexels = {2, 2}};
    for (size_t band = 0; band < camera::kBrightnesses; ++band)
        look.fineNoise[band] = 0.002f * static_cast<float>(band), look.coarseNoise[band] = 0.01f;
    const auto by = [&](bool processor) {
        return paintedBy(processor, look, glm::vec4(0.4f, 0.1f, 0.05f, 0.7f), glm::vec4(0.2f, 0.5f, 0.8f, 1),
                         0.3f, 0.5f, 7);
    };
    const ImageRgba8 graphics = by(false), processor = by(true);
    int maximum = 0;
    for (size_t k = 0; k < graphics.pixels.size(); ++k)
        maximum = std::max(maximum, std::abs(graphics.pixels[k] - processor.pixels[k]));
    EXPECT_LE(maximum, 2);
}

TEST(CameraComposite, LayersAreAsCoarseAsTheFilmIsSoft) {
    EXPECT_EQ(render::layerTexels({}, 1), 1) << "never finer than the video";
    for (const float blur : {0.1f, 0.5f, 0.9f, 3.0f}) { // a tent, and with samples a box, of so many texels
        const float several = render::layerTexels({.blur_texels = blur}, 4),
                    one = render::layerTexels({.blur_texels = blur}, 1);
        EXPECT_NEAR(several * several / 4, blur * blur + 1 / 12.0f, 0.01f);
        if (one > 1) {
            EXPECT_NEAR(one * one / 6, blur * blur + 1 / 12.0f, 1e-4f);
        }
    }
}

} // namespace
} // namespace shoal
