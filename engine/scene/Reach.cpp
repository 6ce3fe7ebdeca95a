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

} // namespace

std::vector<NodeReach> reachOf(const Model& model, const Pose& rest) {
    const Surface surface = posedSurface(model, rest);
    std::map<int, std::vector<glm::vec3>> byNode; // positions, each in its node's frame
    for (size_t v = 0; v < surface.positions.size(); ++v)
        byNode[surface.nodesOf[v]].push_back(surface.positions[v]);
    std::vector<NodeReach> all;
    for (auto& [node, positions] : byNode) {
        const glm::mat4 nodeFromModel = glm::inverse(rest.modelFromNode[static_cast<size_t>(node)]);
        Box box;
        for (glm::vec3& p : positions) box.add(p = glm::vec3(nodeFromModel * glm::vec4(p, 1)));
        NodeReach reach{node, 0.5f * (box.low + box.high), 0};
        for (const glm::vec3& p : positions)
            reach.radius = std::max(reach.radius, glm::distance(p, reach.centre));
        all.push_back(reach);
    }
    return all;
}

Ball ballAround(const std::vector<NodeReach>& reach, const Pose& pose, const glm::mat4& worldFromModel) {
    const auto placed = [&](const NodeReach& each) {
        const glm::mat4 world = worldFromModel * pose.modelFromNode[static_cast<size_t>(each.node)];
        return Ball{glm::vec3(world * glm::vec4(each.centre, 1)),
                    each.radius * glm::length(glm::vec3(world[0]))};
    };
    Box box;
    for (const NodeReach& each : reach) {
        const Ball ball = placed(each);
        box.add(ball.centre, ball.radius);
    }
    if (reach.empty()) return {};
    Ball around{0.5f * (box.low + box.high), 0};
    for (const NodeReach& each : reach) {
        const Ball ball = placed(each);
        around.radius = std::max(around.radius, glm::distance(ball.centre, around.centre) + ball.radius);
    }
    return around;
}

} // namespace shoal::scene
