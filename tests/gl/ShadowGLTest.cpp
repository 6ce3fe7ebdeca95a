// Shadows on a film's surfaces, as the background draws them by OpenGL and on the processor.
#include "Spheres.h"
#include "engine/render/BackgroundPass.h"
#include "engine/render/software/FrameSampler.h"
#include "tests/unit/shadow/ShadowScene.h"

namespace shoal {
namespace {

constexpr int kShadowSize = 200;
constexpr uint8_t kBefore = 200;

using tests::kGround_m;

render::CastingLight sunlight() {
    return {.towards = glm::normalize(glm::vec3(-0.2f, 0.9f, 0.35f)),
            .tangent = 0.28f,
            .share = {0.5f, 0.4f, 0.3f}};
}

std::vector<occlusion::Ellipsoid> shark() {
    std::vector<occlusion::Ellipsoid> body;
    for (int i = 0; i < 3; ++i)
        body.push_back(
            {{-0.8f + static_cast<float>(i) * 0.65f, -0.3f, -2.2f}, glm::mat3(1), {0.45f, 0.2f, 0.2f}});
    return body;
}

class ShadowGL : public WithContext, public testing::WithParamInterface<render::Backend> {
  protected:
    void setUpInContext() override {
        if (GetParam() == render::Backend::Software && !render::canSampleFrames())
            GTEST_SKIP() << "this processor lacks what samples frames";
        frame_.pixels.assign(frame_.pixels.size(), kBefore);
        for (size_t i = 3; i < frame_.pixels.size(); i += 4) frame_.pixels[i] = 255;
        environment_.emplace().setFrame({frame_.pixels.data(), frame_.width, frame_.height, frame_.width});
        background_ = tests::valueOf(render::BackgroundPass::make(GetParam(), true));
        shadows_.begin({&ground_, &range_}, render::FrameCoding::Srgb, sea_);
    }

    void cast(const render::View& view) { shadows_.add(shark(), sunlight(), {&view, 1}); }

    ImageRgba8 drawn(const render::View& view, const render::ObjectLayer* layer = nullptr) {
        const gl::Target target(kShadowSize, kShadowSize, 1);
        target.bindColour();
        EXPECT_TRUE(background_->draw(
            {.environment = *environment_, .view = view, .canvas = target, .shadows = &shadows_}, layer));
        return target.read();
    }

    render::FrameTiles allTiles() const {
        render::FrameTiles tiles;
        const Sphere everything{{0, 0, 0}, 100};
        tiles.choose({frame_.width, frame_.height}, glm::mat3(1), {&everything, 1}, glm::vec3(0));
        return tiles;
    }

