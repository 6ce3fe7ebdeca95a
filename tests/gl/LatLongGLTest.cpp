// Objects that lie in the video's own texels.
#include "Balls.h"
#include "engine/render/BackdropPass.h"
#include "engine/render/LatLongPass.h"
#include "engine/render/LayerPass.h"

#include <cmath>
#include <numbers>

namespace shoal {
namespace {

// Colours that change smoothly over the sphere, blue first.
ImageRgba8 smoothFrame(int width) {
    ImageRgba8 frame(width, width / 2);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 d = directionFromLatLong((glm::vec2(x, y) + 0.5f) / glm::vec2(width, width / 2));
            for (int c = 0; c < 3; ++c) frame.at(x, y)[c] = static_cast<uint8_t>(120 + 100 * d[c]);
            frame.at(x, y)[3] = 255;
        }
    return frame;
}

ImageRgba8 readFrame(const render::SurroundGpu& surround) {
    ImageRgba8 frame(surround.frameWidth(), surround.frameHeight());
    glBindTexture(GL_TEXTURE_2D, surround.frameTexture());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_BGRA, GL_UNSIGNED_BYTE, frame.pixels.data());
    return frame;
}

render::View viewTowards(const glm::vec3& direction) {
    render::View view{.verticalFov = 1.0f, .aspect = 1};
    const glm::vec3 up = std::abs(direction.y) > 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    view.worldFromEye = glm::quatLookAt(direction, up);
    return view;
}

class LatLongGL : public WithContext {
  protected:
    void SetUp() override {
        WithContext::SetUp();
        if (IsSkipped()) return;
        frame_ = smoothFrame(1024);
        surround_.emplace();
        surround_->uploadFrame({frame_.pixels.data(), frame_.width, frame_.height, frame_.width});
        auto made = render::LatLongPass::make();
        ASSERT_TRUE(made) << made.error().sentence();
        pass_ = std::move(*made);
    }

    // A red ball of this angle stands in a direction: a disc of the layer, drawn by hand.
    void paint(const glm::vec3& direction, float halfAngle, const glm::vec3& eyeWorld = glm::vec3(0)) {
        constexpr int kSize = 400;
        render::View view = viewTowards(direction);
        view.eyeWorld = eyeWorld;
        layer_ = gl::Target(kSize, kSize, 1);
        layer_.bind();
        glClearColor(0, 0, 0, 0);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glEnable(GL_SCISSOR_TEST); // row by row
        glClearColor(1, 0, 0, 1);
        const float radius = std::tan(halfAngle) / std::tan(view.verticalFov / 2) * kSize / 2;
        for (int y = 0; y < kSize; ++y) {
            const float dy = static_cast<float>(y) + 0.5f - kSize / 2;
            if (std::abs(dy) > radius) continue;
            const int half = static_cast<int>(std::sqrt(radius * radius - dy * dy) + 0.5f);
            glScissor(kSize / 2 - half, y, 2 * half, 1);
            glClear(GL_COLOR_BUFFER_BIT);
        }
        glDisable(GL_SCISSOR_TEST);
        const render::Ball ball{eyeWorld + 2.0f * direction, 2 * std::sin(halfAngle)};
        pass_->choose(*surround_, glm::mat3(1), {&ball, 1}, eyeWorld);
        ASSERT_TRUE(pass_->paint(*surround_, layer_.texture(), view, glm::mat3(1)));
    }

    ImageRgba8 frame_;
    gl::Target layer_;
    std::optional<render::SurroundGpu> surround_;
    std::optional<render::LatLongPass> pass_;
};

class LatLongPlaces : public LatLongGL, public testing::WithParamInterface<glm::vec3> {};

