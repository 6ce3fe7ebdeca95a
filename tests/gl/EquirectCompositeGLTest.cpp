// Objects that are composited into the video's own texels.
#include "Spheres.h"
#include "engine/render/BackgroundPass.h"
#include "engine/render/EquirectComposite.h"
#include "engine/render/LayerPass.h"
#include "engine/render/software/FrameSampler.h"

namespace shoal {
namespace {

// Colours that change smoothly over the sphere, blue first.
ImageRgba8 smoothFrame(int width) {
    ImageRgba8 frame(width, width / 2);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 d = texelDirection(x, y, width, frame.height);
            for (int c = 0; c < 3; ++c) frame.at(x, y)[c] = static_cast<uint8_t>(120 + 100 * d[c]);
            frame.at(x, y)[3] = 255;
        }
    return frame;
}

ImageRgba8 readTexture(GLuint texture, const ImageRgba8& size) {
    ImageRgba8 frame(size.width, size.height);
    glBindTexture(GL_TEXTURE_2D, texture);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_BGRA, GL_UNSIGNED_BYTE, frame.pixels.data());
    return frame;
}

render::View viewTowards(const glm::vec3& direction) {
    return {.worldFromEye = looking(direction), .verticalFov = 1, .aspect = 1};
}

class LatLongGL : public WithContext {
  protected:
    void setUpInContext() override {
        frame_ = smoothFrame(1024);
        environment_.emplace();
        environment_->setFrame({frame_.pixels.data(), frame_.width, frame_.height, frame_.width});
        pass_ = tests::valueOf(render::EquirectComposite::make());
        layer_ = tests::valueOf(render::LayerPass::make());
    }

    // A red sphere of this angle stands in a direction: a disc of the layer, drawn by hand.
    void paint(const glm::vec3& direction, float halfAngle, const glm::vec3& eyeWorld = glm::vec3(0)) {
        constexpr int kSize = 400;
        render::View view = viewTowards(direction);
        view.eyeWorld = eyeWorld;
        layer_->begin({kSize, kSize}, 1);
        const float radius = std::tan(halfAngle) / std::tan(view.verticalFov / 2) * kSize / 2;
        for (int y = 0; y < kSize; ++y) {
            const float dy = static_cast<float>(y) + 0.5f - kSize / 2;
            if (std::abs(dy) > radius) continue;
            const int half = static_cast<int>(std::sqrt(radius * radius - dy * dy) + 0.5f);
            fill(kSize / 2 - half, y, 2 * half, 1, {1, 0, 0, 1});
        }
        const Sphere sphere{eyeWorld + 2.0f * direction, 2 * std::sin(halfAngle)};
        tiles_.choose({frame_.width, frame_.height}, glm::mat3(1), {&sphere, 1}, eyeWorld);
        const std::vector<bool> everywhere(tiles_.chosen().size(), true);
        pass_->paint(*environment_, tiles_, everywhere, layer_->layer().texture(), view, glm::mat3(1));
    }
    ImageRgba8 painted() const { return readTexture(pass_->texture(), frame_); }
    ImageRgba8 environments() const { return readTexture(environment_->frameTexture(), frame_); }

    // Picture of a background with the layer that was painted last in its texels.
    ImageRgba8 shown(render::BackgroundPass& background, const glm::vec3& direction,
                     const gl::Target& target) {
        const render::View view = viewTowards(direction);
        const render::ObjectLayer layer{*layer_, view, &tiles_};
        target.bindColour();
        EXPECT_TRUE(background.draw({.environment = *environment_, .view = view, .canvas = target}, &layer));
        return target.read();
    }

    ImageRgba8 frame_;
    std::optional<render::LayerPass> layer_;
    std::optional<render::EnvironmentGpu> environment_;
    std::optional<render::EquirectComposite> pass_;
    render::FrameTiles tiles_;
};

class LatLongPlaces : public LatLongGL, public testing::WithParamInterface<glm::vec3> {};

