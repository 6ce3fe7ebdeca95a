// Nearer parts of a film hide objects, and particles in the water.
#include "Spheres.h"
#include "engine/render/HeadsetPasses.h"
#include "engine/render/ParticlePass.h"
#include "tests/unit/depth/MadeMap.h"

namespace shoal {
namespace {

constexpr int kSize = 256;

// Inverse distances of films: of one without any, and of one with rock in its left half.
float noRock(const glm::vec3&) { return 0; }
float rockToTheLeft(const glm::vec3& d) { return d.x < 0 ? 1.0f : 0.0f; }

class FilmDepthGL : public WithContext {
  protected:
    void setUpInContext() override { pass_ = tests::valueOf(render::ObjectPass::make()); }

    // A film with these inverse distances.
    void setFilm(const std::function<float(const glm::vec3&)>& inverseOf) {
        map_ = depth::mapOf(inverseOf);
        range_.make(map_);
    }

    // A ball of radius 0.5 three metres ahead of the eye, in a film with these inverse distances.
    ImageRgba8 draw(const std::function<float(const glm::vec3&)>& inverseOf,
                    const glm::vec3& eyeInFilm = glm::vec3(0), float away = 3) {
        setFilm(inverseOf);
        Lit lit(uniformFrame(90, 90, 90));
        lit.environment.setDepth({&map_, &map_, &range_});
        const scene::Model model = sphere(0, 0.5f);
        const render::ModelGpu gpu =
            render::uploadModel(model, render::Reflectance::Coded, render::Detail::Full);
        const scene::Pose pose = restingPose(model);
        const gl::Target target(kSize, kSize, 1);
        const glm::vec3 centre = eyeInFilm + glm::vec3(0, 0, -away);
        const glm::mat4 worldFromModel = glm::scale(glm::translate(glm::mat4(1), centre), glm::vec3(0.5f));
        const render::ObjectPass::Object ball{.model = model,
                                              .gpu = gpu,
                                              .pose = pose,
                                              .worldFromModel = worldFromModel,
                                              .bound = {centre, 0.5f}};
        return drawObjects(*pass_, {ball},
                           {.environment = lit.environment,
                            .view = view(eyeInFilm),
                            .canvas = target,
                            .eyeInFilm = eyeInFilm});
    }
    // Marine snow before a film that stands this far ahead, as a wall; 0: a film without distances. It has
    // been drawn with depth up to nearest, as the depth buffer holds it.
    ImageRgba8 drawSnow(float wall_m, const glm::vec3& eye, float nearest = 1) {
        Lit lit(uniformFrame(90, 90, 90));
        if (wall_m > 0) {
            setFilm([&](const glm::vec3& d) { return std::max(-d.z, 0.0f) / wall_m; });
            lit.environment.setDepth({&map_, &map_, &range_});
        }
        auto pass = tests::valueOf(render::ParticlePass::make());
        const gl::Target target(kSize, kSize, 1);
        fill(target, glm::vec4(0), nearest);
        EXPECT_TRUE(pass.draw(
            render::ParticlePass::On::Everything,
            {.environment = lit.environment, .view = snowView(eye), .canvas = target, .eyeInFilm = eye}, {},
            3));
        return target.read();
    }
    static render::View snowView(const glm::vec3& eye) {
        return {.eyeWorld = eye, .verticalFov = 1.5f, .aspect = 1, .heightPixels = kSize};
    }
    static render::View view(const glm::vec3& eye) {
        return {.eyeWorld = eye, .verticalFov = 0.5f, .aspect = 1};
    }
    static double covered(const ImageRgba8& picture, int firstColumn = 0, int endColumn = kSize) {
        double sum = 0;
        for (int y = 0; y < kSize; ++y)
            for (int x = firstColumn; x < endColumn; ++x) sum += picture.at(x, y)[3] / 255.0;
        return sum;
    }

