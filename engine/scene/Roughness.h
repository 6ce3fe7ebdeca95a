// Roughness and metalness of a model's materials, from factors and textures: they decide which prefiltered
// light maps are made.
#pragma once

#include "engine/scene/Model.h"

namespace shoal::scene {

// The least perceptual roughness of the material; where a texture gives it, all but the smoothest hundredth
// of its texels are at least as rough.
float minRoughness(const Model& model, const Material& material);

// Over all materials that some mesh uses; 1 where there are none.
float minRoughness(const Model& model);

// Means over the texture that gives them, times the material's factors.
struct MeanSurface {
    float roughness = 1, metallic = 1;
};
MeanSurface meanSurface(const Model& model, const Material& material);

// The least of their roughnesses over all materials that some mesh uses; 1 where there are none.
float minMeanRoughness(const Model& model);

} // namespace shoal::scene
