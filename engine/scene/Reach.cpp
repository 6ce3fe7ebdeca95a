#include "engine/scene/Reach.h"

#include "engine/scene/Surface.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace shoal::scene {

namespace {

constexpr float kFar = std::numeric_limits<float>::max();

struct Box {
    glm::vec3 low{kFar}, high{-kFar};
    void add(const glm::vec3& p, float radius = 0) {
        low = glm::min(low, p - radius);
        high = glm::max(high, p + radius);
    }
};

// Skin that several nodes move lies beside where any of them would take it, and so do triangles between two
// balls. Of radii: what fingers bent by more than a right angle need.
constexpr float kWider = 1.2f;
constexpr float kLongest = 1.6f; // of the next longest side: longer things are two,
constexpr size_t kFewest = 8;    // but not things of so few positions

void addBalls(int node, std::span<glm::vec3> positions, std::vector<NodeReach>& all) {
    Box box;
    for (const glm::vec3& p : positions) box.add(p);
    const glm::vec3 sides = box.high - box.low, middle = 0.5f * (box.low + box.high);
    const int longest = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
    if (positions.size() > kFewest &&
        sides[longest] > kLongest * std::max(sides[(longest + 1) % 3], sides[(longest + 2) % 3])) {
        const auto half = std::ranges::partition(
            positions, [&](const glm::vec3& p) { return p[longest] < middle[longest]; });
        const size_t below = positions.size() - half.size();
        if (below > 0 && !half.empty()) {
            addBalls(node, positions.first(below), all);
            addBalls(node, positions.subspan(below), all);
            return;
        }
    }
    float radius = 0;
    for (const glm::vec3& p : positions) radius = std::max(radius, glm::distance(p, middle));
    all.push_back({node, middle, kWider * radius});
}

} // namespace

std::vector<NodeReach> reachOf(const Model& model, const Pose& rest) {
    const Surface surface = posedSurface(model, rest);
    std::map<int, std::vector<glm::vec3>> byNode; // positions, each in its node's frame
    for (size_t v = 0; v < surface.positions.size(); ++v)
        byNode[surface.nodesOf[v]].push_back(surface.positions[v]);
    std::vector<NodeReach> all;
    for (auto& [node, positions] : byNode) {
        const glm::mat4 nodeFromModel = glm::inverse(rest.modelFromNode[static_cast<size_t>(node)]);
        for (glm::vec3& p : positions) p = glm::vec3(nodeFromModel * glm::vec4(p, 1));
        addBalls(node, positions, all);
    }
    return all;
}

void placeBalls(const std::vector<NodeReach>& reach, const Pose& pose, const glm::mat4& worldFromModel,
                std::vector<Ball>& balls) {
    balls.clear();
    for (const NodeReach& each : reach) {
        const glm::mat4 world = worldFromModel * pose.modelFromNode[static_cast<size_t>(each.node)];
        balls.push_back(
            {glm::vec3(world * glm::vec4(each.centre, 1)), each.radius * glm::length(glm::vec3(world[0]))});
    }
}

Ball ballAround(std::span<const Ball> balls) {
    Box box;
    for (const Ball& ball : balls) box.add(ball.centre, ball.radius);
    if (balls.empty()) return {};
    Ball around{0.5f * (box.low + box.high), 0};
    for (const Ball& ball : balls)
        around.radius = std::max(around.radius, glm::distance(ball.centre, around.centre) + ball.radius);
    return around;
}

} // namespace shoal::scene
