#include "engine/scene/BoundingSpheres.h"

#include "engine/scene/Surface.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <map>

namespace shoal::scene {

namespace {

// Skin that several nodes move lies beside where any of them would take it, and so do triangles between two
// spheres. Of radii: what fingers bent by more than a right angle need.
constexpr float kWider = 1.2f;
constexpr float kLongest = 1.6f; // of the next longest side: longer things are two,
constexpr size_t kFewest = 8;    // but not things of so few positions

void addSpheres(int node, std::span<glm::vec3> positions, std::vector<NodeSphere>& all) {
    glm::vec3 low = positions[0], high = positions[0];
    for (const glm::vec3& p : positions) low = glm::min(low, p), high = glm::max(high, p);
    const glm::vec3 sides = high - low, middle = 0.5f * (low + high);
    const int longest = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
    if (positions.size() > kFewest &&
        sides[longest] > kLongest * std::max(sides[(longest + 1) % 3], sides[(longest + 2) % 3])) {
        const auto half = std::ranges::partition(
            positions, [&](const glm::vec3& p) { return p[longest] < middle[longest]; });
        const size_t below = positions.size() - half.size();
        if (below > 0 && !half.empty()) {
            addSpheres(node, positions.first(below), all);
            addSpheres(node, positions.subspan(below), all);
            return;
        }
    }
    float radius = 0;
    for (const glm::vec3& p : positions) radius = std::max(radius, glm::distance(p, middle));
    all.push_back({node, middle, kWider * radius});
}

} // namespace

std::vector<NodeSphere> boundingSpheresOf(const Model& model, const Pose& rest) {
    const Surface surface = posedSurface(model, rest);
    std::map<int, std::vector<glm::vec3>> byNode; // positions, each in its node's frame
    for (size_t v = 0; v < surface.positions.size(); ++v)
        byNode[surface.nodesOf[v]].push_back(surface.positions[v]);
    std::vector<NodeSphere> all;
    for (auto& [node, positions] : byNode) {
        const glm::mat4 nodeFromModel = glm::inverse(rest.modelFromNode[static_cast<size_t>(node)]);
        for (glm::vec3& p : positions) p = glm::vec3(nodeFromModel * glm::vec4(p, 1));
        addSpheres(node, positions, all);
    }
    return all;
}

void placeSpheres(const std::vector<NodeSphere>& reach, const Pose& pose, const glm::mat4& worldFromModel,
                  std::vector<Sphere>& spheres) {
    spheres.clear();
    for (const NodeSphere& each : reach) {
        const glm::mat4 world = worldFromModel * pose.modelFromNode[static_cast<size_t>(each.node)];
        spheres.push_back(
            {glm::vec3(world * glm::vec4(each.centre, 1)), each.radius * glm::length(glm::vec3(world[0]))});
    }
}

Sphere boundingSphereOf(std::span<const Sphere> spheres) {
    if (spheres.empty()) return {};
    glm::vec3 low = spheres[0].centre, high = low;
    for (const Sphere& s : spheres)
        low = glm::min(low, s.centre - s.radius), high = glm::max(high, s.centre + s.radius);
    Sphere around{0.5f * (low + high), 0};
    for (const Sphere& sphere : spheres)
        around.radius = std::max(around.radius, glm::distance(sphere.centre, around.centre) + sphere.radius);
    return around;
}

} // namespace shoal::scene
