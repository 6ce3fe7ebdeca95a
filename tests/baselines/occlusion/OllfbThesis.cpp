#include "tests/baselines/occlusion/OllfbThesis.h"

#include "engine/occlusion/Directions.h"
#include "engine/occlusion/Octahedral.h"
#include "engine/occlusion/Scan.h"
#include "tests/baselines/occlusion/PixelWalk.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <string>

namespace shoal::occlusion {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Calls found(pixel, depth, triangle, weights) for each layer of one view.
template <class Found>
void see(const BodyMesh& mesh, const ThesisViews& views, const glm::mat3& viewFromBody, Found&& found) {
    for (const glm::uvec3& t : mesh.triangles) {
        std::array<glm::vec3, 3> corners;
        for (int k = 0; k < 3; ++k)
            corners[static_cast<size_t>(k)] = views.pixelFromBody(viewFromBody, mesh.positions[t[k]]);
        scanTriangle(
            corners, views.resolution, views.resolution, [&](int x, int y, const glm::vec3& weights) {
                const float depth = glm::dot(weights, glm::vec3(corners[0].z, corners[1].z, corners[2].z));
                found(static_cast<size_t>(y * views.resolution + x), depth, t, weights);
            });
    }
}

} // namespace

std::vector<glm::vec3> cubeDirections(int n) {
    std::vector<glm::vec3> directions;
    directions.reserve(static_cast<size_t>(6 * n * n));
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const auto across = [&](int i) {
                    return std::tan(kPi / 4 * ((2 * static_cast<float>(i) + 1) / static_cast<float>(n) - 1));
                };
                glm::vec3 v;
                v[face / 2] = face % 2 ? -1.0f : 1.0f;
                v[(face / 2 + 1) % 3] = across(x);
                v[(face / 2 + 2) % 3] = across(y);
                directions.push_back(glm::normalize(v));
            }
    return directions;
}

int nearestCubeDirection(const glm::vec3& direction, int n) {
    const glm::vec3 a = glm::abs(direction);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    const auto cell = [&](float across) {
        const float place = (std::atan(across / a[axis]) * 4 / kPi + 1) / 2 * static_cast<float>(n);
        return std::clamp(static_cast<int>(place), 0, n - 1);
    };
    const int face = 2 * axis + (direction[axis] < 0);
    return (face * n + cell(direction[(axis + 2) % 3])) * n + cell(direction[(axis + 1) % 3]);
}

Result<OllfbThesis> OllfbThesis::make(const BodyMesh& mesh, const Options& options) {
    if (Status status = checkMesh(mesh); !status) return status.error();
    if (Status status = checkOptions(options); !status) return status.error();
    OllfbThesis result;
    result.views_ = {options.cells, options.resolution, boundingSphere(mesh)};
    const ThesisViews& views = result.views_;
    const size_t pixels = static_cast<size_t>(views.resolution) * static_cast<size_t>(views.resolution);
    const size_t starts = pixels * static_cast<size_t>(views.count()) + 1;
    const auto tooMuch = [&](size_t bytes) { return bytes > options.maxBytes; };
    const Error tooLarge{"", "a body's layers would take more than " + std::to_string(options.maxBytes) +
                                 " bytes; see it from fewer sides or with fewer pixels"};
    if (tooMuch(starts * sizeof(uint32_t))) return tooLarge;
    for (const glm::vec3& direction : cubeDirections(options.cells))
        result.viewsFromBody_.push_back(lookingAlong(direction, 0));

    // Count, then sum up, then fill; `starts_` holds counts one place on, then ends that move up as layers
    // come.
    result.starts_.assign(starts, 0);
    uint64_t total = 0;
    for (int v = 0; v < views.count(); ++v) {
        uint32_t* const count = result.starts_.data() + static_cast<size_t>(v) * pixels + 1;
        see(mesh, views, result.viewsFromBody_[static_cast<size_t>(v)],
            [&](size_t pixel, float, const glm::uvec3&, const glm::vec3&) { ++count[pixel], ++total; });
        if (tooMuch(total * sizeof(ThesisLayer))) return tooLarge;
    }
    std::inclusive_scan(result.starts_.begin(), result.starts_.end(), result.starts_.begin());
    if (tooMuch(result.bytes() + total * sizeof(ThesisLayer))) return tooLarge;
    result.layers_.resize(total);
    std::vector<uint32_t> next(pixels);
    for (int v = 0; v < views.count(); ++v) {
        const uint32_t* const first = result.starts_.data() + static_cast<size_t>(v) * pixels;
        std::copy_n(first, pixels, next.begin());
        see(mesh, views, result.viewsFromBody_[static_cast<size_t>(v)],
            [&](size_t pixel, float depth, const glm::uvec3& t, const glm::vec3& weights) {
                const glm::vec3 sum = weights.x * mesh.normals[t.x] + weights.y * mesh.normals[t.y] +
                                      weights.z * mesh.normals[t.z];
                const float length = glm::length(sum);
                const glm::vec3 normal = length > 0 ? sum / length : glm::vec3(0, 0, 1);
                result.layers_[next[pixel]++] = {depth, packDirection(normal, 16)};
            });
        for (size_t p = 0; p < pixels; ++p)
            std::sort(result.layers_.begin() + first[p], result.layers_.begin() + first[p + 1],
                      [](const ThesisLayer& a, const ThesisLayer& b) { return a.depth < b.depth; });
    }
    return result;
}

std::optional<Hit> OllfbThesis::trace(const glm::vec3& origin, const glm::vec3& direction,
                                      float nearest) const {
    if (layers_.empty()) return {};
    const int view = nearestCubeDirection(direction, views_.cells);
    const glm::mat3& viewFromBody = viewsFromBody_[static_cast<size_t>(view)];
    const glm::vec3 from = views_.pixelFromBody(viewFromBody, origin);
    const glm::vec3 along = viewFromBody * direction; // per pixel's length of the ray
    const float scale = views_.pixelsPerMetre();
    const auto size = static_cast<float>(views_.resolution);
    float begin = nearest * scale, end = 4 * size + glm::distance(from, glm::vec3(size / 2));
    for (int k = 0; k < 3; ++k)
        if (!clipSlab(from[k], along[k], 0, size, begin, end)) return {};
    std::optional<Hit> hit;
    const uint32_t* const starts =
        starts_.data() +
        static_cast<size_t>(view) * static_cast<size_t>(views_.resolution * views_.resolution);
    walkCells(from, along, begin, end, glm::ivec2(0), glm::ivec2(views_.resolution),
              [&](const glm::ivec2& cell, float in, float out) {
                  const int pixel = cell.y * views_.resolution + cell.x;
                  // The nearest view looks along the ray: depth grows.
                  const float depthIn = from.z + in * along.z, depthOut = from.z + out * along.z;
                  for (uint32_t i = starts[pixel]; i < starts[pixel + 1]; ++i) {
                      const ThesisLayer& layer = layers_[i];
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
