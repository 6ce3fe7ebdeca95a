// Makes the baked occlusion of creatures and hands (engine/render/BakedOcclusion.h).
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

// Fits ellipsoids that hide what the skin hides from places around it, with the hand open and closing. Takes
// seconds.
std::vector<occlusion::BodyPart> fitHand(const Hand& hand);

// Returns the ellipsoids of the other hand, whose joints are the same nodes.
std::vector<occlusion::BodyPart> mirrored(std::vector<occlusion::BodyPart> parts);

// Traces the hand's self-occlusion at rest, and half closed beside these ellipsoids. Takes seconds.
render::BakedOcclusion selfOccludeHand(const Hand& hand, const std::vector<occlusion::BodyPart>& parts);

// Makes the ellipsoids and self-occlusion of a creature that bends softly, of an arm, or of any other glTF
// model. Takes seconds.
Result<render::BakedOcclusion> fitCreature(const Path& model);

// Returns the text of its file, in which self-occlusion is rounded to 1 / kSelfOcclusionSteps.
std::string written(const render::BakedOcclusion& baked);

} // namespace shoal::make
