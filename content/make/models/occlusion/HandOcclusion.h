// What the game's own creatures and hands hide of light (engine/render/BakedOcclusion.h).
#pragma once

#include "engine/render/BakedOcclusion.h"
#include "input/hands/HandRig.h"

#include <string>
#include <vector>

namespace shoal::make {

struct Hand {
    scene::Model model;
    scene::Pose rest;
    hands::HandRig rig;
    hands::Side side{};

    scene::Pose closed(const hands::HandShape& shape) const; // the wrist at the origin
};

// models: the folder of hand_left.glb, hand_right.glb and hand_skeleton.json.
Result<Hand> loadHand(const Path& models, hands::Side side);

// The ellipsoids that hide what the skin hides from places around it, open and closing. Seconds.
std::vector<occlusion::BodyPart> fitHand(const Hand& hand);

// Of the other hand, whose joints are the same nodes.
std::vector<occlusion::BodyPart> mirrored(std::vector<occlusion::BodyPart> parts);

// TraceSelfOcclusion at rest, and half closed beside these ellipsoids. Seconds.
render::BakedOcclusion selfOccludeHand(Hand hand, const std::vector<occlusion::BodyPart>& parts);

// The ellipsoids of a creature that bends softly, or of an arm; its self-occlusion is traced when it is
// loaded.
Result<render::BakedOcclusion> fitCreature(const Path& model);

// As its file holds it; self-occlusion to 1 / kSelfOcclusionSteps.
std::string written(const render::BakedOcclusion& baked);

} // namespace shoal::make
