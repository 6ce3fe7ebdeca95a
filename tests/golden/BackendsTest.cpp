// Whole dives, drawn with the background and its texels by OpenGL and by the processor.
#include "engine/core/WriteFile.h"
#include "engine/platform/Window.h"
#include "engine/render/software/FrameSampler.h"
#include "game/app/GuideAnimal.h"
#include "game/session/GameSession.h"
#include "game/views/SceneRenderer.h"
#include "tests/Test.h"

namespace shoal::app {
namespace {

using render::Backend;
using render::Composition;

constexpr glm::ivec2 kSize(640, 360);

int greatestDifference(const ImageRgba8& a, const ImageRgba8& b) {
    int greatest = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i)
        greatest = std::max(greatest, std::abs(a.pixels[i] - b.pixels[i]));
    return greatest;
}

class Backends : public testing::Test {
  protected:
    void SetUp() override {
        auto context = platform::Headless::open();
        if (!context) GTEST_SKIP() << context.error().message();
        if (!render::canSampleFrames()) GTEST_SKIP() << "this processor has no AVX2";
        context_ = std::move(*context);
        config_ = tests::valueOf(makeSessionConfig({.headless = true}));
        creatures_ = tests::valueOf(CreatureModels::load(config_->species,
                                                         game::speciesShown(config_->species, config_->dive),
                                                         "light", reflectanceIn({}), render::Detail::Lean));
        const Path film = dataRoot() / "content" / config_->dive.video;
        environment_ = tests::valueOf(Environment::open({.player = {.source = {.video = film.string()},
                                                                    .minRoughness = creatures_.minRoughness(),
                                                                    .water = true,
                                                                    .lights = true,
                                                                    .cameraResponse = true}}));
        renderer_ = tests::valueOf(SceneRenderer::make(creatures_, {.detail = render::Detail::Lean}));
    }

    // Draws this way from now on.
    void drawBy(Composition composition, Backend backend) {
        renderer_ = tests::valueOf(SceneRenderer::make(
            creatures_, {.detail = render::Detail::Lean,
                         .compositor = {.composition = composition, .backend = backend}}));
    }

    void keepPlanes() {
        EnvironmentSetup setup = environment_->setup();
        setup.player.planes = true;
        environment_ = tests::valueOf(Environment::open(setup));
    }

    // Returns a dive that has run for so long, and its film with it.
    GameSession sessionAt(double time_s) {
        GameSession session(*config_);
        session.advance(time_s);
        environment_->update(session.shown.time_s, true);
        return session;
    }

    std::vector<ImageRgba8> draw(const game::Snapshot& shown, int eyes, Composition composition,
                                 Backend backend) {
        drawBy(composition, backend);
        return draw(shown, eyes);
    }

    std::vector<ImageRgba8> draw(const game::Snapshot& shown, int eyes) {
        renderer_->set(shown, *environment_, {environment_->exposure(Tone::Auto, 0)});
        const std::array<gl::Target, 2> canvases = {gl::Target(kSize.x, kSize.y, 1),
                                                    gl::Target(kSize.x, kSize.y, 1)};
        const auto seenBy = [&](int eye) -> SceneRenderer::Eye {
            render::View view;
            view.worldFromEye = shown.worldFromView;
            const float side = eyes == 2 ? (eye == 0 ? -0.032f : 0.032f) : 0.0f;
            view.eyeWorld = shown.headWorld + view.worldFromEye * glm::vec3(side, 0, 0);
            view.verticalFov = glm::radians(65.0f);
            view.aspect = static_cast<float>(kSize.x) / kSize.y;
            view.heightPixels = kSize.y;
            return {eye, view, canvases[eye]};
        };
        const std::array<SceneRenderer::Eye, 2> both = {seenBy(0), seenBy(1)};
        EXPECT_TRUE(renderer_->draw(std::span(both).first(static_cast<size_t>(eyes))));
        std::vector<ImageRgba8> pictures;
        for (int eye = 0; eye < eyes; ++eye) pictures.push_back(canvases[eye].read());
        return pictures;
    }

