#include "engine/scene/Vertices.h"

#include <glm/geometric.hpp>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace shoal::scene {

namespace {

template <class T> void take(std::vector<T>& values, std::span<const uint32_t> source) {
    if (values.empty()) return;
    std::vector<T> taken(source.size());
    for (size_t i = 0; i < source.size(); ++i) taken[i] = values[source[i]];
    values = std::move(taken);
}

// Returns the triangles' normals, three times each. vertex(i): position of vertex i, as doubles.
template <class Vertex> std::vector<glm::vec3> flatNormals(size_t count, Vertex vertex) {
    std::vector<glm::vec3> normals(count);
    for (size_t i = 0; i + 2 < count; i += 3) {
        const glm::dvec3 a = vertex(i), b = vertex(i + 1), c = vertex(i + 2);
        normals[i] = normals[i + 1] = normals[i + 2] = safeNormalize(glm::cross(b - a, c - a), {0, 1, 0});
    }
    return normals;
}

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

// Returns for each vertex an index that all with the same position, normal and texture coordinates share.
std::vector<uint32_t> weld(const Primitive& primitive, const std::vector<glm::vec2>& uv) {
    std::vector<std::array<float, 8>> keys(primitive.positions.size());
    for (size_t v = 0; v < keys.size(); ++v) {
        const glm::vec3 &p = primitive.positions[v], &n = primitive.normals[v];
        keys[v] = {p.x, p.y, p.z, n.x, n.y, n.z, uv[v].x, uv[v].y};
        for (float& number : keys[v]) number += 0.0f; // -0 becomes 0: bytes are compared
    }
    std::vector<uint32_t> welded(keys.size());
    meshopt_generateVertexRemap(welded.data(), nullptr, keys.size(), keys.data(), keys.size(),
                                sizeof keys[0]);
    return welded;
}

// Orientation of a texture on a triangle: u, v (v downwards) turn the same way as the corners, or the other
// way, or the triangle has no area in space or in the texture.
enum Hand : uint8_t { kTurnsWith, kTurnsAgainst, kFlat };
struct Mapping {
    glm::vec3 alongU{0}; // unit
    Hand hand = kFlat;
};

Mapping mappingOf(const std::array<glm::dvec3, 3>& p, const std::array<glm::dvec2, 3>& uv) {
    const glm::dvec2 e1 = uv[1] - uv[0], e2 = uv[2] - uv[0];
    const double twiceArea = e1.x * e2.y - e1.y * e2.x;
    // Solves p1 - p0 = e1.u U + e1.v V and p2 - p0 = e2.u U + e2.v V for U up to its length.
    const glm::dvec3 along = (e2.y * (p[1] - p[0]) - e1.y * (p[2] - p[0])) * (twiceArea < 0 ? -1.0 : 1.0);
    const glm::vec3 alongU = safeNormalize(along, glm::vec3(0));
    const bool flat =
        p[0] == p[1] || p[1] == p[2] || p[2] == p[0] || twiceArea == 0 || alongU == glm::vec3(0);
    return {alongU, flat ? kFlat : twiceArea > 0 ? kTurnsWith : kTurnsAgainst};
}

constexpr size_t kMinTriangles = 24;                               // of a level of detail
constexpr float kLargestError = 0.1f;                              // of the primitive's extent
constexpr float kStated = MESHOPTIMIZER_VERSION < 200 ? 1 : 0.25f; // reported share: a quarter from 0.20 on

} // namespace

glm::vec3 safeNormalize(const glm::dvec3& v, const glm::vec3& otherwise) {
    const double length = glm::length(v);
    if (!std::isfinite(length) || length == 0) return otherwise;
    return glm::vec3(v / length);
}

glm::vec3 perpendicular(const glm::vec3& unit) {
    // The cross product with the axis along which the vector's component is smallest.
    const glm::vec3 size = glm::abs(unit);
    glm::vec3 axis(0);
    axis[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1;
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
    }
}

void makeFlatNormals(Primitive& primitive) {
    primitive.tangents.clear();
    const std::vector<uint32_t> source = std::move(primitive.indices);
    takeVertices(primitive, source);
    primitive.indices.resize(source.size());
    std::iota(primitive.indices.begin(), primitive.indices.end(), 0u);

    const auto& p = primitive.positions;
    primitive.normals = flatNormals(p.size(), [&](size_t i) { return glm::dvec3(p[i]); });
    for (MorphTarget& target : primitive.morphTargets) {
        const auto& d = target.positions;
        target.normals.clear();
        if (d.empty()) continue;
        target.normals = flatNormals(p.size(), [&](size_t i) { return glm::dvec3(p[i]) + glm::dvec3(d[i]); });
        for (size_t i = 0; i < p.size(); ++i) target.normals[i] -= primitive.normals[i];
    }
}

