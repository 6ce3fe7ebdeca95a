#include "tests/baselines/occlusion/DepthMaps.h"

#include "tests/baselines/occlusion/Directions.h"
#include "tests/baselines/occlusion/PixelWalk.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace shoal::occlusion::baselines {

constexpr float kFar = 1e30f;

// right x up = along, so that a front, wound counter-clockwise for who looks at it, runs clockwise in x and
// y.
static OrthoView viewAlong(const glm::vec3& direction, const glm::vec3& centre, float radius, int size) {
    const glm::mat3 frame = frameAround(direction);
    return {frame[0], frame[1], frame[2], centre, radius, size};
}

// Returns the sphere around the middle of the bodies' box.
static Sphere boundingSphereOf(std::span<const BodyMesh> bodies) {
    glm::vec3 low(1e30f), high(-1e30f);
    for (const BodyMesh& body : bodies)
        for (const glm::vec3& p : body.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    Sphere sphere{0.5f * (low + high), 0};
    for (const BodyMesh& body : bodies)
        for (const glm::vec3& p : body.positions)
            sphere.radius = std::max(sphere.radius, glm::distance(p, sphere.centre));
    sphere.radius *= 1.001f;
    return sphere;
}

LayeredDepth::LayeredDepth(std::span<const BodyMesh> bodies, int size) {
    const Sphere sphere = boundingSphereOf(bodies);
    struct Layer {
        float depth = 0;
        int enters = 0; // 1, or -1 where it leaves
    };
    for (int axis = 0; axis < 3; ++axis) {
        View& out = views_[axis];
        glm::vec3 along(0);
        along[axis] = 1;
        out.view = viewAlong(along, sphere.centre, sphere.radius, size);
        std::vector<std::vector<Layer>> pixels(static_cast<size_t>(size) * size);
        for (const BodyMesh& body : bodies)
            rasterise(out.view, body, [&](int pixel, float depth, bool front) {
                pixels[pixel].push_back({depth, front ? 1 : -1});
            });
        for (auto& layers : pixels) {
            out.first.push_back(static_cast<uint32_t>(out.solid.size()));
            std::ranges::sort(layers, {}, &Layer::depth);
            int inside = 0;
            for (const Layer& layer : layers) {
                const int now = std::max(0, inside + layer.enters);
                if ((inside == 0) != (now == 0)) out.solid.push_back(layer.depth);
                inside = now;
            }
            if ((out.solid.size() - out.first.back()) % 2) out.solid.pop_back(); // never left: a hole
        }
        out.first.push_back(static_cast<uint32_t>(out.solid.size()));
    }
}

bool LayeredDepth::occluded(const glm::vec3& origin, const glm::vec3& direction, float nearest) const {
    const glm::vec3 size = glm::abs(direction);
    const View& at = views_[size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2)];
    const float scale = at.view.pixelsPerMetre(), radius = at.view.radius;
    const glm::vec3 from = at.view.toView(origin + nearest * direction);
    const glm::vec3 step(scale * glm::dot(direction, at.view.right), scale * glm::dot(direction, at.view.up),
                         glm::dot(direction, at.view.along));
    float begin = 0, end = kFar; // metres along the ray
    for (int k = 0; k < 2; ++k)
        if (!clipSlab(from[k], step[k], 0, static_cast<float>(at.view.size), begin, end)) return false;
    if (!clipSlab(from.z, step.z, -radius, radius, begin, end)) return false;
    return walkCells(from, step, begin, end, glm::ivec2(0), glm::ivec2(at.view.size),
                     [&](const glm::ivec2& pixel, float in, float out) {
                         const float a = from.z + step.z * in, b = from.z + step.z * out;
                         const auto [low, high] = std::minmax(a, b);
                         const auto index = static_cast<size_t>(pixel.y) * at.view.size + pixel.x;
                         for (uint32_t i = at.first[index]; i < at.first[index + 1]; i += 2)
                             if (at.solid[i] <= high && at.solid[i + 1] >= low) return true;
                         return false;
                     });
}

std::size_t LayeredDepth::bytes() const {
    std::size_t sum = 0;
    for (const View& view : views_) sum += (view.first.size() + view.solid.size()) * 4;
    return sum;
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

CoherentShadowMaps::CoherentShadowMaps(std::span<const BodyMesh> bodies,
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
        for (const BodyMesh& body : bodies)
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
