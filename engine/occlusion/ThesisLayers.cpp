#include "engine/occlusion/ThesisLayers.h"

#include "engine/occlusion/Directions.h"
#include "engine/occlusion/Scan.h"

#include <algorithm>
#include <cassert>
#include <numbers>
#include <string>

namespace shoal::occlusion {

namespace {

// Renders one view. seen: the layers of each pixel, by ascending depth.
void see(const BodyMesh& mesh, const ThesisViews& views, const glm::mat3& viewFromBody,
         std::vector<std::vector<ThesisLayer>>& seen) {
    for (std::vector<ThesisLayer>& pixel : seen) pixel.clear();
    for (const glm::uvec3& t : mesh.triangles) {
        std::array<glm::vec3, 3> corners;
        for (int k = 0; k < 3; ++k) corners[k] = views.pixelFromBody(viewFromBody, mesh.positions[t[k]]);
        const glm::mat3 normals(mesh.normals[t.x], mesh.normals[t.y], mesh.normals[t.z]);
        scanTriangle(corners, views.resolution, views.resolution,
                     [&](int x, int y, const glm::vec3& weights) {
                         const glm::vec3 sum = normals * weights;
                         const float length = glm::length(sum);
                         const glm::vec3 normal = length > 0 ? sum / length : glm::vec3(0, 0, 1);
                         seen[y * views.resolution + x].push_back(
                             {glm::dot(weights, glm::vec3(corners[0].z, corners[1].z, corners[2].z)),
                              packDirection(normal, 16)});
                     });
    }
    for (std::vector<ThesisLayer>& pixel : seen) std::ranges::sort(pixel, {}, &ThesisLayer::depth);
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
    assert(options.cells >= 1 && options.cells <= 16 && options.resolution >= 1 &&
           options.resolution <= 1024);
    ThesisLayers result;
    result.views = {options.cells, options.resolution, boundingSphere(mesh)};
    std::vector<std::vector<ThesisLayer>> seen(options.resolution * options.resolution); // by pixel
    for (const glm::vec3& direction : cubeDirections(options.cells)) {
        see(mesh, result.views, lookingAlong(direction, 0), seen);
        for (const std::vector<ThesisLayer>& pixel : seen) {
            result.starts.push_back(static_cast<uint32_t>(result.layers.size()));
            result.layers.insert(result.layers.end(), pixel.begin(), pixel.end());
        }
        if (result.bytes() > options.maxBytes)
            return Error{"", "a body's layers would take more than " + std::to_string(options.maxBytes) +
                                 " bytes; see it from fewer sides or with fewer pixels"};
    }
    result.starts.push_back(static_cast<uint32_t>(result.layers.size()));
    return result;
}

} // namespace shoal::occlusion