    std::optional<platform::Headless> context_;
    std::optional<SessionConfig> config_;
    CreatureModels creatures_;
    std::unique_ptr<Environment> environment_;
    std::optional<SceneRenderer> renderer_;
};

// Both round to bytes, and weigh the four texels around a pixel with at least 8 bits: each is within 1.6 of
// exact (BackgroundTest), so that a background pixel may differ by 3, and by two roundings at random,
// sqrt(2 / 12) = 0.41 root mean square. Objects are drawn alike; put into texels, their outline may move by a
// fourteenth of a texel (EquirectCompositeGLTest), which at a contrast of 255 over 0.45 texels changes a
// pixel by 41. One pixel in 200 at most lies on an outline: sqrt(41^2 / 3 / 200 + 1 / 6) < 1.8 if
// displacements are uniform up to that. llvmpipe stays at 0.28 and 14, softpipe likewise.
TEST_F(Backends, DrawTheSameDives) {
    GameSession session(*config_);
    for (const double moment_s : {4.0, 11.0, 19.0}) {
        while (session.shown.time_s < moment_s) session.advance(1.0 / 60);
        environment_->update(session.shown.time_s, true);
        for (const int eyes : {1, 2})
            for (const Composition composition :
                 {Composition::BackgroundOnly, Composition::Plain, Composition::MatchedResolution,
                  Composition::VideoTexels, Composition::CameraResponse}) {
                const auto openGL = draw(session.shown, eyes, composition, Backend::OpenGL),
                           software = draw(session.shown, eyes, composition, Backend::Software);
                for (size_t eye = 0; eye < openGL.size(); ++eye) {
                    double sum = 0;
                    for (size_t k = 0; k < openGL[eye].pixels.size(); ++k)
                        sum += std::pow(openGL[eye].pixels[k] - software[eye].pixels[k], 2);
                    const bool intoTexels =
                        composition == Composition::VideoTexels || composition == Composition::CameraResponse;
                    const double rms = std::sqrt(sum / static_cast<double>(openGL[eye].pixels.size()));
                    const std::string what = std::to_string(moment_s) + " s, composition " +
                                             std::to_string(static_cast<int>(composition)) + ", eye " +
                                             std::to_string(eye) + " of " + std::to_string(eyes);
                    EXPECT_LE(rms, intoTexels ? 1.8 : 0.5) << what;
                    EXPECT_LE(greatestDifference(openGL[eye], software[eye]), intoTexels ? 41 : 3) << what;
                }
                if (eyes == 2 && composition != Composition::BackgroundOnly) {
                    EXPECT_NE(software[0].pixels, software[1].pixels);
                }
            }
    }
}

// The conversions are within 1 of each other, and each picture is rounded once more, or twice in texels.
TEST_F(Backends, ShowAFilmsPlanesAsItsPixels) {
    GameSession session(*config_);
    session.advance(1.0 / 60);
    const auto drawn = [&](Composition composition) {
        return draw(session.shown, 1, composition, Backend::OpenGL)[0];
    };
    const std::array compositions = {Composition::BackgroundOnly, Composition::VideoTexels};
    const std::array before = {drawn(compositions[0]), drawn(compositions[1])};
    keepPlanes();
    ASSERT_TRUE(environment_->player().frame().planes);
    for (size_t i = 0; i < before.size(); ++i)
        EXPECT_LE(greatestDifference(drawn(compositions[i]), before[i]), i == 0 ? 2 : 3);
}

int finishes = 0, planesSent = 0;
PFNGLBUFFERDATAPROC bufferData = nullptr;

// A card is sent each of the film's pictures once, in three planes, for both eyes, and nobody waits for it.
TEST_F(Backends, SendEachPictureOnceAndFinishNothing) {
    keepPlanes();
    drawBy(Composition::CameraResponse, Backend::OpenGL);
    draw({}, 2); // resolves the entry points
    const auto finish = epoxy_glFinish;
    epoxy_glFinish = [] { ++finishes; };
    bufferData = std::exchange(
        epoxy_glBufferData, +[](GLenum target, GLsizeiptr size, const void* data, GLenum usage) {
            planesSent += target == GL_PIXEL_UNPACK_BUFFER;
            bufferData(target, size, data, usage);
        });
    for (const auto& [time_s, planes] : {std::pair(1.0, 3), {1.0, 3}, {2.0, 6}}) {
        environment_->update(time_s, true);
        draw({}, 2);
        EXPECT_EQ(planesSent, planes) << time_s << " s";
    }
    EXPECT_EQ(finishes, 0);
    epoxy_glFinish = finish, epoxy_glBufferData = bufferData;
}

// Put into the video's texels objects are as bright as drawn over the picture: resampling keeps means but for
// outlines, of which a twentieth of all that the objects change is left.
TEST_F(Backends, ObjectsInTheTexelsAreAsBright) {
    const GameSession session = sessionAt(4);
    const ImageRgba8 nothing = draw(session.shown, 1, Composition::BackgroundOnly, Backend::OpenGL)[0],
                     over = draw(session.shown, 1, Composition::Plain, Backend::OpenGL)[0];
    for (const Composition composition : {Composition::MatchedResolution, Composition::VideoTexels}) {
        const ImageRgba8 within = draw(session.shown, 1, composition, Backend::OpenGL)[0];
        for (size_t c = 0; c < 3; ++c) {
            double brighter = 0, changed = 0;
            for (size_t i = c; i < over.pixels.size(); i += 4) {
                brighter += within.pixels[i] - over.pixels[i];
                changed += std::abs(over.pixels[i] - nothing.pixels[i]);
            }
            EXPECT_NEAR(brighter, 0, 0.05 * changed) << c;
        }
    }
}

// Shadows on the film stay with its picture while the view rests or turns a little, and are whole then; a new
// picture and a head that has turned farther see them as a renderer does that has drawn nothing before.
TEST_F(Backends, NoShadowIsOlderThanTheFilmsPicture) {
    ASSERT_TRUE(environment_->depth());
    GameSession session = sessionAt(11);
    const auto fresh = [&](Backend backend) {
        renderer_ = tests::valueOf(SceneRenderer::make(
            creatures_, {.detail = render::Detail::Lean,
                         .skip = render::SkippedPass::Bounce, // which follows from picture to picture
                         .compositor = {.composition = Composition::CameraResponse, .backend = backend}}));
    };
    for (const Backend backend : {Backend::OpenGL, Backend::Software}) {
        const game::Snapshot first = session.shown;
        session.advance(1.0 / 120);
        const game::Snapshot next = session.shown;
        game::Snapshot turned = next, aLittle = first;
        turned.worldFromView = glm::angleAxis(0.3f, glm::vec3(0, 1, 0)) * next.worldFromView;
        aLittle.worldFromView = glm::angleAxis(0.02f, glm::vec3(0, 1, 0)) * first.worldFromView;
        fresh(backend);
        const auto asItIs = draw(turned, 1);
        fresh(backend);
        const auto aLittleAsItIs = draw(aLittle, 1);
        fresh(backend);
        draw(first, 1);
        EXPECT_EQ(draw(aLittle, 1)[0].pixels, aLittleAsItIs[0].pixels);
        const auto rested = draw(next, 1);
        EXPECT_EQ(draw(turned, 1)[0].pixels, asItIs[0].pixels);
        session.advance(0.1);
        environment_->update(session.shown.time_s, true);
        const auto later = draw(session.shown, 1);
        fresh(backend);
        EXPECT_EQ(draw(session.shown, 1)[0].pixels, later[0].pixels);
        EXPECT_NE(rested[0].pixels, later[0].pixels);
    }
}

// A tracked hand may come to the eyes, where the near plane would cut it open: it has faded by then.
TEST_F(Backends, AHandAtTheEyesIsGone) {
    game::Snapshot shown;
    const ImageRgba8 nothing = draw(shown, 1)[0];
    game::HandView& hand = shown.hands[1];
    hand.visible = true;
    const auto differenceAt = [&](float away_m) { // that a hand makes there
        hand.joints = hands::reachingHand(config_->rig, hands::Side::Right, {0, 0, -away_m}, 0).joints;
        return greatestDifference(draw(shown, 1)[0], nothing);
    };
    EXPECT_GE(differenceAt(0.4f), 100);
    EXPECT_GT(differenceAt(0.15f), 0);
    for (const float away_m : {0.08f, 0.04f, 0.01f}) EXPECT_EQ(differenceAt(away_m), 0) << away_m;
}

// With a copy of the shaders, to change.
class ShaderReload : public Backends {
  protected:
    tests::ScratchFolder data_;