// Ahead, on the seam, beside it, at both poles, beside a pole, between tiles: every texel whose direction
// lies in the ball is red, every other as it was. A band of two texels at the outline may be either.
TEST_P(LatLongPlaces, HoldTheBallAndNothingElse) {
    const glm::vec3 direction = glm::normalize(GetParam());
    constexpr float kHalf = 0.2f;
    paint(direction, kHalf);
    const ImageRgba8 painted = readFrame(*surround_);
    const float texel = std::numbers::pi_v<float> / static_cast<float>(frame_.height);
    int red = 0, wrong = 0;
    for (int y = 0; y < frame_.height; ++y)
        for (int x = 0; x < frame_.width; ++x) {
            const glm::vec3 d =
                directionFromLatLong((glm::vec2(x, y) + 0.5f) / glm::vec2(frame_.width, frame_.height));
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
    pass_->restore(*surround_);
    EXPECT_EQ(readFrame(*surround_).pixels, frame_.pixels) << "the frame gets back what it held";
}
INSTANTIATE_TEST_SUITE_P(Places, LatLongPlaces,
                         testing::Values(glm::vec3(0, 0, -1), glm::vec3(0, 0, 1), glm::vec3(0.1f, 0.3f, 1),
                                         glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(0.15f, 1, 0.1f),
                                         glm::vec3(-1, -2.2f, 0.01f), glm::vec3(1, 0.7f, -0.6f)));

// A new frame of the video needs no mending; the old texels must not come back into it.
TEST_F(LatLongGL, ANewFrameIsLeftAsItCame) {
    paint({0, 0, -1}, 0.2f);
    ImageRgba8 next = frame_;
    for (uint8_t& value : next.pixels) value = static_cast<uint8_t>(value / 2);
    surround_->uploadFrame({next.pixels.data(), next.width, next.height, next.width});
    pass_->restore(*surround_);
    EXPECT_EQ(readFrame(*surround_).pixels, next.pixels);
}

// Two eyes that share a frame: the second's picture holds nothing of the first's.
TEST_F(LatLongGL, OneEyesObjectsMakeWayForTheOthers) {
    paint({0, 0, -1}, 0.2f);
    const ImageRgba8 left = readFrame(*surround_);
    paint(glm::normalize(glm::vec3(0.3f, 0, -1)), 0.2f, {0.06f, 0, 0});
    const ImageRgba8 both = readFrame(*surround_);
    pass_->restore(*surround_);
    paint(glm::normalize(glm::vec3(0.3f, 0, -1)), 0.2f, {0.06f, 0, 0});
    EXPECT_EQ(both.pixels, readFrame(*surround_).pixels);
    EXPECT_NE(both.pixels, left.pixels);
}

// What the layer shows, the backdrop shows in the same place: half a texel's worth of light along the
// outline.
TEST_F(LatLongGL, TheBackdropShowsItWhereTheLayerHadIt) {
    auto backdrop = render::BackdropPass::make();
    ASSERT_TRUE(backdrop) << backdrop.error().sentence();
    const glm::vec3 direction = glm::normalize(glm::vec3(0.4f, 0.8f, 0.2f));
    paint(direction, 0.2f);
    const gl::Target target(400, 400, 1);
    target.bind();
    ASSERT_TRUE(backdrop->draw(*surround_, viewTowards(direction), glm::mat3(1), {}));
    const ImageRgba8 shown = target.read(), layer = layer_.read();
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

// What is painted is in the texture alone: a backdrop that is sampled on the processor shows it all the same.
// One step of rounding apart from what the graphics side draws of it all.
TEST_F(LatLongGL, WhatIsPaintedIsShownWhateverIsSampledBesideIt) {
    auto backdrop = render::BackdropPass::make();
    ASSERT_TRUE(backdrop) << backdrop.error().sentence();
    const glm::vec3 direction = glm::normalize(glm::vec3(0.4f, 0.2f, -0.7f));
    paint(direction, 0.2f);
    const gl::Target target(640, 640, 1);
    render::View view = viewTowards(direction);
    target.bind();
    ASSERT_TRUE(backdrop->draw(*surround_, view, glm::mat3(1), {}));
    const ImageRgba8 drawn = target.read();
    const render::BackdropPass::InMemory inMemory{
        {frame_.pixels.data(), frame_.width, frame_.height, frame_.width}, &*pass_};
    ASSERT_TRUE(backdrop->draw(*surround_, view, glm::mat3(1), {}, &inMemory));
    const ImageRgba8 sampled = target.read();
    int most = 0;
    for (size_t k = 0; k < drawn.pixels.size(); ++k)
        most = std::max(most, std::abs(drawn.pixels[k] - sampled.pixels[k]));
    EXPECT_LE(most, 1);
}

} // namespace
} // namespace shoal