// Ahead, on the seam, beside it, at both poles, beside a pole, between tiles: every texel whose direction
// lies in the sphere is red, every other as it was. A band of two texels at the outline may be either.
TEST_P(LatLongPlaces, HoldTheSphereAndNothingElse) {
    const glm::vec3 direction = glm::normalize(GetParam());
    constexpr float kHalf = 0.2f;
    paint(direction, kHalf);
    const ImageRgba8 painted = this->painted();
    const float texel = std::numbers::pi_v<float> / static_cast<float>(frame_.height);
    int red = 0, wrong = 0;
    for (int y = 0; y < frame_.height; ++y)
        for (int x = 0; x < frame_.width; ++x) {
            const glm::vec3 d = texelDirection(x, y, frame_.width, frame_.height);
            const float away = std::acos(std::clamp(glm::dot(d, direction), -1.0f, 1.0f));
            if (std::abs(away - kHalf) < 2 * texel) continue;
            const uint8_t* is = painted.at(x, y);
            const uint8_t* was = frame_.at(x, y);
            const bool isRed = is[0] == 0 && is[1] == 0 && is[2] == 255;
            red += isRed;
            wrong += away < kHalf ? !isRed : !std::equal(is, is + 3, was);
        }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(red, 2000);
    EXPECT_EQ(environments().pixels, frame_.pixels) << "the environment's own frame stays";
}
INSTANTIATE_TEST_SUITE_P(Places, LatLongPlaces,
                         testing::Values(glm::vec3(0, 0, -1), glm::vec3(0, 0, 1), glm::vec3(0.1f, 0.3f, 1),
                                         glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(0.15f, 1, 0.1f),
                                         glm::vec3(-1, -2.2f, 0.01f), glm::vec3(1, 0.7f, -0.6f)));

TEST_F(LatLongGL, ANewFrameIsShownAsItCame) {
    paint({0, 0, -1}, 0.2f);
    ImageRgba8 next = frame_;
    for (uint8_t& value : next.pixels) value = static_cast<uint8_t>(value / 2);
    environment_->setFrame({next.pixels.data(), next.width, next.height, next.width});
    EXPECT_EQ(environments().pixels, next.pixels);
    paint({0, 1, 0}, 0.1f);
    const ImageRgba8 after = painted();
    for (int y = frame_.height / 2; y < frame_.height; ++y) // below the object
        for (int x = 0; x < frame_.width; ++x)
            ASSERT_TRUE(std::equal(after.at(x, y), after.at(x, y) + 3, next.at(x, y))) << x << " " << y;
}

TEST_F(LatLongGL, OneEyesObjectsMakeWayForTheOthers) {
    paint({0, 0, -1}, 0.2f);
    const ImageRgba8 left = painted();
    paint(glm::normalize(glm::vec3(0.3f, 0, -1)), 0.2f, {0.06f, 0, 0});
    const ImageRgba8 both = painted();
    pass_ = tests::valueOf(render::EquirectComposite::make());
    paint(glm::normalize(glm::vec3(0.3f, 0, -1)), 0.2f, {0.06f, 0, 0});
    EXPECT_EQ(both.pixels, painted().pixels);
    EXPECT_NE(both.pixels, left.pixels);
}

// The background shows the layer in its place: half a texel's worth of light along the outline.
TEST_F(LatLongGL, TheBackgroundShowsItWhereTheLayerHadIt) {
    auto background = tests::valueOf(render::BackgroundPass::make(render::Backend::OpenGL, true));
    const glm::vec3 direction = glm::normalize(glm::vec3(0.4f, 0.8f, 0.2f));
    paint(direction, 0.2f);
    const gl::Target target(400, 400, 1);
    const ImageRgba8 shown = this->shown(*background, direction, target), layer = layer_->layer().read();
    double difference = 0, covered = 0;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 400; ++x) {
            const bool red = layer.at(x, y)[3] == 255;
            covered += red;
            const double share = std::clamp((255.0 - shown.at(x, y)[1]) / 255, 0.0, 1.0);
            if (red) difference += 1 - share;
        }
    // The outline is 2 pi r pixels long; a pixel is 0.45 of a texel there.
    const double outline = 2 * std::numbers::pi * std::sqrt(covered / std::numbers::pi);
    EXPECT_LT(difference, 0.6 * outline);
}

