// What a body hides of light, found once with more rays and a better fit than loading has time for, and kept
// in a file beside its model.
#pragma once

#include "engine/core/Files.h"
#include "engine/occlusion/EllipsoidOcclusion.h"
#include "engine/occlusion/FitEllipsoids.h"
#include "engine/scene/Model.h"

#include <span>
#include <string_view>
#include <vector>

namespace shoal::render {

struct BakedOcclusion {
    uint64_t skin = 0;                      // skinHash() of the model that it is of
    std::vector<occlusion::BodyPart> parts; // model frame, at rest; joint: the node that carries it
    std::vector<glm::vec4> selfOcclusion,
        besideOwn; // Primitive::self-occlusion and selfOcclusionBesideOwn, in the model's order
};

// Of all that the self-occlusion and ellipsoids of a model come from, as its file has it.
uint64_t skinHash(const scene::Model& model);

// hand.glb has hand.occlusion.json.
Path bakedOcclusionBeside(const Path& model);

constexpr double kSelfOcclusionSteps = 250;  // of 1, in the file: a tenth of what rays leave open
constexpr int kMaxSelfOcclusionSteps = 2000; // either way: what is hidden is whole long before

// Fails where it is none: out of range, or not as long as it says.
Result<BakedOcclusion> parseBakedOcclusion(std::string_view text);
Result<BakedOcclusion> readBakedOcclusion(const Path& file);

// Gives the model its self-occlusion. False, and nothing changed, if the baked is another model's.
bool applyBakedOcclusion(const BakedOcclusion& baked, scene::Model& model);

// Fills a self-occlusion of every mesh by rays from its surface, as it hides itself in this pose; it goes
// with the joints that move it. What is blended neither hides nor takes. Meshes hung up more than once keep
// what the last place says. Not where a material brings a map of its occlusion. rays: from each of three
// points in a triangle. kept: by default in the rest pose; selfOcclusionBesideOwn takes its place once the
// body's own parts count in full (BodyOccluders.h), so is of a pose so bent, and beside those parts.
void bakeSelfOcclusion(scene::Model& model, const scene::Pose& pose, int rays,
                       std::vector<glm::vec4> scene::Primitive::*kept = &scene::Primitive::selfOcclusion,
                       std::span<const occlusion::Occluder> own = {});

} // namespace shoal::render
