// Shadows on the ground as drawn.
#include "Spheres.h"
#include "engine/render/ShadowPass.h"
#include "tests/unit/shadow/ShadowScene.h"

#include <array>

namespace shoal {
namespace {

class ShadowGL : public WithContext {};

constexpr int kShadowSize = 200;
constexpr uint8_t kBefore = 200;

using tests::kGround_m, tests::levelGround;

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

ImageRgba8 shaded(std::span<const occlusion::Ellipsoid> body, const render::CastingLight& light,
                  const render::View& view, const water::Water& water,
                  const render::ShadowPass::Cover* cover = nullptr) {
    auto pass = render::ShadowPass::make();
    EXPECT_TRUE(pass) << pass.error().message();
    const gl::Target target(kShadowSize, kShadowSize, 1);
    target.bind();
    glClearColor(kBefore / 255.0f, kBefore / 255.0f, kBefore / 255.0f, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    pass->begin();
    pass->add(body, light, {levelGround()}, {&view, 1});
    pass->draw(view, render::FrameCoding::Srgb, water, cover);
    return target.read();
}

// Looking down ahead, so that ground fills the picture.
render::View downwards() {
    return {.worldFromEye = glm::angleAxis(-0.7f, glm::vec3(1, 0, 0)), .verticalFov = 0.9f, .aspect = 1};
}

TEST_F(ShadowGL, IsTheClosedFormAtEveryPixel) {
    const water::Water sea{.attenuation_perM = {0.2f, 0.1f, 0.08f}};
    const auto body = shark();
    const render::CastingLight light = sunlight();
    std::vector<render::FlatPiece> flat;
    flatten(body, light, flat);
    const render::View view = downwards();
    const ImageRgba8 picture = shaded(body, light, view, sea);
    int darkest = 255;
    double differences = 0;
    for (int y = 0; y < kShadowSize; ++y)
        for (int x = 0; x < kShadowSize; ++x) {
            const glm::vec2 place(2 * (static_cast<float>(x) + 0.5f) / kShadowSize - 1,
                                  1 - 2 * (static_cast<float>(y) + 0.5f) / kShadowSize);
            const glm::vec3 ray = view.worldFromEye * glm::vec3(place * view.halfExtent(), -1);
            const glm::vec3 ground = ray * (kGround_m / ray.y);
            const glm::vec3 left = render::leftOf(render::covered(flat, light, ground) * light.share,
                                                  render::FrameCoding::Srgb, sea, glm::length(ground));
            for (int c = 0; c < 3; ++c) {
                const float expected = static_cast<float>(kBefore) * left[c];
                // Cells in which what is hidden is taken for linear, and rounding.
                ASSERT_NEAR(picture.at(x, y)[c], expected, 5) << x << ", " << y;
                ASSERT_LE(picture.at(x, y)[c], kBefore);
                differences +=
                    std::abs(static_cast<double>(static_cast<float>(picture.at(x, y)[c]) - expected));
            }
            darkest = std::min<int>(darkest, picture.at(x, y)[0]);
        }
    EXPECT_LT(differences / (3.0 * kShadowSize * kShadowSize), 0.6);
    EXPECT_LT(darkest, kBefore - 20); // there is a shadow at all
}

// What is in the picture already, before the ground, is not dimmed; where it covers half, half.
TEST_F(ShadowGL, SparesWhatIsBeforeTheGround) {
    const std::array<uint8_t, 12> texels = {0, 0, 0, 0, 0, 0, 0, 128, 0, 0, 0, 255};
    gl::Texture texture = gl::Texture::make();
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 3, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    constexpr float kWider = 1.5f; // the picture shows its middle two thirds
    const render::ShadowPass::Cover cover{texture.name(), kWider, glm::ivec2(kShadowSize)};
    const ImageRgba8 bare = shaded(shark(), sunlight(), downwards(), {}),
                     spared = shaded(shark(), sunlight(), downwards(), {}, &cover);
    int compared = 0;
    for (int y = 0; y < kShadowSize; ++y)
        for (int x = 0; x < kShadowSize; ++x) {
            const float u = 0.5f + ((static_cast<float>(x) + 0.5f) / kShadowSize - 0.5f) / kWider;
            const float hides = static_cast<float>(texels[4 * static_cast<size_t>(3 * u) + 3]) / 255;
            const int dimmed = kBefore - bare.at(x, y)[0];
            compared += dimmed > 10;
            // Half a level of rounding in each of the pictures, and one for llvmpipe's blending in 8 bits.
            ASSERT_NEAR(kBefore - spared.at(x, y)[0], static_cast<float>(dimmed) * (1 - hides), 2)
                << x << ", " << y;
        }
    EXPECT_GT(compared, 1000);
}

TEST_F(ShadowGL, NothingIsDrawnWhereNothingCasts) {
    const auto untouched = [](const ImageRgba8& picture) {
        for (size_t i = 0; i < picture.pixels.size(); ++i)
            if (picture.pixels[i] != (i % 4 == 3 ? 255 : kBefore)) return false;
        return true;
    };
    render::CastingLight dark = sunlight();
    dark.share = glm::vec3(0);
    EXPECT_TRUE(untouched(shaded(shark(), dark, downwards(), {}))) << "no light, or no ground";
    EXPECT_TRUE(untouched(shaded({}, sunlight(), downwards(), {}))) << "no body";
    const render::View up{
        .worldFromEye = glm::angleAxis(0.8f, glm::vec3(1, 0, 0)), .verticalFov = 0.9f, .aspect = 1};
    EXPECT_TRUE(untouched(shaded(shark(), sunlight(), up, {}))) << "looking up";
}

} // namespace
} // namespace shoal
