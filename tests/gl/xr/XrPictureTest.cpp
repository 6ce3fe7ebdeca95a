// A headset shows what the renderer draws from there, pixel by pixel.
#include "engine/core/Log.h"
#include "game/app/Display.h"
#include "game/session/GameSession.h"
#include "game/views/SceneRenderer.h"
#include "input/hands/MouseHands.h"
#include "tests/gl/xr/Fixture.h"

namespace shoal::app {
namespace {

class XrPicture : public test::WithFakeRuntime {
  protected:
    std::optional<SessionConfig> plan_;
    std::optional<CreatureModels> creatures_;
    std::unique_ptr<Environment> environment_;
    std::optional<SceneRenderer> sceneRenderer_;
    std::optional<app::GameSession> run_;
    std::function<void(game::Snapshot&)> showOnly_; // changes what is drawn

    void SetUp() override {
        WithFakeRuntime::SetUp();
        if (IsSkipped()) return;
        openWindow();
        ASSERT_TRUE(window_);
        plan_ = tests::valueOf(makeSessionConfig({.xr = true}));
        creatures_ = tests::valueOf(CreatureModels::load(plan_->species,
                                                         game::speciesShown(plan_->species, plan_->dive),
                                                         "light", reflectanceIn({}), render::Detail::Lean));
        openEnvironment({});
        sceneRenderer_ = tests::valueOf(
            SceneRenderer::make(*creatures_, {.detail = render::Detail::Lean, .floorShadows = true}));
        run_.emplace(*plan_);
        fake.keepPictures = true;
        fake.period_s = 1.0 / 22; // so that the picture is there after few of them
    }
    void TearDown() override {
        run_.reset();
        sceneRenderer_.reset();
        environment_.reset();
        creatures_.reset();
        WithFakeRuntime::TearDown();
    }

    struct Known {
        bool depth = true;   // of the film
        bool lights = false; // that cast shadows
    };
    // With the dive's film.
    void openEnvironment(const Known& known) {
        environment_.reset();
        const Path film = dataRoot() / "content" / plan_->dive.video;
        environment_ = tests::valueOf(
            Environment::open({.player = {.source = {.video = film.string(), .depth = known.depth},
                                          .roomIsSeen = true,
                                          .minRoughness = creatures_->minRoughness(),
                                          .lights = known.lights},
                               .bothEyes = true}));
    }

