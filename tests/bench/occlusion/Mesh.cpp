#include "tests/bench/occlusion/Mesh.h"

#include <glm/gtc/type_ptr.hpp>

namespace shoal::bench {

namespace {

using Distance = std::function<float(const glm::vec3&)>;

glm::vec3 gradient(const Distance& distance, const glm::vec3& at, float step) {
    glm::vec3 slope(0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 by(0);
        by[axis] = step;
        slope[axis] = (distance(at + by) - distance(at - by)) / (2 * step);
    }
    return slope;
}

} // namespace

Mesh surfaceOf(const Distance& distance, const glm::vec3& low, const glm::vec3& high, float cell) {
    const glm::ivec3 count = glm::ivec3(glm::ceil((high - low) / cell)) + 1; // of corners
    const auto cornerIndex = [&](const glm::ivec3& c) { return (c.z * count.y + c.y) * count.x + c.x; };
    const auto corner = [&](const glm::ivec3& c) { return low + glm::vec3(c) * cell; };
    const auto each = [](const glm::ivec3& end, auto&& visit) {
        for (int z = 0; z < end.z; ++z)
            for (int y = 0; y < end.y; ++y)
                for (int x = 0; x < end.x; ++x) visit(glm::ivec3(x, y, z));
    };
    std::vector<float> values(static_cast<size_t>(count.x) * count.y * count.z);
    each(count, [&](const glm::ivec3& c) { values[cornerIndex(c)] = distance(corner(c)); });

    Mesh mesh;
    std::vector<uint32_t> vertexOf(values.size(), ~0u);
    each(count - 1, [&](const glm::ivec3& c) {
        glm::vec3 sum(0);
        int crossings = 0;
        for (int axis = 0; axis < 3; ++axis)
            for (int edge = 0; edge < 4; ++edge) {
                glm::ivec3 from = c;
                from[(axis + 1) % 3] += edge & 1;
                from[(axis + 2) % 3] += edge >> 1;
                glm::ivec3 to = from;
                ++to[axis];
                const float a = values[cornerIndex(from)], b = values[cornerIndex(to)];
                if ((a < 0) == (b < 0)) continue;
                sum += glm::mix(corner(from), corner(to), a / (a - b));
                ++crossings;
            }
        if (!crossings) return;
        glm::vec3 at = sum / static_cast<float>(crossings);
        for (int step = 0; step < 4; ++step) {
            const glm::vec3 slope = gradient(distance, at, 0.05f * cell);
            at -= slope * (distance(at) / std::max(glm::dot(slope, slope), 0.1f));
        }
        vertexOf[cornerIndex(c)] = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.push_back(at);
        mesh.normals.push_back(glm::normalize(gradient(distance, at, 0.05f * cell)));
    });

    each(count - 1, [&](const glm::ivec3& c) {
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            if (c[u] == 0 || c[v] == 0) continue;
            glm::ivec3 next = c;
            ++next[axis];
            const bool inside = values[cornerIndex(c)] < 0;
            if (inside == (values[cornerIndex(next)] < 0)) continue;
            uint32_t quad[4];
            for (int k = 0; k < 4; ++k) {
                glm::ivec3 cube = c;
                if (k == 1 || k == 2) --cube[u];
                if (k >= 2) --cube[v];
                quad[k] = vertexOf[cornerIndex(cube)];
            }
            if (!inside) std::swap(quad[1], quad[3]);
            mesh.triangles.emplace_back(quad[0], quad[1], quad[2]);
            mesh.triangles.emplace_back(quad[0], quad[2], quad[3]);
        }
    });
    return mesh;
}

} // namespace shoal::bench
