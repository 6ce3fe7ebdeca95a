#include "tests/baselines/occlusion/CoherentShadowMaps.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace shoal::occlusion::baselines {

namespace {
constexpr float kFar = 1e30f;
}

// Saff and Kuijlaars 1997, "Distributing Many Points on a Sphere", generalised spiral.
std::vector<glm::vec3> spiralDirections(int count) {
    std::vector<glm::vec3> out;
    float turn = 0;
    for (int i = 0; i < count; ++i) {
        const float y = -1 + (2 * static_cast<float>(i) + 1) / static_cast<float>(count);
        const float ring = std::sqrt(1 - y * y);
        turn += 3.6f / std::sqrt(static_cast<float>(count)) / ring;
        out.emplace_back(ring * std::cos(turn), y, ring * std::sin(turn));
    }
    return out;
}

CoherentShadowMaps::CoherentShadowMaps(std::span<const Triangles> bodies,
                                       std::span<const glm::vec3> directions, int size) {
    assert(directions.size() < 65536);
    const Sphere sphere = boundingSphereOf(bodies);
    depthScale_ = 65534 / (2 * sphere.radius);
    const auto pixels = static_cast<size_t>(size) * size;
    struct Interval {
        float first = kFar, second = kFar;
    };
    std::vector<Interval> seen(pixels * directions.size());
    for (size_t k = 0; k < directions.size(); ++k) {
        // Looks from the light, against the direction to it. Fixed axes keep a pixel's content alike from map
        // to map.
        views_.push_back(viewAlong(-directions[k], sphere.centre, sphere.radius, size));
        for (const Triangles& body : bodies)
            rasterise(views_[k], body, [&](int pixel, float depth, bool) {
                Interval& at = seen[static_cast<size_t>(pixel) * directions.size() + k];
                if (depth < at.first) {
                    at.second = at.first;
                    at.first = depth;
                } else {
                    at.second = std::min(at.second, depth);
                }
            });
    }
    for (size_t pixel = 0; pixel < pixels; ++pixel) {
        first_.push_back(static_cast<uint32_t>(runs_.size()));
        float low = -kFar, high = kFar;
        const auto close = [&] {
            // Without a second surface: as far in front as behind the surface, half way into thin air.
            const float depth = low >= kFar    ? kFar
                                : high >= kFar ? low + 0.25f * sphere.radius
                                               : 0.5f * (low + high);
            runs_.back().depth = depth >= kFar ? 65535
                                               : static_cast<uint16_t>(std::clamp(
                                                     (depth + sphere.radius) * depthScale_, 0.0f, 65534.0f));
        };
        for (size_t k = 0; k < directions.size(); ++k) {
            const Interval& at = seen[pixel * directions.size() + k];
            const float newLow = std::max(low, at.first), newHigh = std::min(high, at.second);
            const bool fits = k > 0 && ((at.first >= kFar) == (low >= kFar)) && newLow <= newHigh;
            if (fits) {
                low = newLow;
                high = newHigh;
                continue;
            }
            if (k > 0) close();
            runs_.push_back({static_cast<uint16_t>(k), 0});
            low = at.first;
            high = at.second;
        }
        close();
    }
    first_.push_back(static_cast<uint32_t>(runs_.size()));
}

bool CoherentShadowMaps::occluded(const glm::vec3& position, size_t direction) const {
    const OrthoView& view = views_[direction];
    const glm::vec3 at = view.toView(position);
    const glm::ivec2 pixel = glm::clamp(glm::ivec2(glm::floor(glm::vec2(at))), 0, view.size - 1);
    const auto index = static_cast<size_t>(pixel.y) * view.size + pixel.x;
    const auto begin = runs_.begin() + first_[index], end = runs_.begin() + first_[index + 1];
    const auto after =
        std::upper_bound(begin, end, direction, [](size_t k, const Run& run) { return k < run.from; });
    const uint16_t depth = (after - 1)->depth;
    return depth != 65535 && (at.z + view.radius) * depthScale_ > static_cast<float>(depth);
}

} // namespace shoal::occlusion::baselines
