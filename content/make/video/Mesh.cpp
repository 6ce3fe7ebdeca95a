#include "content/make/video/Mesh.h"

#include <cmath>
#include <numbers>

namespace shoal::reef {

void Mesh::add(const Mesh& part, const glm::mat3& turn, float size, const vec3& place, const vec3& tint) {
    const auto base = static_cast<uint32_t>(vertices.size());
    for (Vertex v : part.vertices) {
        v.p = place + turn * (v.p * size);
        v.normal = turn * v.normal;
        v.albedo = glm::clamp(v.albedo * tint, 0.01f, 0.85f);
        v.sway *= size;
        vertices.push_back(v);
    }
    for (const glm::uvec3& t : part.triangles) triangles.push_back(t + base);
}

void Mesh::makeNormals() {
    for (Vertex& v : vertices) v.normal = vec3(0);
    for (const glm::uvec3& t : triangles) {
        const vec3 n = glm::cross(vertices[t.y].p - vertices[t.x].p, vertices[t.z].p - vertices[t.x].p);
        for (int i = 0; i < 3; ++i) vertices[t[i]].normal += n;
    }
    for (Vertex& v : vertices) {
        const float length = glm::length(v.normal);
        v.normal = length > 0 ? v.normal / length : vec3(0, 1, 0);
    }
}

void Mesh::addGrid(int columns, int rows, bool round, const std::function<Vertex(float, float)>& at) {
    const auto base = static_cast<uint32_t>(vertices.size());
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            add(at(static_cast<float>(i) / static_cast<float>(round ? columns : columns - 1),
                   static_cast<float>(j) / static_cast<float>(rows - 1)));
    for (int j = 0; j + 1 < rows; ++j)
        for (int i = 0; i < (round ? columns : columns - 1); ++i) {
            const auto index = [&](int x, int y) {
                return base + static_cast<uint32_t>(y * columns + x % columns);
            };
            triangles.push_back({index(i, j), index(i, j + 1), index(i + 1, j)});
            triangles.push_back({index(i + 1, j), index(i, j + 1), index(i + 1, j + 1)});
        }
}

void Mesh::addTube(const std::vector<vec3>& points, const std::vector<float>& radii, int sides,
                   const std::function<vec3(float)>& albedoAlong, Kind kind, float swayAtEnd) {
    constexpr float kTurn = 2 * std::numbers::pi_v<float>;
    const size_t last = points.size() - 1;
    addGrid(sides, static_cast<int>(points.size()), true, [&](float u, float v) {
        const auto i = static_cast<size_t>(std::lround(v * static_cast<float>(last)));
        const vec3 along = glm::normalize(points[std::min(i + 1, last)] - points[i > 0 ? i - 1 : 0]);
        const glm::mat3 frame = frameAlong(along, 0);
        const vec3 out = frame * vec3(std::cos(-u * kTurn), 0, std::sin(-u * kTurn));
        return Vertex{points[i] + out * radii[i], out, albedoAlong(v), kind, swayAtEnd * v * v};
    });
}

glm::mat3 frameAlong(const vec3& up, float angle) {
    const vec3 any = std::fabs(up.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0);
    const vec3 x0 = glm::normalize(glm::cross(any, up)), z0 = glm::cross(x0, up);
    const vec3 x = x0 * std::cos(angle) + z0 * std::sin(angle);
    return {x, up, glm::cross(x, up)};
}

} // namespace shoal::reef