TangentSplit makeTangents(const Primitive& primitive, int texCoord) {
    const std::vector<glm::vec2>& uv = primitive.texCoords[texCoord];
    const std::vector<uint32_t>& indices = primitive.indices;
    const std::vector<uint32_t> welded = weld(primitive, uv);
    // Tangent sums over all triangles that meet in a welded vertex, one for each Hand.
    std::vector<std::array<glm::vec3, 2>> sums(welded.size(), {glm::vec3(0), glm::vec3(0)});
    std::vector<std::array<bool, 2>> any(welded.size(), {false, false});
    std::vector<Hand> hands;
    for (size_t i = 0; i < indices.size(); i += 3) {
        std::array<glm::dvec3, 3> p;
        std::array<glm::dvec2, 3> texel;
        for (size_t k = 0; k < 3; ++k)
            p[k] = primitive.positions[indices[i + k]], texel[k] = uv[indices[i + k]];
        const Mapping mapping = mappingOf(p, texel);
        hands.push_back(mapping.hand);
        if (mapping.hand == kFlat) continue;
        // Projects the tangent into the plane of each corner's normal, weighted by the corner's angle there.
        for (size_t k = 0; k < 3; ++k) {
            const glm::dvec3 n(primitive.normals[indices[i + k]]);
            const auto inPlane = [&](const glm::dvec3& v) {
                return safeNormalize(v - n * glm::dot(n, v), glm::vec3(0));
            };
            const glm::vec3 next = inPlane(p[(k + 1) % 3] - p[k]), last = inPlane(p[(k + 2) % 3] - p[k]);
            const float angle = std::acos(std::clamp(glm::dot(next, last), -1.0f, 1.0f));
            sums[welded[indices[i + k]]][mapping.hand] += angle * inPlane(glm::dvec3(mapping.alongU));
            any[welded[indices[i + k]]][mapping.hand] = true;
        }
    }
    // A flat triangle takes the hand that other triangles have at the corner, kTurnsAgainst by default.
    const auto handAt = [&](size_t corner) {
        if (hands[corner / 3] != kFlat) return hands[corner / 3];
        const auto& there = any[welded[indices[corner]]];
        return there[kTurnsWith] && !there[kTurnsAgainst] ? kTurnsWith : kTurnsAgainst;
    };

    TangentSplit result;
    std::vector<std::array<uint32_t, 2>> place(welded.size(), {kNone, kNone});
    for (size_t corner = 0; corner < indices.size(); ++corner) place[indices[corner]][handAt(corner)] = 0;
    for (uint32_t v = 0; v < place.size(); ++v)
        for (const Hand hand : {kTurnsWith, kTurnsAgainst}) {
            if (place[v][hand] == kNone) continue;
            place[v][hand] = static_cast<uint32_t>(result.source.size());
            result.source.push_back(v);
            const glm::dvec3 sum(sums[welded[v]][hand]);
            // v grows downwards in textures: where u, v turn with the corners, cross(normal, u) points down.
            result.tangents.emplace_back(safeNormalize(sum, perpendicular(primitive.normals[v])),
                                         hand == kTurnsWith ? -1.0f : 1.0f);
        }
    for (size_t corner = 0; corner < indices.size(); ++corner)
        result.indices.push_back(place[indices[corner]][handAt(corner)]);
    return result;
}

std::vector<Lod> makeLods(const Primitive& primitive, std::span<const glm::vec3> posed) {
    std::vector<Lod> lods;
    if (!primitive.morphTargets.empty() || posed.empty()) return lods;
    const size_t vertexCount = posed.size();
    const float* positions = &posed[0].x;
    const float extent = meshopt_simplifyScale(positions, vertexCount, sizeof(glm::vec3));
    std::vector<uint32_t> coarser(primitive.indices.size()), every(vertexCount); // every: all vertices
    std::iota(every.begin(), every.end(), 0u);
    const auto keep = [&](float relativeError) {
        meshopt_optimizeVertexCache(coarser.data(), coarser.data(), coarser.size(), vertexCount);
        Lod& lod = lods.emplace_back(Lod{every, coarser, relativeError * extent});
        lod.vertices.resize(meshopt_optimizeVertexFetch(lod.vertices.data(), lod.indices.data(),
                                                        lod.indices.size(), every.data(), vertexCount,
                                                        sizeof every[0]));
        lod.vertices.shrink_to_fit();
    };
    // Each level is made from the original mesh, so that errors do not add up.
    size_t triangles = primitive.indices.size() / 3;
    while (triangles >= 2 * kMinTriangles) {
        float error = 0;
        coarser.resize(primitive.indices.size());
        coarser.resize(meshopt_simplify(coarser.data(), primitive.indices.data(), primitive.indices.size(),
                                        positions, vertexCount, sizeof(glm::vec3), triangles / 2 * 3,
                                        kStated * kLargestError, 0, &error));
        if (coarser.empty() || coarser.size() / 3 * 4 > triangles * 3) break; // hardly fewer triangles
        triangles = coarser.size() / 3;
        keep(error / kStated);
    }
    // A mesh of many small parts cannot be reduced with its topology, which nobody sees from afar.
    if (triangles >= 3 * kMinTriangles) {
        float error = 0;
        coarser.resize(primitive.indices.size());
        coarser.resize(meshopt_simplifySloppy(coarser.data(), primitive.indices.data(),
                                              primitive.indices.size(), positions, vertexCount,
                                              sizeof(glm::vec3), triangles / 3 * 3, 1.0f, &error));
        const float before = lods.empty() ? 0 : lods.back().error / extent;
        if (!coarser.empty() && coarser.size() / 3 * 2 < triangles) keep(std::max(error, before * 1.01f));
    }
    return lods;
}

} // namespace shoal::scene
