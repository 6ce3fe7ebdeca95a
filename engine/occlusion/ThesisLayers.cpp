#include "engine/occlusion/ThesisLayers.h"

#include "engine/occlusion/Directions.h"
#include "engine/occlusion/Octahedral.h"
#include "engine/occlusion/Scan.h"

#include <algorithm>
#include <numbers>
#include <string>

namespace shoal::occlusion {

namespace {

struct Fragment {
    size_t pixel = 0;
    ThesisLayer layer;
};

// All that one view sees, by pixel and growing depth.
std::vector<Fragment> see(const BodyMesh& mesh, const ThesisViews& views, const glm::mat3& viewFromBody) {
    std::vector<Fragment> seen;
    for (const glm::uvec3& t : mesh.triangles) {
        std::array<glm::vec3, 3> corners;
        for (int k = 0; k < 3; ++k) corners[k] = views.pixelFromBody(viewFromBody, mesh.positions[t[k]]);
        const glm::mat3 normals(mesh.normals[t.x], mesh.normals[t.y], mesh.normals[t.z]);
        scanTriangle(
            corners, views.resolution, views.resolution, [&](int x, int y, const glm::vec3& weights) {
                const glm::vec3 sum = normals * weights;
                const float length = glm::length(sum);
                const glm::vec3 normal = length > 0 ? sum / length : glm::vec3(0, 0, 1);
                const float depth = glm::dot(weights, glm::vec3(corners[0].z, corners[1].z, corners[2].z));
                seen.push_back(
                    {static_cast<size_t>(y * views.resolution + x), {depth, packDirection(normal, 16)}});
            });
    }
    std::sort(seen.begin(), seen.end(), [](const Fragment& a, const Fragment& b) {
        return a.pixel != b.pixel ? a.pixel < b.pixel : a.layer.depth < b.layer.depth;
    });
    return seen;
}

} // namespace

std::vector<glm::vec3> cubeDirections(int cells) {
    std::vector<glm::vec3> directions;
    const auto across = [&](int i) {
        constexpr float kQuarterTurn = std::numbers::pi_v<float> / 4; // from a face's middle to its edge
        return std::tan(kQuarterTurn * (static_cast<float>(2 * i + 1) / static_cast<float>(cells) - 1));
    };
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < cells; ++y)
            for (int x = 0; x < cells; ++x) {
                glm::vec3 v;
                v[face / 2] = face % 2 ? -1.0f : 1.0f;
                v[(face / 2 + 1) % 3] = across(x);
                v[(face / 2 + 2) % 3] = across(y);
                directions.push_back(glm::normalize(v));
            }
    return directions;
}

Result<ThesisLayers> ThesisLayers::make(const BodyMesh& mesh, const Options& options) {
    if (Status status = checkMesh(mesh); !status) return status.error();
    if (options.cells < 1 || options.cells > 16) return Error{"", "views must be 6 n^2 with n from 1 to 16"};
    if (options.resolution < 1 || options.resolution > 1024)
        return Error{"", "the resolution of a view must be 1 to 1024"};
    ThesisLayers result;
    result.views_ = {options.cells, options.resolution, boundingSphere(mesh)};
    const Error tooLarge{"", "a body's layers would take more than " + std::to_string(options.maxBytes) +
                                 " bytes; see it from fewer sides or with fewer pixels"};
    const auto pixels = static_cast<size_t>(options.resolution * options.resolution);
    for (const glm::vec3& direction : cubeDirections(options.cells)) {
        const std::vector<Fragment> seen = see(mesh, result.views_, lookingAlong(direction, 0));
        auto next = seen.begin();
        for (size_t pixel = 0; pixel < pixels; ++pixel) {
            result.starts_.push_back(static_cast<uint32_t>(result.layers_.size()));
            for (; next != seen.end() && next->pixel == pixel; ++next) result.layers_.push_back(next->layer);
        }
        if (result.bytes() > options.maxBytes) return tooLarge;
    }
    result.starts_.push_back(static_cast<uint32_t>(result.layers_.size()));
    return result;
}

} // namespace shoal::occlusion
