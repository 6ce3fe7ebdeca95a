#include "engine/scene/Vertices.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numeric>

namespace shoal::scene {

namespace {

template <class T> void take(std::vector<T>& values, std::span<const uint32_t> source) {
    if (values.empty()) return;
    std::vector<T> taken(source.size());
    for (size_t i = 0; i < source.size(); ++i) taken[i] = values[source[i]];
    values = std::move(taken);
}

glm::vec3 triangleNormal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return safeNormalize(glm::cross(b - a, c - a), {0, 1, 0});
}

} // namespace

glm::vec3 safeNormalize(const glm::dvec3& v, const glm::vec3& otherwise) {
    const double length = glm::length(v);
    if (!std::isfinite(length) || length == 0) return otherwise;
    return glm::vec3(v / length);
}

glm::vec3 perpendicular(const glm::vec3& unit) {
    // Crossed with the axis that it leans on least.
    const glm::vec3 size = glm::abs(unit);
    glm::vec3 axis(0, 0, 1);
    if (size.x <= size.y && size.x <= size.z)
        axis = {1, 0, 0};
    else if (size.y <= size.z)
        axis = {0, 1, 0};
    return glm::normalize(glm::cross(axis, unit));
}

void takeVertices(Primitive& primitive, std::span<const uint32_t> source) {
    take(primitive.positions, source);
    take(primitive.normals, source);
    take(primitive.tangents, source);
    for (auto& set : primitive.texCoords) take(set, source);
    take(primitive.coloursLin, source);
    take(primitive.joints, source);
    take(primitive.weights, source);
    for (MorphTarget& target : primitive.morphTargets) {
        take(target.positions, source);
        take(target.normals, source);
        take(target.tangents, source);
    }
}

void makeFlatNormals(Primitive& primitive) {
    primitive.normals.clear();
    primitive.tangents.clear();
    for (MorphTarget& target : primitive.morphTargets) target.normals.clear(), target.tangents.clear();
    const std::vector<uint32_t> source = std::move(primitive.indices);
    takeVertices(primitive, source);
    primitive.indices.resize(source.size());
    std::iota(primitive.indices.begin(), primitive.indices.end(), 0u);

    const auto& p = primitive.positions;
    primitive.normals.resize(p.size());
    for (size_t i = 0; i + 2 < p.size(); i += 3)
        primitive.normals[i] = primitive.normals[i + 1] = primitive.normals[i + 2] =
            triangleNormal(p[i], p[i + 1], p[i + 2]);
    for (MorphTarget& target : primitive.morphTargets) {
        const auto& d = target.positions;
        if (d.empty()) continue;
        target.normals.resize(p.size());
        for (size_t i = 0; i + 2 < p.size(); i += 3) {
            const glm::vec3 morphed = triangleNormal(glm::dvec3(p[i]) + glm::dvec3(d[i]),
                                                     glm::dvec3(p[i + 1]) + glm::dvec3(d[i + 1]),
                                                     glm::dvec3(p[i + 2]) + glm::dvec3(d[i + 2]));
            target.normals[i] = target.normals[i + 1] = target.normals[i + 2] =
                morphed - primitive.normals[i];
        }
    }
}

} // namespace shoal::scene
