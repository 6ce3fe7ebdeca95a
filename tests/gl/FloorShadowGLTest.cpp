// Shadows on the floor of the player's room as drawn: an alpha, and nothing else.
#include "Spheres.h"
#include "engine/render/FloorShadowPass.h"

namespace shoal {
namespace {

constexpr int kFloorPixels = 200;
constexpr float kFloor_m = -1.2f;

using Body = std::vector<occlusion::Ellipsoid>;

class FloorShadowGL : public WithContext {
  protected:
    static render::CastingLight lamp() {
        return {.towards = glm::normalize(glm::vec3(-0.2f, 0.9f, 0.35f)),
                .tangent = 0.2f,
                .share = {0.7f, 0.6f, 0.5f}};
    }
    // About as long as an arm.
    static Body fishAt(const glm::vec3& place) { return {{place, glm::mat3(1), {0.3f, 0.1f, 0.08f}}}; }
    static render::View view(float side = 0) {
        return {.eyeWorld = {side, 0, 0},
                .worldFromEye = glm::angleAxis(-0.7f, glm::vec3(1, 0, 0)),
                .verticalFov = 0.9f,
                .aspect = 1};
    }
    // before: what objects have left in the picture and its depth.
    static ImageRgba8 drawn(std::span<const Body> bodies, const render::View& view,
                            const glm::vec4& before = glm::vec4(0), float depthBefore = 1,
                            render::FrameCoding frames = render::FrameCoding::Srgb) {
        auto pass = tests::valueOf(render::FloorShadowPass::make());
        const gl::Target target(kFloorPixels, kFloorPixels, 1);
        fill(target, before, depthBefore);
        glEnable(GL_DEPTH_TEST);
        pass.begin();
        for (const Body& body : bodies) pass.add(body, lamp(), kFloor_m, frames);
        pass.draw(view);
        return target.read();
    }
    // The place of the floor that a pixel shows.
    static glm::vec3 floorAt(const render::View& view, int x, int y) {
        const glm::vec3 ray = rayThrough(view, x, y, glm::vec2(kFloorPixels));
        return view.eyeWorld + ray * ((kFloor_m - view.eyeWorld.y) / ray.y);
    }
};

TEST_F(FloorShadowGL, IsTheClosedFormAtEveryPixelOfEitherEye) {
    const Body fish = fishAt({0.1f, -0.5f, -1.3f});
    std::vector<render::FlatPiece> flat;
    flatten(fish, lamp(), flat);
    for (const auto& [side, frames] :
         {std::pair(-0.032f, render::FrameCoding::Srgb), std::pair(0.032f, render::FrameCoding::Srgb),
          std::pair(0.032f, render::FrameCoding::Thesis)}) {
        const render::View eye = view(side);
        const ImageRgba8 picture = drawn({{fish}}, eye, glm::vec4(0), 1, frames);
        int darkest = 0, clear = 0;
        double differences = 0;
        for (int y = 0; y < kFloorPixels; ++y)
            for (int x = 0; x < kFloorPixels; ++x) {
                const uint8_t* pixel = picture.at(x, y);
                ASSERT_EQ(pixel[0] + pixel[1] + pixel[2], 0);
                glm::vec3 left = 1.0f - covered(flat, lamp(), floorAt(eye, x, y)) * lamp().share;
                if (frames == render::FrameCoding::Thesis) left *= left;
                const float expected = 255 * (1 - glm::dot(left, glm::vec3(0.2126f, 0.7152f, 0.0722f)));
                // Cells in which what is hidden is taken for linear, and rounding.
                ASSERT_NEAR(pixel[3], expected, 8) << x << ", " << y;
                differences += std::abs(static_cast<double>(static_cast<float>(pixel[3]) - expected));
                darkest = std::max<int>(darkest, pixel[3]);
                clear += pixel[3] == 0;
            }
        EXPECT_LT(differences / (kFloorPixels * kFloorPixels), 0.6);
        EXPECT_GT(darkest, 60);
        EXPECT_GT(clear, kFloorPixels * kFloorPixels / 2);
    }
}

TEST_F(FloorShadowGL, TwoTakeWhatTheOtherLeaves) {
    const Body a = fishAt({0.1f, -0.5f, -1.3f}), b = fishAt({0, -0.6f, -1.25f});
    const ImageRgba8 one = drawn({{a}}, view()), other = drawn({{b}}, view()), both = drawn({{a, b}}, view());
    int shared = 0;
    for (int y = 0; y < kFloorPixels; ++y)
        for (int x = 0; x < kFloorPixels; ++x) {
            const float p = one.at(x, y)[3] / 255.0f, q = other.at(x, y)[3] / 255.0f;
            EXPECT_NEAR(both.at(x, y)[3], 255 * (1 - (1 - p) * (1 - q)), 1.5f);
            shared += p > 0.1f && q > 0.1f;
        }
    EXPECT_GT(shared, 100);
}

// The shadow lies behind a hand, which is only in the depth buffer, and an animal, which is in the picture.
TEST_F(FloorShadowGL, LiesBehindWhatIsNearer) {
    const Body fish = fishAt({0.1f, -0.5f, -1.3f});
    const auto darkest = [](const ImageRgba8& picture) {
        int most = 0;
        for (size_t i = 3; i < picture.pixels.size(); i += 4) most = std::max<int>(most, picture.pixels[i]);
        return most;
    };
    EXPECT_EQ(darkest(drawn({{fish}}, view(), glm::vec4(0), depthAt(0.5f, view()))), 0);
    EXPECT_GT(darkest(drawn({{fish}}, view(), glm::vec4(0), depthAt(5, view()))), 60);
    const glm::vec4 half(0.2f, 0.1f, 0.3f, 0.5f); // what is half clear leaves half of the shadow
    const ImageRgba8 shadow = drawn({{fish}}, view()), under = drawn({{fish}}, view(), half);
    for (int y = 0; y < kFloorPixels; ++y)
        for (int x = 0; x < kFloorPixels; ++x) {
            EXPECT_EQ(under.at(x, y)[0], 51);
            EXPECT_NEAR(under.at(x, y)[3], 127.5f + shadow.at(x, y)[3] / 2.0f, 1.5f);
        }
}

TEST_F(FloorShadowGL, NothingBelowTheFloorCasts) {
    const ImageRgba8 picture = drawn({{fishAt({0, -1.5f, -1.3f})}}, view());
    EXPECT_EQ(picture.pixels, std::vector<uint8_t>(picture.pixels.size(), 0));
}

} // namespace
} // namespace shoal
