// The models that play the snapshot's parts: creatures by species, and two hands.
#pragma once

#include "engine/core/Files.h"
#include "engine/render/ModelGpu.h"
#include "engine/render/ObjectPass.h"
#include "engine/scene/LoadModel.h"
#include "engine/scene/Reach.h"
#include "engine/scene/Silhouette.h"
#include "engine/scene/Spine.h"
#include "game/Snapshot.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace shoal::app {

class Cast {
  public:
    // One model file per species, in the species table's order; handLook: a variant of both hands' models,
    // such as "glove". Needs a current GL context.
    static Result<Cast> load(std::span<const Path> speciesModels, const Path& leftHand, const Path& rightHand,
                             const std::string& handLook, render::Reflectance reflectance,
                             render::Detail detail);

    float leastRoughness() const { return leastRoughness_; } // of all surfaces

    std::vector<scene::Silhouette> silhouettes() const; // by species

    // Poses every creature and visible hand of the snapshot and adds them to the pass.
    void show(const game::Snapshot& snapshot, render::ObjectPass& pass);

  private:
    struct Actor {
        scene::Model model;
        render::ModelGpu gpu;
        scene::Pose pose, wave; // the whole body; its spine, at another time of the clip
        scene::Spine spine;
        std::array<scene::Beat, game::kMotionNames.size()> beats{}; // by Motion
        std::array<int, 2> pectorals{-1, -1};                       // nodes: left, right
        scene::Silhouette silhouette;
        render::BodyOccluders body;
        float length_m = 1;                                      // of the rest pose along z
        std::array<int, game::kMotionNames.size()> animations{}; // by Motion; -1: the model has no such clip
        std::array<int, hands::kJointCount> jointNodes{};        // hands only
        std::vector<scene::NodeReach> reach;
    };
    static void pose(const game::CreatureView& creature, Actor& actor);
    struct Wish {
        Path file;
        std::string look;                // a variant of the model; empty: as it is
        std::optional<hands::Side> side; // hands only
    };
    // On any thread; lacks what upload() makes.
    static Result<Actor> readActor(const Wish&, render::Reflectance reflectance);
    // What is not found beside the model: its ellipsoids and folds.
    static Status findShade(const Wish&, Actor& actor);
    void upload(Actor& actor, render::Reflectance reflectance, render::Detail detail);

    float leastRoughness_ = 1;
    std::vector<ImageRgba8> lastImages_; // of the model loaded before this, while loading
    std::shared_ptr<const render::TexturesGpu> lastTextures_;
    std::vector<Actor> species_;
    std::array<Actor, 2> hands_;
    std::vector<scene::Ball> balls_; // scratch
};

} // namespace shoal::app
