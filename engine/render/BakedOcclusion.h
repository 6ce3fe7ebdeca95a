// Baked occlusion of a model: ellipsoids for the light that it hides from others, and self-occlusion for the
// light that it hides from itself. Kept in a file, which shoal-occlusion makes
// (content/make/models/occlusion).
#pragma once

#include "engine/core/Files.h"
#include "engine/occlusion/Ellipsoid.h"
#include "engine/scene/Model.h"

#include <string_view>
#include <vector>

namespace shoal::render {

struct BakedOcclusion {
    uint64_t skin = 0;                      // skinHash() of the model that it belongs to
    std::vector<occlusion::BodyPart> parts; // model frame, at rest; joint: the node that carries it
    // Primitive::selfOcclusion and selfOcclusionBesideOwn, one for each vertex in the model's order.
    // besideOwn is empty for a body whose parts do not occlude each other.
    std::vector<glm::vec4> selfOcclusion, besideOwn;
};

// Returns a hash of the meshes and skins, as read from the model's file, from which occlusion is baked.
uint64_t skinHash(const scene::Model& model);

// Returns hand.occlusion.json for hand.glb.
Path bakedOcclusionBeside(const Path& model);

constexpr double kSelfOcclusionSteps = 250;  // integers in the file per 1; one is a tenth of the rays' error
constexpr int kMaxSelfOcclusionSteps = 2000; // largest magnitude; total occlusion needs fewer

// Both fail if a value is out of range or a list is cut short.
Result<BakedOcclusion> parseBakedOcclusion(std::string_view text);
Result<BakedOcclusion> readBakedOcclusion(const Path& file);

// Gives the model's primitives their self-occlusion; a primitive that has none keeps an empty list. Returns
// false, and changes nothing, if the baked occlusion is another model's.
bool applyBakedOcclusion(const BakedOcclusion& baked, scene::Model& model);

} // namespace shoal::render
