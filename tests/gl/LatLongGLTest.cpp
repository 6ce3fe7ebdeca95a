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
        surround_->setFrame({frame_.pixels.data(), frame_.width, frame_.height, frame_.width});
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
        tiles_.choose({frame_.width, frame_.height}, glm::mat3(1), {&ball, 1}, eyeWorld);
        ASSERT_TRUE(pass_->paint(*surround_, tiles_, layer_.texture(), view, glm::mat3(1)));
    }

    ImageRgba8 frame_;
    gl::Target layer_;
    std::optional<render::SurroundGpu> surround_;
    std::optional<render::LatLongPass> pass_;
    render::FrameTiles tiles_;
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
    surround_->setFrame({next.pixels.data(), next.width, next.height, next.width});
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

// Where the processor draws, it paints what it samples, and the texture has none of it.
TEST_P(LatLongPlaces, AreShownFromMemoryAsTheyAreFromTheTexture) {
    auto backdrop = render::BackdropPass::make();
    ASSERT_TRUE(backdrop) << backdrop.error().sentence();
    const gl::Target target(640, 640, 1);
    target.bind();
    if (!backdrop->canDrawFromMemory(*surround_, {})) GTEST_SKIP() << "a graphics card draws";
    const glm::vec3 direction = glm::normalize(GetParam());
    const render::View view = viewTowards(direction);
    paint(direction, 0.2f);
    target.bind();
    ASSERT_TRUE(backdrop->draw(*surround_, view, glm::mat3(1), {}));
    const ImageRgba8 drawn = target.read();
    pass_->restore(*surround_);

    std::vector<uint32_t> layer(400 * 400);
    layer_.bind();
    glReadPixels(0, 0, 400, 400, GL_BGRA, GL_UNSIGNED_BYTE, layer.data());
    const render::BackdropPass::InMemory inMemory{
        {frame_.pixels.data(), frame_.width, frame_.height, frame_.width}, &tiles_};
    const render::TexelPaint paint{.layer = layer.data(),
                                   .layerSize = {400, 400},
                                   .eyeFromEnv = glm::transpose(glm::mat3_cast(view.worldFromEye)),
                                   .rayScale = view.halfExtent(),
                                   .rayShift = view.shift};
    for (const bool ahead : {false, true}) {
        target.bind();
        if (ahead) backdrop->begin(*surround_, view, glm::mat3(1), {}, {640, 640}, inMemory);
        ASSERT_TRUE(backdrop->drawFromMemory(*surround_, view, glm::mat3(1), inMemory, &paint));
        const ImageRgba8 sampled = target.read();
        // Where rays are linear, in triangles there and in rectangles here, they are up to a fourteenth of a
        // texel apart: beside a pole. The layer's outline falls by 255 within 0.45 of one.
        int most = 0, many = 0;
        for (size_t k = 0; k < drawn.pixels.size(); ++k) {
            const int difference = std::abs(drawn.pixels[k] - sampled.pixels[k]);
            most = std::max(most, difference);
            many += difference > 2;
        }
        EXPECT_LE(most, 255 / 0.45 / 14);
        EXPECT_LT(many, 3 * 4 * 748) << "channels of the outline's 748 pixels, four wide";
    }
    EXPECT_EQ(readFrame(*surround_).pixels, frame_.pixels);
}

// A second eye's picture of the same video keeps what the first's holds, but for the objects.
TEST_F(LatLongGL, NothingOfOneEyesObjectsStaysInTheOthersPicture) {
    auto backdrop = render::BackdropPass::make();
    ASSERT_TRUE(backdrop) << backdrop.error().sentence();
    const gl::Target target(640, 640, 1);
    target.bind();
    if (!backdrop->canDrawFromMemory(*surround_, {})) GTEST_SKIP() << "a graphics card draws";
    const render::View view = viewTowards({0, 0, -1});
    const std::vector<uint32_t> red(4 * 4, 0xffff0000u);
    const render::TexelPaint paint{.layer = red.data(),
                                   .layerSize = {4, 4},
                                   .eyeFromEnv = glm::transpose(glm::mat3_cast(view.worldFromEye)),
                                   .rayScale = view.halfExtent()};
    const auto shown = [&](const glm::vec3& ball, render::BackdropPass& by) {
        const render::Ball bound{ball, 0.2f};
        tiles_.choose({frame_.width, frame_.height}, glm::mat3(1), {&bound, 1}, glm::vec3(0));
        target.bind();
        EXPECT_TRUE(by.drawFromMemory(
            *surround_, view, glm::mat3(1),
            {{frame_.pixels.data(), frame_.width, frame_.height, frame_.width}, &tiles_}, &paint));
        return target.read();
    };
    auto fresh = render::BackdropPass::make();
    ASSERT_TRUE(fresh);
    const ImageRgba8 left = shown({-0.2f, 0, -1}, *backdrop);
    const ImageRgba8 right = shown({0.2f, 0.1f, -1}, *backdrop);
    EXPECT_NE(left.pixels, right.pixels);
    EXPECT_EQ(right.pixels, shown({0.2f, 0.1f, -1}, *fresh).pixels);
    for (uint8_t& value : frame_.pixels) value = static_cast<uint8_t>(value / 2 + 100); // a new frame
    surround_->setFrame({frame_.pixels.data(), frame_.width, frame_.height, frame_.width});
    auto fresher = render::BackdropPass::make();
    ASSERT_TRUE(fresher);
    EXPECT_EQ(shown({0.2f, 0.1f, -1}, *backdrop).pixels, shown({0.2f, 0.1f, -1}, *fresher).pixels);
}

} // namespace
} // namespace shoal
