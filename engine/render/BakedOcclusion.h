// What a body hides of light, found once with more rays and a better fit than loading has time for, and kept
// in a file beside its model. content/make/models/make_occlusion makes these files.
#pragma once

#include "engine/core/Files.h"
#include "engine/occlusion/Ellipsoid.h"
#include "engine/scene/Model.h"

#include <span>
#include <string_view>
#include <vector>

namespace shoal::render {

struct BakedOcclusion {
    uint64_t skin = 0;                      // skinHash() of the model that it is of
    std::vector<occlusion::BodyPart> parts; // model frame, at rest; joint: the node that carries it
    // Primitive::selfOcclusion and selfOcclusionBesideOwn, in the model's order. Both are empty for a body
    // that is to be traced when it is loaded.
    std::vector<glm::vec4> selfOcclusion, besideOwn;
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

// Gives the model its self-occlusion, where there is any. False, and nothing changed, if the baked is another
// model's.
bool applyBakedOcclusion(const BakedOcclusion& baked, scene::Model& model);

// Fills the selfOcclusion of every mesh by rays from its surface, as it hides itself in this pose; it goes
// with the joints that move it. What is blended neither hides nor takes. rays: from each of three points in a
// triangle.
void bakeSelfOcclusion(scene::Model& model, const scene::Pose& pose, int rays);

// Keeps what was traced on the model's surface in this pose. Of a mesh that several nodes show, the last
// one's is kept. Not where a material brings a map of its occlusion. kept: selfOcclusionBesideOwn takes the
// place of selfOcclusion once the body's own parts count in full (BodyOccluders.h).
void keepSelfOcclusion(scene::Model& model, const scene::Pose& pose, std::span<const glm::vec4> traced,
                       std::vector<glm::vec4> scene::Primitive::*kept);

} // namespace shoal::render