    const depth::DepthMap ground_ = tests::levelGround();
    const depth::DepthRange range_ = tests::rangeOf(ground_);
    const water::Water sea_{.veil = {{{0.05f, 0.15f, 0.25f}}}, .attenuation_perM = {0.2f, 0.1f, 0.08f}};
    std::optional<render::EnvironmentGpu> environment_;
    ImageRgba8 frame_{2048, 1024};
    std::unique_ptr<render::BackgroundPass> background_;
    render::FilmShadows shadows_;
};

// Looking down ahead, so that ground fills the picture; and straight down, where the map has its pole.
render::View downwards(float pitch = -0.7f) {
    return {.worldFromEye = glm::angleAxis(pitch, glm::vec3(1, 0, 0)), .verticalFov = 0.9f, .aspect = 1};
}

TEST_P(ShadowGL, IsTheClosedFormAtEveryPixel) {
    std::vector<render::FlatPiece> flat;
    flatten(shark(), sunlight(), flat);
    for (const float pitch : {-0.7f, -1.4f}) {
        const render::View view = downwards(pitch);
        shadows_.begin({&ground_, &range_}, render::FrameCoding::Srgb, sea_);
        cast(view);
        const ImageRgba8 picture = drawn(view);
        int darkest = 255;
        double differences = 0;
        for (int y = 0; y < kShadowSize; ++y)
            for (int x = 0; x < kShadowSize; ++x) {
                const glm::vec3 ray = rayThrough(view, x, y, glm::vec2(kShadowSize));
                const glm::vec3 ground = ray * (kGround_m / ray.y);
                const glm::vec3 left = render::remainingOf(
                    render::covered(flat, sunlight(), ground) * sunlight().share, render::FrameCoding::Srgb,
                    render::surfaceShare(sea_, glm::length(ground)));
                for (int c = 0; c < 3; ++c) {
                    const float expected = static_cast<float>(kBefore) * left[c];
                    // Steps of the map of distances tilt the ground, which changes its share of the light.
                    ASSERT_NEAR(picture.at(x, y)[c], expected, 5) << x << ", " << y;
                    ASSERT_LE(picture.at(x, y)[c], kBefore);
                    differences +=
                        std::abs(static_cast<double>(static_cast<float>(picture.at(x, y)[c]) - expected));
                }
                darkest = std::min<int>(darkest, picture.at(x, y)[0]);
            }
        EXPECT_LT(differences / (3.0 * kShadowSize * kShadowSize), 0.6);
        if (pitch > -1) {
            EXPECT_LT(darkest, kBefore - 20); // there is a shadow at all
        }
    }
}

// Objects that are laid over the film are not dimmed; where they cover half, half of the film is.
TEST_P(ShadowGL, SparesWhatIsBeforeTheGround) {
    const render::View view = downwards();
    cast(view);
    const ImageRgba8 bare = drawn(view);
    auto layer = tests::valueOf(render::LayerPass::make());
    constexpr int kLayer = 400;
    layer.begin({kLayer, kLayer}, 1);
    for (int third = 0; third < 3; ++third) // clear, half covered, covered: by black
        fill(third * kLayer / 3, 0, kLayer / 3 + 1, kLayer, {0, 0, 0, static_cast<float>(third) / 2});
    layer.end();
    const render::FrameTiles tiles = allTiles();
    // Wider than the picture: texels at its edge are filtered with those beside them.
    const render::ObjectLayer objects{layer, render::widened(view, 1.02f), &tiles};
    const ImageRgba8 covered = drawn(view, &objects);
    int dimmed = 0;
    for (int y = 0; y < kShadowSize; ++y)
        for (int x = 0; x < kShadowSize; ++x) {
            const float third = 3 * (static_cast<float>(x) + 0.5f) / kShadowSize;
            if (std::abs(third - std::round(third)) < 0.1f) continue; // texels of the film are coarser
            const float open = 1 - 0.5f * std::floor(third);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(covered.at(x, y)[c], open * static_cast<float>(bare.at(x, y)[c]), 2)
                    << x << ", " << y;
            dimmed += open > 0 && bare.at(x, y)[0] < kBefore - 10;
        }
    EXPECT_GT(dimmed, 1000);
}

// Pixels of a view that does not move are reused where nothing changes: no object stays in them, and no
// shadow is missing after an object has passed.
TEST_P(ShadowGL, IsBackWhereAnObjectHasPassed) {
    const render::View view = downwards();
    cast(view);
    const ImageRgba8 before = drawn(view);
    auto layer = tests::valueOf(render::LayerPass::make());
    const render::FrameTiles tiles = allTiles();
    const render::ObjectLayer objects{layer, render::widened(view, 1.02f), &tiles};
    const auto with = [&](float alpha) {
        layer.begin({400, 400}, 1);
        fill(120, 100, 150, 200, {0, 0, 0, alpha});
        layer.end();
        return drawn(view, &objects);
    };
    const ImageRgba8 empty = with(0);
    EXPECT_NE(with(1).pixels, empty.pixels);
    EXPECT_EQ(with(0).pixels, empty.pixels);
    EXPECT_EQ(drawn(view).pixels, before.pixels);
}

TEST_P(ShadowGL, IsGoneWithWhatCastIt) {
    const render::View view = downwards();
    cast(view);
    const ImageRgba8 shaded = drawn(view);
    shadows_.begin({&ground_, &range_}, render::FrameCoding::Srgb, sea_);
    const ImageRgba8 bare = drawn(view);
    EXPECT_NE(shaded.pixels, bare.pixels);
    for (size_t i = 0; i < bare.pixels.size(); ++i) ASSERT_EQ(bare.pixels[i], i % 4 == 3 ? 255 : kBefore);
}

INSTANTIATE_TEST_SUITE_P(Backends, ShadowGL,
                         testing::Values(render::Backend::OpenGL, render::Backend::Software));

} // namespace
} // namespace shoal