    std::optional<render::ObjectPass> pass_;
    depth::DepthMap map_;
    depth::DepthRange range_;
};

// DepthPass writes a wall 3 m ahead of the camera, seen from the eye, in front of what was drawn farther away
// and behind what was drawn nearer.
TEST_F(FilmDepthGL, IsHandedOnAsDepth) {
    setFilm([](const glm::vec3& d) { return std::max(-d.z, 0.0f) / 3; });
    Lit lit(uniformFrame(90, 90, 90));
    lit.environment.setDepth({&map_, &map_, &range_});
    auto pass = tests::valueOf(render::DepthPass::make());
    const gl::Target drawn(64, 64, 1), into(64, 64, 1);
    into.bind(); // makes its depth
    for (const glm::vec3 eye : {glm::vec3(0), glm::vec3(0.1f, 0.05f, -0.2f)})
        for (const float drawn_m : {100.0f, 50.0f, 2.0f}) {
            render::View seen = view(eye);
            seen.shift = {0.1f, -0.05f};
            fill(drawn, glm::vec4(0), depthAt(drawn_m, seen));
            const render::EyePicture picture{
                .environment = lit.environment, .view = seen, .canvas = drawn, .eyeInFilm = eye};
            pass.draw(drawn, 1, into.framebuffer(), picture, true);
            std::vector<float> values(64 * 64);
            glBindFramebuffer(GL_READ_FRAMEBUFFER, into.framebuffer());
            glReadPixels(0, 0, 64, 64, GL_DEPTH_COMPONENT, GL_FLOAT, values.data());
            const float expected_m = std::min(drawn_m, 3 + eye.z);
            for (const float value : values) {
                const float away_m =
                    seen.near_m * seen.far_m / (seen.far_m - value * (seen.far_m - seen.near_m));
                ASSERT_NEAR(away_m, expected_m, 0.02f * expected_m); // a step of the map is 1.2 % at 3 m
            }
        }
}

TEST_F(FilmDepthGL, NothingHidesWhatIsNearer) {
    const ImageRgba8 free = draw(noRock), before = draw([](const glm::vec3&) { return 1 / 5.0f; });
    EXPECT_GT(covered(free), 1000);
    EXPECT_EQ(free.pixels, before.pixels);
}

TEST_F(FilmDepthGL, AnAnimalWhollyBehindRockIsNotDrawn) {
    draw([](const glm::vec3&) { return 1.0f; });
    EXPECT_EQ(pass_->drawCount(), 0);
    draw([](const glm::vec3&) { return 1 / 2.8f; }); // its front is at 2.5 m
    EXPECT_EQ(pass_->drawCount(), 1);
}

// No program is compiled in the middle of a dive, when the first animal swims behind something.
TEST_F(FilmDepthGL, AnAnimalThatAnEdgeCutsHasItsProgramBefore) {
    draw(noRock);
    draw(noRock);
    const size_t programs = pass_->programCount();
    EXPECT_LT(covered(draw(rockToTheLeft)), 0.9 * covered(draw(noRock))) << "cut indeed";
    EXPECT_EQ(pass_->programCount(), programs);
}

// The film's edge crosses the ball's middle and leaves half of it, up to the outline's pixel column.
TEST_F(FilmDepthGL, AnEdgeCutsWhereTheFilmHasIt) {
    const double all = covered(draw(noRock));
    const ImageRgba8 cut = draw(rockToTheLeft);
    const double rows = 2 * std::sqrt(all / std::numbers::pi); // the ball's, in pixels
    EXPECT_NEAR(covered(cut), all / 2, rows);
    // A texel of the map is 3 pixels wide.
    EXPECT_EQ(covered(cut, 0, kSize / 2 - 4), 0);
}

// Hands that reach are never hidden: nothing of a film is nearer than 0.6 m.
TEST_F(FilmDepthGL, NothingIsNearerThanAHandReaches) {
    constexpr float kAway_m = 1.05f; // the ball's front is at 0.55 m
    for (const ImageRgba8& picture :
         {draw(noRock, {}, kAway_m), draw([](const glm::vec3&) { return 4.0f; }, {}, kAway_m)})
        EXPECT_EQ(picture.at(kSize / 2, kSize / 2)[3], 255);
}

// A wall 1 m ahead that ends straight ahead of the camera. From 0.1 m right of it the eye sees that end at a
// slope of 0.1 to the left, 50 pixels from the middle: hidden is the segment of the ball beyond, up to two of
// the map's texels, 6 columns. From 0.1 m left of it, the end lies 50 pixels to the right.
TEST_F(FilmDepthGL, AnEyeBesideTheCameraSeesPastAnEdge) {
    const auto wall = [](const glm::vec3& d) { return d.x < 0 ? std::max(-d.z, 0.0f) : 0.0f; };
    const double all = covered(draw(noRock));
    const double radius = std::sqrt(all / std::numbers::pi), end = 0.1 / std::tan(0.25) * kSize / 2;
    const double chord = 2 * std::sqrt(radius * radius - end * end);
    const double segment = radius * radius * std::acos(end / radius) - end * chord / 2;
    EXPECT_NEAR(covered(draw(wall, {0.1f, 0, 0})), all - segment, 6 * chord);
    EXPECT_NEAR(covered(draw(wall, {-0.1f, 0, 0})), segment, 6 * chord);
}

// A wall 1 m ahead hides specks as a depth buffer that holds it does, seen from the camera and from beside
// it, but for those that it hides in part: within 1 % of it, and a step of the map, which is 0.7 % there.
TEST_F(FilmDepthGL, NearRockHidesSnow) {
    for (const glm::vec3& eye : {glm::vec3(0), glm::vec3(0.1f, 0.05f, 0)}) {
        const glm::vec4 clip = snowView(eye).clipFromWorld() * glm::vec4(0, 0, -1, 1);
        const double free = covered(drawSnow(0, eye)), hidden = covered(drawSnow(1, eye)),
                     expected = covered(drawSnow(0, eye, 0.5f * clip.z / clip.w + 0.5f));
        EXPECT_GT(expected, 3); // pixels in all, of some dozens of faint specks
        EXPECT_GT(free, 1.5 * expected);
        EXPECT_NEAR(hidden, expected, 0.1 * expected);
    }
}

// A film 5 m away hides no specks, which are all nearer.
TEST_F(FilmDepthGL, SnowBeforeTheFilmIsAsWithoutDistances) {
    EXPECT_EQ(drawSnow(5, {}).pixels, drawSnow(0, {}).pixels);
}

} // namespace
} // namespace shoal
