#include "tests/baselines/occlusion/OllfbThesis.h"

#include "engine/occlusion/Directions.h"
#include "tests/baselines/occlusion/PixelWalk.h"

#include <algorithm>
#include <numbers>

namespace shoal::occlusion {

int nearestCubeDirection(const glm::vec3& direction, int n) {
    const glm::vec3 a = glm::abs(direction);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    const auto cell = [&](float across) {
        const float place =
            (std::atan(across / a[axis]) * 4 / std::numbers::pi_v<float> + 1) / 2 * static_cast<float>(n);
        return std::clamp(static_cast<int>(place), 0, n - 1);
    };
    const int face = 2 * axis + (direction[axis] < 0);
    return (face * n + cell(direction[(axis + 2) % 3])) * n + cell(direction[(axis + 1) % 3]);
}

OllfbThesis::OllfbThesis(ThesisLayers made) : ThesisLayers(std::move(made)) {
    for (const glm::vec3& direction : cubeDirections(views.cells))
        viewsFromBody_.push_back(lookingAlong(direction, 0));
}

std::optional<Hit> OllfbThesis::trace(const glm::vec3& origin, const glm::vec3& direction,
                                      float nearest) const {
    if (layers.empty()) return {};
    const int view = nearestCubeDirection(direction, views.cells);
    const glm::mat3& viewFromBody = viewsFromBody_[view];
    const glm::vec3 from = views.pixelFromBody(viewFromBody, origin);
    const glm::vec3 along = viewFromBody * direction; // per pixel of the ray's length
    const float scale = views.pixelsPerMetre();
    const auto size = static_cast<float>(views.resolution);
    float begin = nearest * scale, end = 4 * size + glm::distance(from, glm::vec3(size / 2));
    for (int k = 0; k < 3; ++k)
        if (!clipSlab(from[k], along[k], 0, size, begin, end)) return {};
    std::optional<Hit> hit;
    const uint32_t* const first =
        starts.data() + static_cast<size_t>(view) * static_cast<size_t>(views.resolution * views.resolution);
    walkCells(from, along, begin, end, glm::ivec2(0), glm::ivec2(views.resolution),
              [&](const glm::ivec2& cell, float in, float out) {
                  const int pixel = cell.y * views.resolution + cell.x;
                  // The nearest view looks along the ray: depth grows.
                  const float depthIn = from.z + in * along.z, depthOut = from.z + out * along.z;
                  for (uint32_t i = first[pixel]; i < first[pixel + 1]; ++i) {
                      const ThesisLayer& layer = layers[i];
                      if (layer.depth < depthIn || layer.depth >= depthOut) continue;
                      const glm::vec3 normal = unpackDirection(layer.normal, 16);
                      hit = Hit{(layer.depth - from.z) / along.z / scale,
                                glm::dot(normal, direction) > 0 ? -normal : normal};
                      return true;
                  }
                  return false;
              });
    return hit;
}

} // namespace shoal::occlusion
