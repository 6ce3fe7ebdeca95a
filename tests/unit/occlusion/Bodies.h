// Bodies made by formula, and their true ray hits.
#pragma once

#include "engine/core/Random.h"
#include "engine/occlusion/BodyMesh.h"
#include "tests/baselines/occlusion/Visibility.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace shoal::occlusion {

inline constexpr float kPi = std::numbers::pi_v<float>;

struct Body {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::uvec3> triangles;

    BodyMesh mesh() const { return {positions, normals, triangles}; }
};

// Sets each position's normal to the area-weighted mean of the triangles around it.
inline void addNormals(Body& body) {
    body.normals.assign(body.positions.size(), glm::vec3(0));
    for (const glm::uvec3& t : body.triangles) {
        const glm::vec3& a = body.positions[t.x];
        const glm::vec3 area = glm::cross(body.positions[t.y] - a, body.positions[t.z] - a);
        for (int k = 0; k < 3; ++k) body.normals[t[k]] += area;
    }
    for (glm::vec3& n : body.normals) n = glm::length(n) > 0 ? glm::normalize(n) : glm::vec3(0, 0, 1);
}

// Adds a sheet of columns x rows cells, place(u, v) for u, v in [0, 1]; u cross v points outside. Rows close
// to a ring over u. Columns do so over v if `ring`, else each end is closed by a point.
inline void addTube(Body& body, int columns, int rows, bool ring,
                    const std::function<glm::vec3(float, float)>& place) {
    const auto first = static_cast<uint32_t>(body.positions.size());
    const int rings = ring ? rows : rows + 1;
    for (int j = 0; j < rings; ++j)
        for (int i = 0; i < columns; ++i)
            body.positions.push_back(place(static_cast<float>(i) / static_cast<float>(columns),
                                           static_cast<float>(j) / static_cast<float>(rows)));
    const auto at = [&](int i, int j) {
        return first + static_cast<uint32_t>((j % rings) * columns + i % columns);
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            body.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            body.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    if (ring) return;
    for (const int j : {0, rows}) {
        glm::vec3 middle(0);
        for (int i = 0; i < columns; ++i) middle += body.positions[at(i, j)] / static_cast<float>(columns);
        const auto tip = static_cast<uint32_t>(body.positions.size());
        body.positions.push_back(middle);
        for (int i = 0; i < columns; ++i)
            j ? body.triangles.emplace_back(at(i, j), at(i + 1, j), tip)
              : body.triangles.emplace_back(at(i + 1, j), at(i, j), tip);
    }
}

// Returns a torus around the y axis.
inline Body torus(float large, float small, int columns, int rows) {
    Body body;
    addTube(body, columns, rows, true, [=](float u, float v) {
        const float a = 2 * kPi * u, b = 2 * kPi * v;
        const float r = large + small * std::cos(b);
        return glm::vec3(r * std::cos(a), -small * std::sin(b), r * std::sin(a));
    });
    addNormals(body);
    return body;
}

// Returns a star-shaped body at radius(direction) from the origin, closed at the poles.
inline Body star(int columns, int rows, const std::function<float(const glm::vec3&)>& radius) {
    Body body;
    addTube(body, columns, rows, false, [&](float u, float v) {
        const float a = -2 * kPi * u;
        const float b = kPi * (0.002f + 0.996f * v);
        const glm::vec3 d(std::sin(b) * std::cos(a), -std::cos(b), std::sin(b) * std::sin(a));
        return d * radius(d);
    });
    addNormals(body);
    return body;
}

inline Body sphere(float radius, int columns = 64, int rows = 32) {
    return star(columns, rows, [=](const glm::vec3&) { return radius; });
}

// Bodies with corners and edges.
inline Body box(const glm::vec3& half) {
    Body body;
    for (int face = 0; face < 6; ++face) {
        const int a = face / 2, b = (a + 1) % 3, c = (a + 2) % 3;
        const float side = face % 2 ? -1.0f : 1.0f;
        const auto first = static_cast<uint32_t>(body.positions.size());
        for (int k = 0; k < 4; ++k) {
            glm::vec3 p;
            p[a] = side * half[a];
            p[b] = (k == 1 || k == 2 ? 1.0f : -1.0f) * half[b];
            p[c] = (k >= 2 ? 1.0f : -1.0f) * half[c];
            body.positions.push_back(p);
            glm::vec3 n(0);
            n[a] = side;
            body.normals.push_back(n);
        }
        const uint32_t i = first + (side > 0 ? 1 : 3), j = first + (side > 0 ? 3 : 1);
        body.triangles.emplace_back(first, i, first + 2);
        body.triangles.emplace_back(first, first + 2, j);
    }
    return body;
}

inline Body oneTriangle() {
    Body body;
    body.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    body.triangles = {{0, 1, 2}};
    addNormals(body);
    return body;
}

// Returns a body like a bunny: a lump with two ears, a snout and a tail.
inline Body bunny() {
    struct Bump {
        glm::vec3 along;
        float height, width;
    };
    static const Bump bumps[] = {{glm::normalize(glm::vec3(0.3f, 1, 0.2f)), 0.9f, 0.2f},
                                 {glm::normalize(glm::vec3(-0.3f, 1, 0.2f)), 0.9f, 0.2f},
                                 {glm::normalize(glm::vec3(0, 0.2f, 1)), 0.5f, 0.45f},
                                 {glm::normalize(glm::vec3(0, -0.5f, -1)), 0.35f, 0.3f}};
    return star(72, 40, [](const glm::vec3& d) {
        float r = 0.7f + 0.1f * std::sin(3 * d.x + 1) * std::cos(2 * d.z);
        for (const Bump& bump : bumps) {
            const float angle = std::acos(glm::clamp(glm::dot(d, bump.along), -1.0f, 1.0f));
            r += bump.height * std::exp(-angle * angle / (bump.width * bump.width));
        }
        return r;
    });
}

// Turns an interpolated normal towards the ray's origin: it may point away where the ray grazes a surface.
inline glm::vec3 towardsOrigin(const glm::vec3& outwards, const glm::vec3& direction, bool fromBehind) {
    const glm::vec3 n = fromBehind ? -outwards : outwards;
    const float away = glm::dot(n, direction);
    return away > 0 ? glm::normalize(n - away * direction) : n;
}

// A ray's first hit beyond `nearest`, from either side, in double precision: Moeller and Trumbore 1997.
struct TrueHit {
    double distance = INFINITY;
    glm::vec3 normal{0}; // of the vertices, blended, towards the origin
    bool fromBehind = false;
};
inline std::optional<TrueHit> truth(const Body& body, const glm::vec3& origin, const glm::vec3& direction,
                                    double nearest) {
    TrueHit best;
    const glm::dvec3 o(origin), d(direction);
    for (const glm::uvec3& t : body.triangles) {
        const glm::dvec3 a(body.positions[t.x]), ab = glm::dvec3(body.positions[t.y]) - a,
                                                 ac = glm::dvec3(body.positions[t.z]) - a;
        const glm::dvec3 p = glm::cross(d, ac);
        const double det = glm::dot(ab, p);
        if (det == 0) continue;
        const glm::dvec3 s = o - a;
        const double u = glm::dot(s, p) / det;
        if (u < 0 || u > 1) continue;
        const glm::dvec3 q = glm::cross(s, ab);
        const double v = glm::dot(d, q) / det;
        if (v < 0 || u + v > 1) continue;
        const double distance = glm::dot(ac, q) / det;
        if (distance <= nearest || distance >= best.distance) continue;
        const glm::vec3 n = glm::normalize(static_cast<float>(1 - u - v) * body.normals[t.x] +
                                           static_cast<float>(u) * body.normals[t.y] +
                                           static_cast<float>(v) * body.normals[t.z]);
        best = {distance, towardsOrigin(n, direction, det < 0), det < 0};
    }
    if (best.distance == INFINITY) return {};
    return best;
}

struct Ray {
    glm::vec3 origin, direction;
};

inline glm::vec3 anyDirection(Random& random) {
    const float z = random.between(-1, 1), a = random.between(0, 2 * kPi), r = std::sqrt(1 - z * z);
    return {r * std::cos(a), r * std::sin(a), z};
}

// Returns a ray from outside through a random point of the bounding sphere.
inline Ray chord(Random& random, const Sphere& sphere) {
    glm::vec3 in;
    do in = glm::vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    while (glm::dot(in, in) > 1);
    const glm::vec3 d = anyDirection(random);
    return {sphere.centre + sphere.radius * (in - 3.0f * d), d};
}

// Returns a ray that is reflected at a random place of the surface, from a random eye.
inline Ray reflection(Random& random, const Body& body) {
    std::vector<float> sums;
    float sum = 0;
    for (const glm::uvec3& t : body.triangles) {
        const glm::vec3& a = body.positions[t.x];
        sums.push_back(sum += glm::length(glm::cross(body.positions[t.y] - a, body.positions[t.z] - a)));
    }
    for (;;) {
        const auto chosen = std::upper_bound(sums.begin(), sums.end(), random.unit() * sum) - sums.begin();
        const glm::uvec3 t =
            body.triangles[static_cast<size_t>(std::min<ptrdiff_t>(chosen, std::ssize(sums) - 1))];
        const float r = std::sqrt(random.unit()), v = random.unit();
        const glm::vec3 weights(1 - r, r * (1 - v), r * v);
        const auto blend = [&](const std::vector<glm::vec3>& of) {
            return weights.x * of[t.x] + weights.y * of[t.y] + weights.z * of[t.z];
        };
        const glm::vec3 n = glm::normalize(blend(body.normals));
        const glm::vec3 flat =
            glm::cross(body.positions[t.y] - body.positions[t.x], body.positions[t.z] - body.positions[t.x]);
        const glm::vec3 look = anyDirection(random);
        if (glm::dot(look, n) >= 0) continue;
        const glm::vec3 out = glm::normalize(glm::reflect(look, n));
        if (glm::dot(out, flat) > 0) return {blend(body.positions), out};
    }
}

} // namespace shoal::occlusion
