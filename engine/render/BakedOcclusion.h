// What a body hides of light, found once with more rays and a better fit than loading has time for, and kept
// in a file beside its model.
#pragma once

#include "engine/core/Files.h"
#include "engine/occlusion/FitEllipsoids.h"
#include "engine/render/BodyOccluders.h"
#include "engine/scene/Model.h"

#include <string>
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

// Fails where it is none: out of range, or not as long as it says. Self-occlusion is kept to 1/250.
Result<BakedOcclusion> parseBakedOcclusion(std::string_view text);
Result<BakedOcclusion> readBakedOcclusion(const Path& file);
std::string written(const BakedOcclusion& baked);

// What bakeSelfOcclusion() and bakeSelfOcclusionBesideOwn() have left in the model.
BakedOcclusion bakedOcclusionOf(const scene::Model& model, std::vector<occlusion::BodyPart> parts);

// Gives the model its self-occlusion. False, and nothing changed, if the baked is another model's.
bool applyBakedOcclusion(const BakedOcclusion& baked, scene::Model& model);

// A model's self-occlusion, found by rays from its surface.

// Fills Primitive::self-occlusion of every mesh, as it hides itself in this pose, which should be the rest
// pose: self-occlusion go with the joints that move them. What is blended neither hides nor self-occlusion.
// Meshes hung up more than once keep what the last place says. Not where a material brings a map of its
// occlusion. rays: from each of three points in a triangle.
void bakeSelfOcclusion(scene::Model& model, const scene::Pose& rest, int rays);

// Likewise Primitive::selfOcclusionBesideOwn, which take the place of the others once the body's own parts
// count in full (BodyOccluders.h): in a pose so bent.
void bakeSelfOcclusionBesideOwn(scene::Model& model, const scene::Pose& bent, const BodyOccluders& body,
                                int rays);

} // namespace shoal::render
