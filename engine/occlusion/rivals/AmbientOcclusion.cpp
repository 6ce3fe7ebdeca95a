#include "engine/occlusion/rivals/AmbientOcclusion.h"

namespace shoal::occlusion::rivals {

std::vector<float> bakeAmbientOcclusion(const BodyMesh& mesh, const Occluded& occluded, int rays,
                                        float start) {
    const auto directions = cosineDirections(rays);
    std::vector<float> free;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::mat3 frame = frameAround(mesh.normals[i]);
        const glm::vec3 origin = mesh.positions[i] + start * mesh.normals[i];
        int seen = 0;
        for (const glm::vec3& direction : directions) seen += !occluded(origin, frame * direction);
        free.push_back(static_cast<float>(seen) / static_cast<float>(rays));
    }
    return free;
}

} // namespace shoal::occlusion::rivals
