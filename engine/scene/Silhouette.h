// How wide a model is from tail to nose: what a shadow needs to know of it.
#pragma once

#include "engine/scene/Model.h"

#include <glm/vec2.hpp>

#include <array>

namespace shoal::scene {

struct Silhouette {
    static constexpr size_t kSlices = 6;
    float back = 0, front = 0; // along z of the model frame; slices of equal length, from back to front
    // Of each slice: half the width (along x) that would show as large an area from above, and half the
    // height (along y) from the side.
    std::array<glm::vec2, kSlices> half{};
};

// Of the posed model. A closed surface shows the half of its triangles' areas, projected (Cauchy); sheets,
// which fins may be, show twice of what they count here.
Silhouette silhouetteOf(const Model& model, const Pose& pose);

} // namespace shoal::scene
