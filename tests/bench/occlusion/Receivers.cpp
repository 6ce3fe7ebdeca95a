#include "engine/core/Random.h"
#include "tests/bench/occlusion/Scene.h"

namespace shoal::bench {

// Returns a receiver moved out to the tangent planes of the corners, so that a facet does not shadow itself
// at grazing angles. Hanika 2021, "Hacking the Shadow Terminator", Ray Tracing Gems II.
Receiver receiverAt(const Scene& scene, const Touch& touch) {
    const Mesh& mesh = scene.bodies[touch.mesh].posed;
    Receiver at{.body = touch.mesh, .corners = mesh.triangles[touch.triangle], .weights = touch.weights};
    at.position = at.mix(mesh.positions);
    at.normal = glm::normalize(at.mix(mesh.normals));
    glm::vec3 out(0);
    for (int i = 0; i < 3; ++i) {
        const glm::vec3& normal = mesh.normals[at.corners[i]];
        out -= at.weights[i] * std::min(0.0f, glm::dot(at.position - mesh.positions[at.corners[i]], normal)) *
               normal;
    }
    at.position += out;
    at.mirrored = glm::reflect(glm::normalize(at.position - scene.camera.eye), at.normal);
    return at;
}

std::vector<Receiver> spreadReceivers(const Scene& scene, int count) {
    std::vector<Touch> facets[2];
    std::vector<double> upTo[2];
    for (uint32_t b = 0; b < scene.bodies.size(); ++b) {
        const Body& body = scene.bodies[b];
        auto& sums = upTo[body.group];
        for (uint32_t t = 0; t < body.posed.triangles.size(); ++t) {
            const glm::uvec3 corner = body.posed.triangles[t];
            const glm::vec3 a = body.posed.positions[corner.x];
            const double area = glm::length(
                glm::cross(body.posed.positions[corner.y] - a, body.posed.positions[corner.z] - a));
            facets[body.group].push_back({0, b, t});
            sums.push_back((sums.empty() ? 0 : sums.back()) + area);
        }
    }
    Random random(7);
    std::vector<Receiver> receivers;
    for (int group = 0; group < 2; ++group) {
        if (facets[group].empty()) continue;
        const int share = facets[1 - group].empty() ? count : count / 2;
        for (int i = 0; i < share; ++i) {
            const double place = (i + static_cast<double>(random.unit())) / share * upTo[group].back();
            const auto found = std::ranges::lower_bound(upTo[group], place) - upTo[group].begin();
            Touch& facet = facets[group][found];
            const float root = std::sqrt(random.unit()), part = random.unit();
            facet.weights = {1 - root, root * (1 - part), root * part};
            receivers.push_back(receiverAt(scene, facet));
        }
    }
    return receivers;
}

} // namespace shoal::bench
