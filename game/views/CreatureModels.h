// Posed models of what a snapshot shows: creatures by species, two hands, and their arms. The thread of the
// OpenGL context.
#pragma once

#include "engine/core/Files.h"
#include "engine/render/ModelGpu.h"
#include "engine/render/ObjectPass.h"
#include "engine/scene/LoadModel.h"
#include "engine/scene/Spine.h"
#include "engine/scene/Surface.h"
#include "game/rules/DiveFile.h"
#include "game/rules/Snapshot.h"
#include "game/views/AnimalLight.h"
#include "game/views/ArmPose.h"

#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shoal::app {

class CreatureModels {
  public:
    // The models of the species that are shown, by index into the table; of hands and arms. handVariant: a
    // variant of both hands' models, such as "glove". Needs a current GL context.
    // progress: called between two models with the share that is done; false: stop.
    static Result<CreatureModels> load(const game::SpeciesTable& species, const std::vector<bool>& shown,
                                       const std::string& handVariant, render::Reflectance reflectance,
                                       render::Detail detail,
                                       const std::function<bool(float)>& progress = {});
    render::Reflectance reflectance() const { return reflectance_; }
    const std::vector<bool>& shownSpecies() const { return shown_; }
    const std::string& handVariant() const { return handVariant_; }

    float minRoughness() const { return minRoughness_; } // of all surfaces

    // Poses every creature and visible hand of the snapshot and adds them to the pass.
    void show(const game::Snapshot& snapshot, const AnimalLight& light, render::ObjectPass& pass);

  private:
    struct ModelInstance {
        scene::Model model;
        render::ModelGpu gpu;
        scene::Pose pose, wave; // the whole body; its spine, at another time of the animation
        scene::Spine spine;
        std::array<scene::TailBeat, game::kMotionNames.size()> beats{}; // by Motion
        std::array<int, 2> pectorals{-1, -1};                           // nodes: left, right fin
        render::BodyOccluders body;
        float length_m = 1;                                      // of the rest pose along z
        std::array<int, game::kMotionNames.size()> animations{}; // by Motion; -1: the model has no such clip
        std::vector<int> jointNodes;                             // of the request's joints
        std::vector<scene::NodeSphere> boundingSpheres;
    };
    static void pose(const game::CreatureView& creature, ModelInstance& instance);
    struct ModelRequest {
        Path file;
        ModelInstance* into;
        std::string variant;                      // of the materials; empty: as it is
        std::span<const std::string_view> joints; // that it must have, posed in the world: hands and arms
        bool onItself = false;                    // its parts take light from each other
    };
    // On any thread; lacks what upload() makes.
    static Result<ModelInstance> readInstance(const ModelRequest&, render::Reflectance reflectance);
    void upload(ModelInstance& instance, render::Reflectance reflectance, render::Detail detail);
    // Of an instance whose joints already stand in the world. margin: of its bounding spheres.
    void showPosed(ModelInstance& instance, float margin, render::ObjectPass& pass);

    float minRoughness_ = 1;
    render::Reflectance reflectance_ = render::Reflectance::Coded;
    std::string handVariant_;
    std::vector<bool> shown_;
    std::vector<ImageRgba8> lastImages_; // of the model loaded before this, while loading
    std::shared_ptr<const render::TexturesGpu> lastTextures_;
    std::vector<ModelInstance> species_;        // by index into the species table; empty ones are not shown
    std::array<ModelInstance, 2> hands_, arms_; // left, right
    std::vector<scene::Sphere> spheres_;        // scratch
};

} // namespace shoal::app
