// What a body hides of light, found once with more rays and a better fit than loading has time for, and kept
// in a file beside its model.
#pragma once

#include "engine/core/Files.h"
#include "engine/occlusion/FitEllipsoids.h"
#include "engine/scene/Model.h"

#include <string>
#include <string_view>
#include <vector>

namespace shoal::render {

struct BakedShade {
    uint64_t skin = 0;                       // skinHash() of the model that it is of
    std::vector<occlusion::BodyPart> parts;  // model frame, at rest; joint: the node that carries it
    std::vector<glm::vec4> folds, besideOwn; // Primitive::folds and foldsBesideOwn, in the model's order
};

// Of all that the folds and ellipsoids of a model come from, as its file has it.
uint64_t skinHash(const scene::Model& model);

// hand.glb has hand.shade.json.
Path shadeBeside(const Path& model);

// Fails where it is none: out of range, or not as long as it says. Folds are kept to 1/250.
Result<BakedShade> parseShade(std::string_view text);
Result<BakedShade> readShade(const Path& file);
std::string written(const BakedShade& shade);

// What foldModel() and foldBesideOwn() have left in the model.
BakedShade shadeOf(const scene::Model& model, std::vector<occlusion::BodyPart> parts);

// Gives the model its folds. False, and nothing changed, if the shade is another model's.
bool wearShade(const BakedShade& shade, scene::Model& model);

} // namespace shoal::render
