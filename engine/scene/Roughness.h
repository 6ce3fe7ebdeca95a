// How smooth a model's surfaces are: what light has to be made for them.
#pragma once

#include "engine/scene/Model.h"

namespace shoal::scene {

// The least perceptual roughness of the material; where a texture gives it, all but the smoothest hundredth
// of its texels are at least as rough.
float leastRoughness(const Model& model, const Material& material);

// Over all materials that some mesh uses; 1 where there are none.
float leastRoughness(const Model& model);

// Means over the texture that gives them, times the material's factors.
struct MeanSurface {
    float roughness = 1, metallic = 1;
};
MeanSurface meanSurface(const Model& model, const Material& material);

// The least of their roughnesses over all materials that some mesh uses; 1 where there are none.
float leastMeanRoughness(const Model& model);

} // namespace shoal::scene
