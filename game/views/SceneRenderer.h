// Draws snapshots of a dive: creatures, hands, particles and shadows in the light of the environment,
// composed with its picture. The thread of the OpenGL context only.
#pragma once

#include "engine/core/ThreadPool.h"
#include "engine/render/Compositor.h"
#include "engine/render/FilmShadows.h"
#include "engine/render/FloorShadowPass.h"
#include "engine/render/ObjectPass.h"
#include "engine/render/ParticlePass.h"
#include "game/views/ArmPose.h"
#include "game/views/CreatureModels.h"
#include "game/views/Environment.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace shoal::app {

struct SceneRendererSetup {
    render::Detail detail = render::Detail::Full;
    bool shadows = true;       // on the film's surfaces, if it has distances and its environment finds lights
    bool floorShadows = false; // on the floor of the player's room
    bool occlusion = true;     // ambient occlusion between bodies
    render::ShownQuantity shown = render::ShownQuantity::Light;
    render::SkippedPass skip = render::SkippedPass::None;
    render::CompositorSetup compositor;

    bool operator==(const SceneRendererSetup&) const = default;
};

// Settings that may change from one frame to the next, without new passes.
struct Look {
    render::Exposure exposure;
    render::Glossy glossy = render::Glossy::Prefiltered;
    bool particles = true;        // particles drift in the water, if there is water
    float lamp = 0;               // game::DiveFile::lamp
    std::optional<Head> player{}; // whose arms are drawn; empty: the viewer's
};

class SceneRenderer final : private render::CompositorScene {
  public:
    // The models must outlive this.
    static Result<SceneRenderer> make(CreatureModels& creatureModels, const SceneRendererSetup& setup) {
        auto passes = makePasses(setup);
        if (!passes) return passes.error();
        return SceneRenderer(creatureModels, setup, std::move(*passes));
    }

    // Compiles all shaders again from their files, between two frames. If one is broken the error says so and
    // the last good ones stay, even if that shows only when an object first needs it.
    Status reloadShaders();

    // Sets a frame's content, after timers().beginFrame(); the environment must live until draw().
    void set(const game::Snapshot& snapshot, const Environment& environment, const Look& look);

    struct Eye {
        int eye = 0; // 0 left, 1 right
        render::View view;
        const gl::Target& canvas;
        render::Surroundings surroundings = render::Surroundings::Film;
        std::optional<float> floor_m{}; // height of the room's floor, world frame; empty: unknown
    };
    // Draws into each eye's canvas; calls afterEye when a picture is complete, with its canvas bound.
    Status draw(std::span<const Eye> eyes, const render::Compositor::AfterEye& afterEye = {});

    // Draws the depth of this eye's last picture, objects and film, into a framebuffer with depth. A film of
    // unknown depth gets the far plane's.
    Status drawDepth(const Eye& eye, uint32_t into) {
        return passes_.compositor.drawDepth(pictureOf(eye), into);
    }

    // Draws the objects over the canvas, which has depth: no background, no shadows.
    Status drawObjectsAlone(const Eye& eye) {
        eye.canvas.bind();
        glDepthMask(GL_TRUE);
        glClear(GL_DEPTH_BUFFER_BIT);
        return drawObjects(pictureOf(eye));
    }

    const SceneRendererSetup& setup() const { return setup_; }
    gl::PassTimers& timers() { return timers_; }
    int drawCount() const {
        return passes_.objects.drawCount() + 1 + (look_.particles ? 1 : 0) +
               (passes_.floorShadows && !passes_.floorShadows->empty() ? 1 : 0);
    }
    int triangleCount() const { return passes_.objects.triangleCount(); }

  private:
    struct Passes { // all passes with shaders
        render::ObjectPass objects;
        render::ParticlePass particles;
        std::optional<render::FloorShadowPass> floorShadows;
        render::Compositor compositor;
    };
    static Result<Passes> makePasses(const SceneRendererSetup& setup);
    SceneRenderer(CreatureModels& creatureModels, const SceneRendererSetup& setup, Passes passes)
        : creatureModels_(&creatureModels), setup_(setup), passes_(std::move(passes)) {}
    bool castsShadows() const { // not where no lights have been looked for, or where there is no light
        return passes_.compositor.drawsObjects() && setup_.skip != render::SkippedPass::Shadows &&
               environment_->player().shadowLight().groundIrradiance != glm::vec3(0);
    }
    render::CastingLight castingLight() const;
    void castShadows();
    void setShadows();
    void finishShadows() override;
    void castOnFloor(std::optional<float> floor_m);
    glm::vec3 eyeInFilm(const render::View& view) const;
    render::EyePicture pictureOf(const Eye& eye);
    water::Water waterAround(const render::EyePicture& picture) const { // none in the player's room
        return picture.surroundings == render::Surroundings::Room ? water::Water()
                                                                  : environment_->player().water();
    }
    render::View filmedFrom(const render::EyePicture& picture) const;
    Status drawObjects(const render::EyePicture& picture) override;
    Status drawParticles(render::ParticlePass::On on, const render::EyePicture& picture) override;
    std::span<const scene::Sphere> visibleSpheres(const render::View& view) override;

    CreatureModels* creatureModels_;
    AnimalLight animalLight_;
    SceneRendererSetup setup_;
    Passes passes_;
    std::optional<Passes> beforeReload_;
    gl::PassTimers timers_;
    const Environment* environment_ = nullptr; // of the present frame
    Look look_;
    std::vector<render::EyePicture> pictures_; // scratch
    std::vector<render::View> filmed_;         // scratch: views in the film
    // Shadows on the film, or on each eye's film, and the input of the thread that casts them.
    struct Shadows {
        void operator()(int number); // casts those on one film
        bool isRunning = false;
        std::array<render::FilmShadows, 2> cast;
        int films = 1; // number of those that count
        uint64_t frame = 0;
        render::FilmSurface film;
        std::vector<render::View> from; // widened
        render::FrameCoding coding = render::FrameCoding::Srgb;
        water::Water water;
        std::array<render::CastingLight, 2> lights; // the strongest, and all other light
        const render::ObjectPass* objects = nullptr;
        ThreadPool thread{1}; // last: it uses all of the above
    };
    std::unique_ptr<Shadows> shadows_ = std::make_unique<Shadows>(); // at an address that stays
    std::vector<scene::Sphere> spheres_;                             // scratch
    double time_s_ = 0;
    glm::vec3 headWorld_{0};
};

} // namespace shoal::app
