#include "tests/bench/occlusion/Mesh.h"
#include "tests/bench/Bench.h"

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

// Returns the closed surface at which a smooth function is 0, negative inside. Each vertex is moved onto the
// surface, and normals are the function's gradient. Naive surface nets (Gibson 1998, "Constrained Elastic
// Surface Nets") on cubes of `cell` metres.
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

using glm::vec2;
using glm::vec3;

// Distances, exact or nearly so. Quilez, "Distance functions".

float ellipsoid(const vec3& p, const vec3& centre, const vec3& radii) {
    const float k0 = glm::length((p - centre) / radii);
    const float k1 = glm::length((p - centre) / (radii * radii));
    return k0 * (k0 - 1) / std::max(k1, 1e-6f);
}

// Round cone by interpolated radius.
float limb(const vec3& p, const vec3& a, const vec3& b, float radiusA, float radiusB) {
    const float t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0f, 1.0f);
    return glm::distance(p, a + t * (b - a)) - glm::mix(radiusA, radiusB, t);
}

// Ring around +Z.
float ring(const vec3& p, float radius, float thickness) {
    return glm::length(vec2(glm::length(vec2(p)) - radius, p.z)) - thickness;
}

// The lesser of two, blended over `width`. Quilez, "Smooth minimum", polynomial.
float blend(float a, float b, float width) {
    const float h = std::max(width - std::abs(a - b), 0.0f) / width;
    return std::min(a, b) - h * h * width * 0.25f;
}

float teapotDistance(const vec3& p) {
    float d = ellipsoid(p, {0, 0, 0}, {0.080f, 0.058f, 0.080f});
    d = blend(d, ellipsoid(p, {0, 0.052f, 0}, {0.046f, 0.014f, 0.046f}), 0.006f);
    d = blend(d, ellipsoid(p, {0, 0.076f, 0}, {0.014f, 0.012f, 0.014f}), 0.012f);
    d = blend(d, limb(p, {0.060f, -0.020f, 0}, {0.105f, 0.012f, 0}, 0.022f, 0.013f), 0.014f);
    d = blend(d, limb(p, {0.105f, 0.012f, 0}, {0.128f, 0.050f, 0}, 0.013f, 0.009f), 0.008f);
    return blend(d, ring(p - vec3(-0.088f, 0.006f, 0), 0.036f, 0.009f), 0.010f);
}

float bunnyDistance(const vec3& p) {
    float d = ellipsoid(p, {0, -0.02f, 0}, {0.058f, 0.055f, 0.075f});
    d = blend(d, ellipsoid(p, {0, 0.048f, 0.060f}, {0.034f, 0.034f, 0.040f}), 0.030f);
    const vec3 side(std::abs(p.x), p.y, p.z);
    d = blend(d, ellipsoid(side, {0.040f, -0.042f, -0.020f}, {0.028f, 0.038f, 0.046f}), 0.012f);
    d = blend(d, limb(side, {0.024f, -0.045f, 0.050f}, {0.026f, -0.066f, 0.082f}, 0.016f, 0.012f), 0.012f);
    d = blend(d, limb(side, {0.012f, 0.070f, 0.048f}, {0.026f, 0.138f, 0.020f}, 0.013f, 0.010f), 0.010f);
    return blend(d, ellipsoid(p, {0, -0.035f, -0.085f}, {0.022f, 0.022f, 0.022f}), 0.008f);
}

} // namespace

Mesh teapot() { return surfaceOf(teapotDistance, {-0.15f, -0.08f, -0.10f}, {0.16f, 0.11f, 0.10f}, 0.0040f); }

Mesh bunny() { return surfaceOf(bunnyDistance, {-0.09f, -0.10f, -0.13f}, {0.09f, 0.17f, 0.12f}, 0.0040f); }

Mesh torus() {
    return surfaceOf(
        [](const vec3& p) {
            return ring({p.x, p.z, p.y}, 0.070f, 0.032f);
        },
        {-0.12f, -0.05f, -0.12f}, {0.12f, 0.05f, 0.12f}, 0.0040f);
}

} // namespace shoal::bench
