// Draws snapshots of a dive: creatures, hands, particles and shadows in the light of the environment,
// composed with its picture. The thread of the OpenGL context only.
#pragma once

#include "engine/render/Compositor.h"
#include "engine/render/FilmShadows.h"
#include "engine/render/FloorShadowPass.h"
#include "engine/render/ObjectPass.h"
#include "engine/render/ParticlePass.h"
#include "game/views/AnimalLight.h"
#include "game/views/CreatureModels.h"
#include "game/views/Environment.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace shoal::app {

struct SceneRendererSetup {
    render::Detail detail = render::Detail::Full;
    bool particles = true; // particles drift in the water, where there is water
    bool shadows =
        true; // on what the film shows, where its distances are known and the environment finds lights
    bool floorShadows = false; // on the floor of the player's room
    bool occlusion = true;     // between bodies
    render::ShownQuantity shown = render::ShownQuantity::Light;
    render::SkippedPass skip = render::SkippedPass::None;
    render::CompositorSetup compositor;
};

class SceneRenderer final : private render::CompositorScene {
  public:
    static Result<SceneRenderer> make(CreatureModels creatureModels, const SceneRendererSetup& setup);

    // To give them to another renderer; this one draws no more.
    CreatureModels takeModels() { return std::move(creatureModels_); }

    // Compiles all shaders anew from their files, between two frames. Where one is broken the error says so
    // and the last good ones stay, even if that shows only when an object first needs it.
    Status reloadShaders();

    // Once a frame, before draw(), after timers().beginFrame(); the environment must live until then.
    void set(const game::Snapshot& snapshot, const Environment& environment, const render::Exposure& exposure,
             render::Glossy glossy = render::Glossy::Prefiltered);

    struct Eye {
        int eye = 0; // 0 left, 1 right
        render::View view;
        const gl::Target& canvas;
        render::Surroundings surroundings = render::Surroundings::Film;
        std::optional<float> floor_m{}; // height of the room's floor, world; empty: it is not known
    };
    // Into each eye's canvas. afterEye is called when an eye's picture is complete, with its canvas bound.
    Status draw(std::span<const Eye> eyes, const render::Compositor::AfterEye& afterEye = {});

    // The depth of what was just drawn for this eye, into a framebuffer with depth: objects and film; where
    // that of the film is not known, the far plane's.
    Status drawDepth(const Eye& eye, uint32_t into) {
        return passes_.compositor.drawDepth(pictureOf(eye), into);
    }

    // Over what is in the canvas, which has depth: no background, no shadows.
    Status drawObjectsAlone(const Eye& eye);

    gl::PassTimers& timers() override { return timers_; }
    int drawCount() const;
    int triangleCount() const { return passes_.objects.triangleCount(); }

  private:
    struct Passes { // what has shaders
        render::ObjectPass objects;
        std::optional<render::ParticlePass> particles;
        std::optional<render::FloorShadowPass> floorShadows;
        render::Compositor compositor;
    };
    static Result<Passes> makePasses(const SceneRendererSetup& setup);
    SceneRenderer(CreatureModels creatureModels, const SceneRendererSetup& setup, Passes passes)
        : creatureModels_(std::move(creatureModels)), setup_(setup), passes_(std::move(passes)) {}
    bool castsShadows() const;
    std::optional<render::CastingLight> castingLight() const;
    void castShadows();
    void castOnFloor(std::optional<float> floor_m);
    glm::vec3 eyeInFilm(const render::View& view) const;
    render::EyePicture pictureOf(const Eye& eye) const;
    water::Water waterAround(const render::EyePicture& picture) const;
    render::View filmedFrom(const render::EyePicture& picture) const;
    Status drawObjects(const render::EyePicture& picture) override;
    Status drawParticles(render::ParticlePass::On on, const render::EyePicture& picture) override;
    std::span<const scene::Sphere> visibleSpheres(const render::View& view) override;

    CreatureModels creatureModels_;
    AnimalLight animalLight_;
    SceneRendererSetup setup_;
    Passes passes_;
    std::optional<Passes> beforeReload_;
    gl::PassTimers timers_;
    const Environment* environment_ = nullptr; // of the frame
    render::Exposure exposure_;
    render::Glossy glossy_ = render::Glossy::Prefiltered;
    std::vector<render::EyePicture> pictures_; // scratch
    std::vector<render::View> filmed_;         // scratch: where each is filmed from
    // Of the film, or of each eye's.
    std::array<render::FilmShadows, 2> shadows_;
    struct Filmed { // what they were cast on
        const depth::DepthMap* map = nullptr;
        uint64_t frame = 0;
        std::vector<render::View> from;
    } shadowsOn_;
    std::vector<scene::Sphere> spheres_; // scratch
    bool floorIsShaded_ = false;         // in this frame
    double time_s_ = 0;
    glm::vec3 headWorld_{0};
};

} // namespace shoal::app
