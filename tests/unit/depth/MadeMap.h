// Maps of distances made of geometry.
#pragma once

#include "engine/depth/DepthMap.h"

#include <algorithm>

namespace shoal::depth {

// inverseOf: returns one over the distance of the surface in a unit direction from the film's camera.
template <class Inverse> DepthMap mapOf(const Inverse& inverseOf, int width = kMapWidth) {
    DepthMap map{Image<uint8_t, 1>(width, width / 2)};
    for (int y = 0; y < width / 2; ++y)
        for (int x = 0; x < width; ++x) {
            const float steps = inverseOf(texelDirection(x, y, width, width / 2)) / DepthMap::perM(1);
            *map.inverse.at(x, y) = static_cast<uint8_t>(std::clamp(steps + 0.5f, 0.0f, DepthMap::kSteps));
        }
    return map;
}

} // namespace shoal::depth