    Status draw(int eye, const render::View& view, const gl::Target& canvas) {
        const SceneRenderer::Eye seen{eye, view, canvas};
        return sceneRenderer_->draw({&seen, 1});
    }
    // Shows frames until the fade-in is over, then one with the scene at rest.
    void show(HeadsetDisplay& headset, float scale) {
        show(headset, scale, {*sceneRenderer_, [](HudPart, Audience, const render::View&, glm::ivec2) {}});
    }
    void show(HeadsetDisplay& headset, float scale, const Painter& painter) {
        bool drew = false;
        for (int i = 0; i < 20; ++i) {
            ASSERT_TRUE(tests::succeeded(headset.begin()));
            headset.feed(*run_);
            run_->advance(*headset.elapsed_s());
            game::Snapshot shown = run_->shown;
            if (showOnly_) showOnly_(shown);
            sceneRenderer_->set(shown, *environment_, {environment_->exposure(Tone::Auto, 0)});
            const Result<bool> drawn = headset.draw(painter, run_->shown, scale);
            ASSERT_TRUE(drawn) << drawn.error().message();
            drew = *drawn;
        }
        ASSERT_TRUE(drew);
    }
    // Expects ordinary() pictures in both eyes. The dive was centred at LOCAL's origin, the eyes' middle.
    void expectOrdinary(glm::ivec2 size, int samples) {
        for (int eye = 0; eye < 2; ++eye) {
            const test::ShownEye& shown = (*fake.last.eyes)[static_cast<size_t>(eye)];
            ASSERT_EQ(glm::ivec2(shown.rect.extent.width, shown.rect.extent.height), size);
            EXPECT_EQ(shown.rgba, ordinary(eye, size, samples)) << "eye " << eye << " of " << samples;
        }
    }
    // Draws an eye's picture without a headset, from the pose of OpenXR relative to the dive's centre.
    std::vector<uint8_t> ordinary(int eye, glm::ivec2 size, int samples) {
        const XrView& given = fake.views[static_cast<size_t>(eye)];
        const auto& [p, q] = std::pair(given.pose.position, given.pose.orientation);
        const float right = std::tan(given.fov.angleRight), left = std::tan(given.fov.angleLeft);
        const float up = std::tan(given.fov.angleUp), down = std::tan(given.fov.angleDown);
        render::View view;
        view.eyeWorld = test::vectorOf(p);
        view.worldFromEye = glm::quat(q.w, q.x, q.y, q.z);
        view.verticalFov = 2 * std::atan((up - down) / 2);
        view.aspect = (right - left) / (up - down);
        view.shift = {(left + right) / 2, (up + down) / 2};
        view.heightPixels = size.y;
        const gl::Target target(size.x, size.y, samples);
        EXPECT_TRUE(draw(eye, view, target));
        const ImageRgba8 image = target.read();
        std::vector<uint8_t> rgba; // lowest row first, as OpenGL has it
        for (int y = size.y - 1; y >= 0; --y)
            rgba.insert(rgba.end(), image.at(0, y), image.at(0, y) + static_cast<ptrdiff_t>(size.x) * 4);
        return rgba;
    }
};

TEST_F(XrPicture, EqualsTheOrdinaryRenderersFromTheSameEyes) {
    for (const int samples : {1, 4}) {
        placeHead({});
        auto headset = tests::valueOf(HeadsetDisplay::open(*window_, plan_->rig, samples));
        for (const float scale : {1.0f, 0.6f}) {
            show(headset, scale);
            ASSERT_TRUE(fake.last.eyes);
            const glm::ivec2 size(glm::vec2(200, 240) * scale + 0.5f);
            expectOrdinary(size, samples);
            EXPECT_NE((*fake.last.eyes)[0].rgba, (*fake.last.eyes)[1].rgba);
        }
        // The head leans, turns and tilts.
        placeHead({0.1f, -0.05f, 0.2f}, glm::normalize(glm::quat(0.9f, 0.2f, -0.35f, 0.15f)));
        show(headset, 1);
        expectOrdinary({200, 240}, samples);
    }
}

TEST_F(XrPicture, InTheRoomOnlyAnimalsAreSeenAndHandsHideThem) {
    const glm::ivec2 size(200, 240);
    const render::View view{.verticalFov = 1.2f, .aspect = 200.0f / 240, .heightPixels = size.y};
    game::Snapshot shown = run_->shown;
    shown.creatures.resize(1);
    shown.creatures[0].position = {0, 0, -1};
    shown.creatures[0].worldFromBody = glm::angleAxis(1.57f, glm::vec3(0, 1, 0)); // from the side
    shown.creatures[0].length = 0.5f;
    const auto pose = hands::reachingHand(plan_->rig, hands::Side::Right, {0, 0, -0.5f}, 0.5f);
    for (const int samples : {1, 4}) {
        const gl::Target target(size.x, size.y, samples);
        const auto drawn = [&](bool hand, render::Surroundings surroundings) {
            shown.hands[1].visible = hand;
            for (size_t i = 0; i < pose.joints.size(); ++i) shown.hands[1].joints[i] = pose.joints[i];
            sceneRenderer_->set(shown, *environment_, {environment_->exposure(Tone::Auto, 0)});
            const SceneRenderer::Eye eye{0, view, target, surroundings};
            EXPECT_TRUE(sceneRenderer_->draw({&eye, 1}));
            return target.read().pixels;
        };
        const auto alone = drawn(false, render::Surroundings::Room);
        const auto behindHand = drawn(true, render::Surroundings::Room);
        const auto inFilm = drawn(true, render::Surroundings::Film);
        size_t clear = 0, solid = 0, hidden = 0;
        double light = 0;
        for (size_t i = 0; i < alone.size(); i += 4) {
            const uint8_t alpha = alone[i + 3];
            // Premultiplied: no colour is above its alpha, but for the rounding of a resolve.
            for (size_t c = 0; c < 3; ++c) ASSERT_LE(alone[i + c], alpha + 1) << i;
            clear += alpha == 0;
            solid += alpha == 255;
            if (alpha == 255) light += alone[i + 1];
            EXPECT_LE(behindHand[i + 3], alpha) << "a hand is not drawn";
            hidden += behindHand[i + 3] == 0 && alpha == 255;
            EXPECT_EQ(inFilm[i + 3], 255);
        }
        const size_t all = alone.size() / 4;
        EXPECT_GT(solid, all / 100); // 0.5 m seen from 1 m is 88 pixels long
        EXPECT_GT(clear, all / 2);
        EXPECT_GT(hidden, solid / 10);
        EXPECT_LT(hidden, solid);
        EXPECT_GT(light / static_cast<double>(solid), 20); // lit
        if (samples == 4) {
            EXPECT_LT(clear + solid, all); // outlines are smooth
        }
    }
}

// The runtime decodes the picture and adds what is left of the room: alpha multiplies light, not codes.
TEST_F(XrPicture, HalfCoverageOfTheRoomGivesHalfTheLight) {
    fake.blendModes = {XR_ENVIRONMENT_BLEND_MODE_OPAQUE, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND};
    const Painter half{*sceneRenderer_, [](HudPart part, Audience, const render::View&, glm::ivec2) {
                           if (part != HudPart::Marks) return;
                           glClearColor(0.4f, 0.3f, 0.2f, 0.5f); // coded, times coverage
                           glClear(GL_COLOR_BUFFER_BIT);         // over the scene
                       }};
    for (const int samples : {1, 4}) {
        auto headset = tests::valueOf(HeadsetDisplay::open(*window_, plan_->rig, samples));
        for (const bool room : {true, false}) {
            ASSERT_TRUE(headset.showRoom(room));
            show(headset, 1, half);
            const auto& rgba = (*fake.last.eyes)[0].rgba;
            // 8 bits in, which are 2 of what was covered, and 8 bits out.
            EXPECT_NEAR(rgba[0], 255 * (room ? 0.5855 : 0.4), 2); // sRGB: 0.8 is 0.604, half of it 0.5855
            EXPECT_NEAR(rgba[1], 255 * (room ? 0.4357 : 0.3), 2); // 0.6 is 0.319
            EXPECT_NEAR(rgba[2], 255 * (room ? 0.2859 : 0.2), 2); // 0.4 is 0.133
            EXPECT_NEAR(rgba[3], 127.5, 1);
        }
    }
}

// Ray through the middle of a pixel, in the eye's frame; as long as to the plane z = -1.
glm::vec3 rayThrough(const test::ShownEye& eye, int x, int y) {
    const glm::vec2 share((static_cast<float>(x) + 0.5f) / static_cast<float>(eye.rect.extent.width),
                          (static_cast<float>(y) + 0.5f) / static_cast<float>(eye.rect.extent.height));
    return {glm::mix(std::tan(eye.fov.angleLeft), std::tan(eye.fov.angleRight), share.x),
            glm::mix(std::tan(eye.fov.angleDown), std::tan(eye.fov.angleUp), share.y), -1};
}

// Under an animal the floor is darker, as far as its shadow reaches, where the headset knows the floor.
TEST_F(XrPicture, ShadowsOfAnimalsFallOnTheRoomsFloor) {
    withoutValidation();
    openEnvironment({.depth = false, .lights = true});
    constexpr float kFloor_m = -1.3f, kLength_m = 0.5f;
    fake.extensions.insert(XR_EXT_LOCAL_FLOOR_EXTENSION_NAME);
    fake.blendModes = {XR_ENVIRONMENT_BLEND_MODE_OPAQUE, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND};
    const glm::quat down = glm::angleAxis(-0.8f, glm::vec3(1, 0, 0));
    placeHead({}, down);
    const glm::vec3 fish(0, -0.6f, -1.2f);
    const auto pose = hands::reachingHand(plan_->rig, hands::Side::Right, {0, -0.5f, -0.5f}, 0.5f);
    const auto shown = [&](bool animal, bool floor) {
        fake.referenceSpaces.erase(XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT);
        if (floor)
            fake.referenceSpaces[XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT] = {{0, 0, 0, 1}, {0, kFloor_m, 0}};
        showOnly_ = [&, animal](game::Snapshot& snapshot) {
            snapshot.creatures.resize(1);
            snapshot.creatures[0] = {.species = snapshot.creatures[0].species,
                                     .position = fish,
                                     .worldFromBody = glm::angleAxis(1.57f, glm::vec3(0, 1, 0)),
                                     .length = kLength_m};
            snapshot.hands = {};
            if (animal) return;
            snapshot.creatures.clear();
            snapshot.hands[1].visible = true;
            for (size_t i = 0; i < pose.joints.size(); ++i) snapshot.hands[1].joints[i] = pose.joints[i];
        };
        auto headset = HeadsetDisplay::open(*window_, plan_->rig, 1);
        EXPECT_TRUE(headset);
        EXPECT_TRUE(headset->showRoom(true));
        show(*headset, 1);
        return fake.last.eyes.value();
    };
    const auto with = shown(true, true), without = shown(true, false), handAlone = shown(false, true);
    const light::ShadowLight& light = environment_->player().shadowLight();
    const glm::vec3 towards = glm::transpose(environment_->envFromWorld()) * light.light.direction;
    ASSERT_GT(light.presence, 0.5f);
    ASSERT_GT(towards.y, 0.6f);
    const float fall_m = (fish.y - kFloor_m) / towards.y;
    const glm::vec3 middle = fish - towards * fall_m;
    const float reach_m = (kLength_m / 2 + std::tan(light.light.radius) * fall_m) / towards.y + 0.1f;
    for (size_t e = 0; e < 2; ++e) {
        const test::ShownEye& eye = with[e];
        const int width = eye.rect.extent.width, height = eye.rect.extent.height;
        const glm::vec3 at = test::vectorOf(eye.localFromEye.position);
        int shaded = 0, strongest = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const size_t i = 4 * static_cast<size_t>(y * width + x);
                const int alpha = eye.rgba[i + 3], alone = without[e].rgba[i + 3];
                ASSERT_EQ(handAlone[e].rgba[i + 3], 0) << "hands cast their own";
                ASSERT_GE(alpha, alone);
                if (alpha == alone) continue;
                const glm::vec3 ray = down * rayThrough(eye, x, y);
                ASSERT_LT(ray.y, 0);
                const glm::vec3 place = at + ray * ((kFloor_m - at.y) / ray.y);
                ASSERT_LT(glm::distance(place, middle), reach_m);
                if (alone == 0) {
                    EXPECT_EQ(eye.rgba[i] + eye.rgba[i + 1], 0) << "black";
                }
                ++shaded;
                strongest = std::max(strongest, alpha - alone);
            }
        EXPECT_GT(shaded, 300);
        EXPECT_GT(strongest, 12);
    }
}

// The film's depth is that of its track, from each eye. A runtime that takes no depth is given none.
TEST_F(XrPicture, DepthIsThatOfTheFilmToo) {
    ASSERT_TRUE(environment_->depth()) << "the reef's film comes with a track of distances";
    showOnly_ = [](game::Snapshot& shown) {
        shown.hands = {};
        shown.creatures.clear();
    };
    {
        auto headset = tests::valueOf(HeadsetDisplay::open(*window_, plan_->rig, 1));
        show(headset, 1);
        EXPECT_FALSE((*fake.last.eyes)[0].depth) << "the runtime takes no depth";
    }
    fake.extensions.insert(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
    fake.formats.push_back(GL_DEPTH_COMPONENT32F);
    const glm::quat down = glm::angleAxis(-0.3f, glm::vec3(1, 0, 0));
    placeHead({}, down);
    auto headset = tests::valueOf(HeadsetDisplay::open(*window_, plan_->rig, 1));
    show(headset, 1);
    ASSERT_TRUE(fake.last.eyes);
    const glm::mat3 envFromWorld = environment_->envFromWorld();
    for (const test::ShownEye& eye : *fake.last.eyes) {
        ASSERT_TRUE(eye.depth);
        const float near_m = eye.depth->near_m, far_m = eye.depth->far_m;
        const int width = eye.rect.extent.width, height = eye.rect.extent.height;
        const glm::vec3 eyeEnv = envFromWorld * test::vectorOf(eye.localFromEye.position);
        int asked = 0, known = 0, wrong = 0;
        for (int y = 4; y < height; y += 8)
            for (int x = 4; x < width; x += 8) {
                const glm::vec3 ray = rayThrough(eye, x, y);
                const glm::vec3 dirEnv = envFromWorld * (down * glm::normalize(ray));
                const glm::vec3 seen = depth::filmDirectionSeen(*environment_->depth(), eyeEnv, dirEnv);
                const float inverse_perM = environment_->depth()->inverse_perM(seen);
                // 1/m along the eye's axis.
                const glm::vec3 toPlace = seen - eyeEnv * inverse_perM;
                const float expected =
                    inverse_perM * glm::length(ray) / std::max(glm::length(toPlace), 1e-3f);
                const float value = eye.depth->values[static_cast<size_t>(y * width + x)];
                const float found = (1 - value * (far_m - near_m) / far_m) / near_m;
                ++asked;
                if (std::max(expected, found) < 2 / far_m) continue; // as good as the far plane
                ++known;
                // A step of the map, and what 24 and 32 bits of depth leave of it.
                wrong += std::abs(found - expected) > depth::DepthMap::perM(1) + 0.02f * expected;
            }
        EXPECT_GT(known, asked / 4);
        EXPECT_LT(wrong, known / 25); // at edges, where a texel decides
    }
}

// However objects are combined with the film, in the canvas or in a layer of another size, and whatever the
// size that is drawn: depth is less than the far plane's where an animal is, and that of its distance.
TEST_F(XrPicture, DepthIsThatOfTheAnimals) {
    openEnvironment({.depth = false});
    fake.extensions.insert(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
    fake.formats.push_back(GL_DEPTH_COMPONENT32F);
    constexpr float kRight_m = 0.6f, kUp_m = 0.4f, kAway_m = 1.0f, kLength_m = 0.4f;
    std::map<std::pair<int, bool>, glm::vec2> plainly; // where its middle is, by samples and place
    using enum render::Composition;
    for (const render::Composition composition : {Plain, VideoTexels})
        for (const int samples : {1, 4})
            for (const bool besideCamera : {false, true}) {
                sceneRenderer_ = tests::valueOf(
                    SceneRenderer::make(*creatures_, {.detail = render::Detail::Lean,
                                                      .floorShadows = true,
                                                      .compositor = {.composition = composition}}));
                // One eye where the film's camera is, for which objects are put into the film's own texels.
                fake.views[0].pose.position.x = besideCamera ? -0.032f : 0.0f;
                fake.views[1].pose.position.x = besideCamera ? 0.032f : 0.0f;
                auto headset = tests::valueOf(HeadsetDisplay::open(*window_, plan_->rig, samples));
                showOnly_ = [&](game::Snapshot& shown) {
                    shown.hands = {};
                    // The animal has the same pose each time and does not swim.
                    shown.creatures = {{.species = shown.creatures[0].species,
                                        .position = {kRight_m, kUp_m, -kAway_m},
                                        .worldFromBody = glm::angleAxis(1.57f, glm::vec3(0, 1, 0)),
                                        .length = kLength_m}};
                };
                show(headset, besideCamera ? 0.6f : 1.0f);
                ASSERT_TRUE(fake.last.eyes);
                const test::ShownEye& eye = (*fake.last.eyes)[0];
                ASSERT_TRUE(eye.depth);
                EXPECT_EQ(eye.depth->rect.extent.width, eye.rect.extent.width);
                const float near_m = eye.depth->near_m, far_m = eye.depth->far_m;
                const int width = eye.rect.extent.width, height = eye.rect.extent.height;
                ASSERT_EQ(eye.depth->values.size(), static_cast<size_t>(width * height));
                int count = 0;
                glm::vec2 sum(0);
                for (int y = 0; y < height; ++y)
                    for (int x = 0; x < width; ++x) {
                        const float value = eye.depth->values[static_cast<size_t>(y * width + x)];
                        if (value == 1) continue;
                        // OpenGL's window depth of a perspective: the specification's, with depths 0 to 1.
                        const float away_m = near_m * far_m / (far_m - value * (far_m - near_m));
                        EXPECT_NEAR(away_m, kAway_m, kLength_m / 4); // half its width, and the tail's swing
                        ++count;
                        sum += glm::vec2(x, y) + 0.5f;
                    }
                // It is seen about the point at the animal's middle, by the eye's angles.
                const float left = std::tan(eye.fov.angleLeft), right = std::tan(eye.fov.angleRight);
                const float down = std::tan(eye.fov.angleDown), up = std::tan(eye.fov.angleUp);
                const float x = (kRight_m - eye.localFromEye.position.x) / kAway_m;
                const glm::vec2 seen((x - left) / (right - left) * static_cast<float>(width),
                                     (kUp_m / kAway_m - down) / (up - down) * static_cast<float>(height));
                const float pixels = kLength_m / kAway_m / (right - left) * static_cast<float>(width);
                ASSERT_GT(count, 0.05f * pixels * pixels) << static_cast<int>(composition);
                EXPECT_LT(count, pixels * pixels);
                const glm::vec2 middle = sum / static_cast<float>(count);
                EXPECT_LT(glm::distance(middle, seen), 0.15f * pixels);
                // Less than the 2 % by which a layer is wider than the picture: 1.4 pixels here.
                const glm::vec2 expected = plainly.try_emplace({samples, besideCamera}, middle).first->second;
                EXPECT_LT(glm::distance(middle, expected), 0.8f)
                    << static_cast<int>(composition) << " " << samples << " " << besideCamera;
            }
}

TEST_F(XrPicture, OnlookersSeeTheLeftEyesMiddle) {
    auto headset = tests::valueOf(HeadsetDisplay::open(*window_, plan_->rig, 1));
    show(headset, 1);
    // 200 x 240 cropped to a square of 200, on a window of 64: the rows from 20 to 220.
    const auto& rgba = (*fake.last.eyes)[0].rgba;
    std::vector<uint8_t> seen(64 * 64 * 4);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glReadPixels(0, 0, 64, 64, GL_RGBA, GL_UNSIGNED_BYTE, seen.data());
    const auto mean = [](const std::vector<uint8_t>& of, int width, int y0, int y1) {
        double sum = 0;
        for (int y = y0; y < y1; ++y)
            for (int x = 0; x < width; ++x) sum += of[static_cast<size_t>(y * width + x) * 4 + 1];
        return sum / (width * (y1 - y0));
    };
    // Bands of a quarter: filtered to a third of the size, they keep their means to a step or two.
    for (int band = 0; band < 4; ++band)
        EXPECT_NEAR(mean(seen, 64, band * 16, band * 16 + 16),
                    mean(rgba, 200, 20 + band * 50, 70 + band * 50), 2)
            << band;
    EXPECT_NEAR(headset.windowView().aspect, 1, 1e-6f);
}

} // namespace
} // namespace shoal::app
