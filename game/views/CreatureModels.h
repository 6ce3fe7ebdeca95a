// Loads, poses and lights the models of creatures, hands and arms. Only on the OpenGL context's thread.
#pragma once

#include "engine/core/Files.h"
#include "engine/depth/Caustics.h"
#include "engine/depth/LightDifference.h"
#include "engine/light/FindLights.h"
#include "engine/render/BakedOcclusion.h"
#include "engine/render/ModelGpu.h"
#include "engine/render/ObjectPass.h"
#include "engine/scene/Model.h"
#include "engine/scene/Spine.h"
#include "engine/scene/Surface.h"
#include "game/rules/DiveFile.h"
#include "game/rules/Snapshot.h"
#include "game/views/ArmPose.h"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shoal::app {

// Gives a model its baked self-occlusion and returns its ellipsoids. Reads both from beside the file or from
// the player's cache folder; otherwise has shoal-occlusion make them, which takes seconds, and caches them.
// If that fails, logs it and returns nothing. Any thread.
std::optional<render::BakedOcclusion> occlusionOf(const Path& file, scene::Model& model);

// A small lamp above the diver's eyes, so close to them that they see none of its shadows. It lights animals,
// things and hands, but not the film.
struct DiverLamp {
    float radiance = 0;            // game::DiveFile::lamp
    glm::vec3 attenuation_perM{0}; // of the water between the lamp and what it lights
};

// The light that waves focus on the film's ground. The pointers are null if the film shows none.
struct FocusedLight {
    const depth::Caustics* caustics = nullptr;
    const depth::DepthMap* map = nullptr;     // of the same frame
    const light::ShadowLight* from = nullptr; // the source that the waves focus
};

// Computes how the light at each animal differs from the light at the camera: rock near the animal changes
// it, smoothed over time, and waves and the lamp add to it. Only on the rendering thread.
class AnimalLight {
  public:
    // Updates the light of all animals; call once for each picture. About as often as the film's light
    // changes, it looks up the film's light at a few animals in turn and the waves' light at all. An animal's
    // light eases to what was looked up with a time constant of 0.25 s. light: null for a film without
    // distances. Allocates nothing once it has grown.
    void follow(const game::Snapshot& snapshot, const depth::LightDifference* light,
                const glm::mat3& envFromWorld, const DiverLamp& lamp = {}, const FocusedLight& focused = {});

    // Returns the light by index in Snapshot::creatures.
    const depth::LightHarmonics& of(size_t creature) const { return animals_[creature].lit; }

    // Returns the lamp's light alone at a place, world frame. Diffuse shading with these nine harmonics errs
    // by at most 3/32 of the light that a surface facing the lamp reflects.
    depth::LightHarmonics ofLamp(const glm::vec3& place) const;

  private:
    struct Animal {
        glm::vec3 position{0};
        depth::LightHarmonics found{}, now{}; // film's light less that at the camera: looked up, and eased
        depth::LightHarmonics waves{};
        depth::LightHarmonics lit{}; // sum of `now`, the waves' light and the lamp's
    };
    std::vector<Animal> animals_;
    DiverLamp lamp_;
    glm::vec3 lampWorld_{0};
    glm::mat3 envFromWorld_{1};
    size_t next_ = 0; // index of the next animal to look up
    double time_s_ = 0;
    float sinceLookUp_s_ = 0;
};

class CreatureModels {
  public:
    // Loads the models of the species shown, by index into the table, and of hands and arms. handVariant: a
    // material variant of both hands' models, such as "glove". progress: called after each model with the
    // share done; false stops. Needs a current GL context.
    static Result<CreatureModels> load(const game::SpeciesTable& species, const std::vector<bool>& shown,
                                       const std::string& handVariant, render::Reflectance reflectance,
                                       render::Detail detail,
                                       const std::function<bool(float)>& progress = {});

    // Loads the model of one more species, unless it is loaded. Keeps minRoughness(), so that the light need
    // not be filtered again. Returns the model's greatest size along any axis, in lengths.
    Result<float> add(const game::SpeciesTable& species, size_t which, render::Reflectance reflectance,
                      render::Detail detail);

    float minRoughness() const { return minRoughness_; } // least roughness of all surfaces

    // Poses every creature and visible hand of the snapshot, with the player's arms; adds them to the pass.
    void show(const game::Snapshot& snapshot, const Head& player, const AnimalLight& light,
              render::ObjectPass& pass);

  private:
    struct ModelInstance {
        scene::Model model;
        render::ModelGpu gpu;
        scene::Pose pose, wave; // pose: body at the clip's time; wave: spine at the tail beat's time
        scene::Spine spine;
        std::array<scene::TailBeat, game::kMotionNames.size()> beats{}; // tail beat of each clip, by Motion
        std::array<int, 2> pectorals{-1, -1};                           // nodes: left, right fin
        render::BodyOccluders body;
        float length_m = 1;                                      // length of the rest pose along z
        float extent = 1;                                        // greatest size along any axis, in lengths
        std::array<int, game::kMotionNames.size()> animations{}; // by Motion; -1: the model has no such clip
        std::vector<int> jointNodes;                             // nodes of the request's joints
        std::vector<scene::NodeSphere> boundingSpheres;
    };
    static void pose(const game::CreatureView& creature, ModelInstance& instance);
    struct ModelRequest {
        Path file;
        ModelInstance* into;
        std::string variant;                      // material variant; empty: the default
        std::span<const std::string_view> joints; // joints that a hand or an arm must have
        bool occludesItself = false;              // its parts occlude each other
        glm::vec3 colour{1};                      // multiplies the materials' colours
        bool isArm = false;
    };
    // Reads a model on any thread, without what upload() makes.
    static Result<ModelInstance> readInstance(const ModelRequest&, render::Reflectance reflectance);
    void upload(ModelInstance& instance, render::Reflectance reflectance, render::Detail detail,
                bool isArm = false);
    // Adds an instance whose joints are posed in the world. margin: factor on its bounding spheres.
    void showPosed(ModelInstance& instance, float margin, const depth::LightHarmonics& light,
                   render::ObjectPass& pass, float opacity = 1, float highlight = 0);

    float minRoughness_ = 1;
    std::vector<ImageRgba8> lastImages_; // images of the last model loaded, while loading
    std::shared_ptr<const render::TexturesGpu> lastTextures_;
    std::vector<ModelInstance> species_;        // by index into the species table; empty if not shown
    std::array<ModelInstance, 2> hands_, arms_; // left, right
    std::vector<scene::Sphere> spheres_;        // scratch
};

} // namespace shoal::app