// Both backends show one picture, whether the processor begins before the layer is drawn or after.
TEST_P(LatLongPlaces, AreShownFromMemoryAsTheyAreFromTheTexture) {
    if (!render::canSampleFrames()) GTEST_SKIP() << "this processor has no AVX2";
    auto openGL = render::BackgroundPass::make(render::Backend::OpenGL, true),
         software = render::BackgroundPass::make(render::Backend::Software, true);
    ASSERT_TRUE(openGL && software);
    const gl::Target target(640, 640, 1);
    const glm::vec3 direction = glm::normalize(GetParam());
    paint(direction, 0.2f);
    const ImageRgba8 drawn = shown(**openGL, direction, target);
    for (const bool ahead : {false, true}) {
        if (ahead)
            (*software)->prepare(
                {.environment = *environment_, .view = viewTowards(direction), .canvas = target}, &tiles_);
        const ImageRgba8 sampled = shown(**software, direction, target);
        // If rays are linear, in triangles there and in rectangles here, they are up to a fourteenth of a
        // texel apart: beside a pole. The layer's outline falls by 255 within 0.45 of one.
        int maximum = 0, many = 0;
        for (size_t k = 0; k < drawn.pixels.size(); ++k) {
            const int difference = std::abs(drawn.pixels[k] - sampled.pixels[k]);
            maximum = std::max(maximum, difference);
            many += difference > 2;
        }
        EXPECT_LE(maximum, 255 / 0.45 / 14);
        EXPECT_LT(many, 3 * 4 * 748) << "channels of the outline's 748 pixels, four wide";
    }
    EXPECT_EQ(environments().pixels, frame_.pixels);
}

// A second eye's picture of the same video keeps what the first's holds, but for the objects.
TEST_F(LatLongGL, NothingOfOneEyesObjectsStaysInTheOthersPicture) {
    if (!render::canSampleFrames()) GTEST_SKIP() << "this processor has no AVX2";
    const gl::Target target(640, 640, 1);
    const auto make = [] {
        return std::move(*render::BackgroundPass::make(render::Backend::Software, true));
    };
    // The picture towards -Z, with a sphere elsewhere in it; or where one may be, with nothing.
    const auto with = [&](const glm::vec3& to, render::BackgroundPass& background, float alpha = 1) {
        constexpr float kHalfAngle = 0.15f;
        layer_->begin({4, 4}, 1);
        glClearColor(alpha, 0, 0, alpha);
        glClear(GL_COLOR_BUFFER_BIT);
        const Sphere sphere{2.0f * glm::normalize(to), 2 * std::sin(kHalfAngle)};
        tiles_.choose({frame_.width, frame_.height}, glm::mat3(1), {&sphere, 1}, glm::vec3(0));
        return shown(background, {0, 0, -1}, target);
    };
    const auto background = make(), fresh = make(), fresher = make();
    const ImageRgba8 left = with({-0.2f, 0, -1}, *background);
    const ImageRgba8 right = with({0.2f, 0.1f, -1}, *background);
    EXPECT_NE(left.pixels, right.pixels);
    EXPECT_EQ(right.pixels, with({0.2f, 0.1f, -1}, *fresh).pixels);
    const ImageRgba8 none = with({0.2f, 0.1f, -1}, *background, 0);
    EXPECT_EQ(none.pixels, with({-0.2f, 0, -1}, *fresher, 0).pixels);
    EXPECT_NE(none.pixels, right.pixels);
    EXPECT_EQ(right.pixels, with({0.2f, 0.1f, -1}, *background).pixels) << "comes back";
    for (uint8_t& value : frame_.pixels) value = static_cast<uint8_t>(value / 2 + 100); // a new frame
    environment_->setFrame({frame_.pixels.data(), frame_.width, frame_.height, frame_.width});
    EXPECT_EQ(with({0.2f, 0.1f, -1}, *background).pixels, with({0.2f, 0.1f, -1}, *fresher).pixels);
}

} // namespace
} // namespace shoal
