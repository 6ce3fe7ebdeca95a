// A layer that looks filmed.
#include "Balls.h"
#include "engine/render/LayerPass.h"

#include <cmath>
#include <numbers>

namespace shoal {
namespace {

class LayerLookGL : public WithContext {};

camera::FilmLook blurredBy(float texels) {
    camera::FilmLook look;
    look.blur_texels = texels;
    return look;
}

// A layer of 64 texels' worth of picture, as coarse as the look asks; white right of its middle, over black.
ImageRgba8 edgeFilmed(const camera::FilmLook& look, glm::vec3 left, glm::vec3 right, int64_t frame = 0) {
    constexpr int kTexels = 64, kPicture = 512;
    auto layer = render::LayerPass::make();
    EXPECT_TRUE(layer) << layer.error().sentence();
    // A whole pixel must end in the middle.
    const int size = 2 * static_cast<int>(std::lround(kTexels / render::layerLook(look).texels / 2));
    layer->begin({size, size}, 1);
    glClearColor(left.x, left.y, left.z, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glScissor(size / 2, 0, size, size);
    glClearColor(right.x, right.y, right.z, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
    layer->end();
    const gl::Target target(kPicture, kPicture, 1);
    target.bind();
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    const render::Box all;
    const render::LayerPass::Filmed filmed{look, glm::vec2(kTexels), frame};
    EXPECT_TRUE(layer->layOver({&all, 1}, &filmed));
    return target.read();
}

// The edge's variance in texels^2: a box and a tent of the layer's own texels count as the video's.
TEST_F(LayerLookGL, EdgesAreAsSoftAsTheFilms) {
    for (const float blur : {0.3f, 0.5f, 0.8f, 1.2f, 2.0f}) {
        const ImageRgba8 picture = edgeFilmed(blurredBy(blur), glm::vec3(0), glm::vec3(1));
        double sum = 0, moment = 0, square = 0;
        for (int x = 0; x + 1 < picture.width; ++x) {
            const double rise = picture.at(x + 1, 256)[0] - picture.at(x, 256)[0], at = (x + 1 - 256) / 8.0;
            sum += rise, moment += rise * at, square += rise * at * at;
        }
        const double variance = square / sum - std::pow(moment / sum, 2);
        // In the mean over all places an edge would have blur^2 + 1/12 + 1/6. This one lies between two
        // pixels of the layer: a ramp from middle to middle, k^2 / 12, in place of a box and a tent, k^2 / 4.
        const double k = static_cast<double>(render::layerLook(blurredBy(blur)).texels);
        const double expected = blur * blur + 1.0 / 4 - k * k / 6;
        EXPECT_NEAR(variance, expected, 0.06 * expected + 0.03) << blur; // whole pixels of the layer
    }
}

TEST_F(LayerLookGL, GrainIsAsStrongAsTheFilmsAndItsFramesOwn) {
    camera::FilmLook look;
    look.fineNoise.fill(0);
    for (size_t band = 4; band < camera::kBrightnesses; ++band) look.fineNoise[band] = 6 / 255.0f;
    const ImageRgba8 one = edgeFilmed(look, glm::vec3(0.2f), glm::vec3(0.8f), 1);
    EXPECT_EQ(one.pixels, edgeFilmed(look, glm::vec3(0.2f), glm::vec3(0.8f), 1).pixels);
    EXPECT_NE(one.pixels, edgeFilmed(look, glm::vec3(0.2f), glm::vec3(0.8f), 2).pixels);
    const auto deviation = [&](int left) {
        double sum = 0, square = 0;
        int count = 0;
        for (int y = 0; y < 512; ++y)
            for (int x = left; x < left + 200; ++x, ++count) {
                sum += one.at(x, y)[1];
                square += one.at(x, y)[1] * one.at(x, y)[1];
            }
        return std::sqrt(square / count - std::pow(sum / count, 2));
    };
    EXPECT_LT(deviation(20), 0.5) << "dark: none";
    // A texel's noise, drawn straight between texels' middles, has two thirds of its deviation left: each way
    // the mean of t^2 + (1 - t)^2 is 2/3. A tenth more or less: 25 x 64 texels.
    EXPECT_NEAR(deviation(300), 6 * 2 / 3.0, 0.5);
}

TEST_F(LayerLookGL, LevelsAreTakenOnlyWhereBothEndsAreMissing) {
    camera::FilmLook look;
    look.black = glm::vec3(30 / 255.0f);
    EXPECT_EQ(edgeFilmed(look, glm::vec3(0), glm::vec3(1)).at(20, 20)[0], 0) << "the scene has nothing dark";
    look.white = glm::vec3(225 / 255.0f);
    const ImageRgba8 both = edgeFilmed(look, glm::vec3(0), glm::vec3(1));
    EXPECT_NEAR(both.at(20, 20)[0], 16, 1);
    EXPECT_NEAR(both.at(490, 20)[0], 235, 1);
}

// Red beside grey of the same luma: with 4:2:0 their border lies where squares of two texels end.
TEST_F(LayerLookGL, ColoursAreShared) {
    camera::FilmLook look;
    look.chromaTexels = {2, 2};
    const ImageRgba8 picture = edgeFilmed(look, glm::vec3(0.4f), glm::vec3(0.8f, 0.3f, 0.2f));
    for (int x = 0; x < 512; x += 16) // within a square of 16 pixels: one hue
        for (int i = 1; i < 16; ++i) {
            const auto hue = [&](int at) { return picture.at(at, 100)[0] - picture.at(at, 100)[2]; };
            EXPECT_NEAR(hue(x + i), hue(x), 2) << x + i;
        }
}

TEST(LayerLook, IsFineForSharpFilmsAndCoarseForSoftOnes) {
    EXPECT_EQ(render::layerLook(blurredBy(0)).texels, 1);
    EXPECT_EQ(render::layerLook(blurredBy(0)).tap, 0);
    for (const float blur : {0.1f, 0.5f, 0.9f, 3.0f}) { // blur^2 = (k^2 - 1) / 4 + d^2 k^2
        const render::LayerLook look = render::layerLook(blurredBy(blur));
        EXPECT_GE(look.texels, 1);
        EXPECT_LE(look.tap, 0.5f);
        const float k2 = look.texels * look.texels;
        EXPECT_NEAR((k2 - 1) / 4 + look.tap * look.tap * k2, blur * blur, 1e-4f);
    }
}

} // namespace
} // namespace shoal