    void SetUp() override {
        namespace fs = std::filesystem;
        fs::copy(tests::sourceFolder() / "shaders", data_ / "shaders", fs::copy_options::recursive);
        for (const char* folder : {"content", "tests"})
            fs::create_directory_symlink(tests::sourceFolder() / folder, data_ / folder);
        setenv("SHOAL_DATA", data_.path().c_str(), 1);
        if (dataRoot() != data_.path())
            GTEST_SKIP() << "needs a process that has read no data yet, as in ctest";
        Backends::SetUp();
        if (renderer_) drawBy(Composition::Plain, Backend::OpenGL);
    }

    std::vector<uint8_t> picture(const game::Snapshot& shown) { return draw(shown, 1)[0].pixels; }
};

TEST_F(ShaderReload, KeepsTheLastThatWorked) {
    const GameSession session = sessionAt(4);
    const Path file = data_ / "shaders/render/Object.vert";
    const std::string good = readText(file).value();
    const std::vector<uint8_t> before = picture(session.shown);

    ASSERT_TRUE(writeFileWhole(file, good + "broken"));
    const Status broken = renderer_->reloadShaders();
    ASSERT_FALSE(broken);
    EXPECT_NE(broken.error().message().find("render/Object.vert"), std::string::npos);
    EXPECT_EQ(picture(session.shown), before);

    // Only fish need this variant: it is compiled when the first is drawn.
    ASSERT_TRUE(writeFileWhole(file, good + "#ifdef SKINNED\nbroken\n#endif\n"));
    EXPECT_TRUE(renderer_->reloadShaders());
    picture(session.shown);
    EXPECT_EQ(picture(session.shown), before);

    std::string moved = good;
    moved.replace(moved.rfind("gl_Position ="), 13, "gl_Position = 1.1 *");
    ASSERT_TRUE(writeFileWhole(file, moved));
    EXPECT_TRUE(renderer_->reloadShaders());
    EXPECT_NE(picture(session.shown), before);
}

TEST_F(Backends, TheGuideShowsASpeciesThatTheDiveLacks) {
    const game::SpeciesTable& all = config_->species;
    const std::vector<bool> there = game::speciesShown(all, config_->dive);
    const auto lacking = static_cast<size_t>(std::ranges::find(there, false) - there.begin());
    ASSERT_LT(lacking, all.size());
    const float before = creatures_.minRoughness();
    const float extent =
        tests::valueOf(creatures_.add(all, lacking, reflectanceIn({}), render::Detail::Lean));
    EXPECT_EQ(creatures_.minRoughness(), before) << "the light would be made anew";
    const game::Snapshot nothing;
    const ImageRgba8 sea = draw(nothing, 1)[0];
    const glm::vec2 tanHalf = std::tan(glm::radians(65.0f) / 2) * glm::vec2(kSize.x / 360.0f, 1);
    GuideAnimal guide;
    const ImageRgba8 with =
        draw(guide.show(nothing, static_cast<int>(lacking), all[lacking], extent, tanHalf, 0, false), 1)[0];
    std::array<int, 2> changed{}; // pixels left and right of the middle
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x)
            changed[2 * x >= kSize.x] += !std::equal(sea.at(x, y), sea.at(x, y) + 3, with.at(x, y));
    EXPECT_GT(changed[1], kSize.x * kSize.y / 50);
    EXPECT_LT(changed[0], changed[1] / 10) << "the page is there";
}

// A hand's textures take megabytes.
TEST(CreatureModels, BothHandsShareTexturesAndBothArms) {
    const auto context = platform::Headless::open();
    if (!context) GTEST_SKIP() << context.error().message();
    const auto count = [] {
        int textures = 0;
        for (GLuint name = 1; name < 10'000; ++name) textures += glIsTexture(name);
        return textures;
    };
    const int before = count();
    const auto four = tests::valueOf(CreatureModels::load({}, {}, "", {}, render::Detail::Lean));
    const int ofFour = count() - before;
    std::vector<render::ModelGpu> two;
    for (const char* name : {"hand_left.glb", "arm_left.glb"}) {
        const auto model = tests::valueOf(scene::loadModel(dataRoot() / "content/models" / name));
        two.push_back(render::uploadModel(model, {}, render::Detail::Lean));
    }
    EXPECT_EQ(ofFour, count() - before - ofFour);
}

} // namespace
} // namespace shoal::app
