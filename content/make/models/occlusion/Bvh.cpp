#include "content/make/models/occlusion/Bvh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace shoal::occlusion {

namespace {

constexpr size_t kLeaf = 4;
constexpr size_t kDepth = 64; // more than any tree needs: each level halves the number of triangles

} // namespace

Bvh::Bvh(std::span<const glm::vec3> positions, std::span<const uint32_t> indices) {
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::vec3& a = positions[indices[i]];
        triangles_.push_back(
            {a, positions[indices[i + 1]] - a, positions[indices[i + 2]] - a, static_cast<uint32_t>(i / 3)});
    }
    if (triangles_.empty()) return;
    nodes_.reserve(2 * triangles_.size());
    nodes_.push_back({{}, {}, 0, static_cast<uint32_t>(triangles_.size())});
    for (size_t n = 0; n < nodes_.size(); ++n) {
        const uint32_t begin = nodes_[n].first, count = nodes_[n].count;
        const std::span part(triangles_.data() + begin, count);
        glm::vec3 low(INFINITY), high(-INFINITY), lowMiddle(INFINITY), highMiddle(-INFINITY);
        const auto middle = [](const Triangle& t) { return t.corner + (t.edge1 + t.edge2) / 3.0f; };
        for (const Triangle& t : part) {
            for (const glm::vec3& p : {t.corner, t.corner + t.edge1, t.corner + t.edge2})
                low = glm::min(low, p), high = glm::max(high, p);
            lowMiddle = glm::min(lowMiddle, middle(t)), highMiddle = glm::max(highMiddle, middle(t));
        }
        nodes_[n].low = low, nodes_[n].high = high;
        if (count <= kLeaf) continue;
        const glm::vec3 extent = highMiddle - lowMiddle;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const uint32_t half = count / 2;
        std::nth_element(
            part.begin(), part.begin() + half, part.end(),
            [&](const Triangle& x, const Triangle& y) { return middle(x)[axis] < middle(y)[axis]; });
        nodes_[n].first = static_cast<uint32_t>(nodes_.size());
        nodes_[n].count = 0;
        nodes_.push_back({{}, {}, begin, half});
        nodes_.push_back({{}, {}, begin + half, count - half});
    }
}

// Moeller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection".
std::optional<Bvh::Touch> Bvh::first(const glm::vec3& origin, const glm::vec3& direction, float nearest,
                                     float furthest, bool any) const {
    std::optional<Touch> best;
    if (nodes_.empty()) return best;
    const glm::vec3 inverse = 1.0f / direction;
    const auto entry = [&](const Node& node) {
        const glm::vec3 a = (node.low - origin) * inverse, b = (node.high - origin) * inverse;
        const glm::vec3 in = glm::min(a, b), out = glm::max(a, b);
        // A ray within a box's plane gives NaN there, which max() and min() pass over unless it comes first.
        const float from = std::max({nearest, in.x, in.y, in.z}),
                    to = std::min({furthest, out.x, out.y, out.z});
        return from <= to ? from : INFINITY;
    };
    std::array<uint32_t, kDepth> stack;
    size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const Node& node = nodes_[stack[--depth]];
        if (entry(node) == INFINITY) continue;
        if (node.count == 0) {
            const bool swap = entry(nodes_[node.first]) > entry(nodes_[node.first + 1]);
            stack[depth++] = node.first + (swap ? 0 : 1);
            stack[depth++] = node.first + (swap ? 1 : 0);
            continue;
        }
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Triangle& t = triangles_[i];
            const glm::vec3 across = glm::cross(direction, t.edge2);
            const float det = glm::dot(t.edge1, across);
            if (det == 0) continue;
            const glm::vec3 from = origin - t.corner;
            const float u = glm::dot(from, across) / det;
            if (!(u >= 0 && u <= 1)) continue;
            const glm::vec3 turned = glm::cross(from, t.edge1);
            const float v = glm::dot(direction, turned) / det;
            if (!(v >= 0 && u + v <= 1)) continue;
            const float distance = glm::dot(t.edge2, turned) / det;
            if (!(distance > nearest && distance < furthest)) continue;
            furthest = distance;
            best = Touch{distance, t.index, u, v};
            if (any) return best;
        }
    }
    return best;
}

} // namespace shoal::occlusion
