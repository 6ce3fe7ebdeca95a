// An orthographic look at triangles in software: every fragment, not the nearest alone.
#pragma once

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace shoal::occlusion::baselines {

// Square, size x size pixels, over a sphere. Pixel (x, y) spans [x, x + 1) by [y, y + 1); depth in metres
// along `along`.
struct OrthoView {
    glm::vec3 right{1, 0, 0}, up{0, 1, 0}, along{0, 0, 1}; // orthonormal
    glm::vec3 centre{0};                                   // of the sphere
    float radius = 1;                                      // metres
    int size = 64;

    float pixelsPerMetre() const { return static_cast<float>(size) / (2 * radius); }
    // x, y in pixels; z the depth, 0 in the middle of the sphere.
    glm::vec3 toView(const glm::vec3& world) const {
        const glm::vec3 p = world - centre;
        const float half = 0.5f * static_cast<float>(size);
        return {half + glm::dot(p, right) * pixelsPerMetre(), half + glm::dot(p, up) * pixelsPerMetre(),
                glm::dot(p, along)};
    }
};

OrthoView viewAlong(const glm::vec3& direction, const glm::vec3& centre, float radius, int size);

struct Triangles {
    std::span<const glm::vec3> positions; // world
    std::span<const glm::uvec3> triangles;
};

struct Sphere {
    glm::vec3 centre{0};
    float radius = 0;
};
Sphere boundingSphereOf(std::span<const Triangles> bodies); // around their box

// visit(pixel index, depth, whether the triangle's front faces the viewer) for every covered pixel centre.
template <class Visit> void rasterise(const OrthoView& view, const Triangles& body, const Visit& visit) {
    for (const glm::uvec3& corner : body.triangles) {
        const glm::vec3 a = view.toView(body.positions[corner.x]), b = view.toView(body.positions[corner.y]),
                        c = view.toView(body.positions[corner.z]);
        const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (area == 0) continue;
        const glm::vec2 low =
            glm::max(glm::ceil(glm::min(glm::min(glm::vec2(a), glm::vec2(b)), glm::vec2(c)) - 0.5f), 0.0f);
        const glm::vec2 high = glm::min(glm::max(glm::max(glm::vec2(a), glm::vec2(b)), glm::vec2(c)) - 0.5f,
                                        static_cast<float>(view.size - 1));
        for (float y = low.y; y <= high.y; ++y)
            for (float x = low.x; x <= high.x; ++x) {
                const glm::vec2 p(x + 0.5f, y + 0.5f);
                const float u = ((p.x - a.x) * (c.y - a.y) - (p.y - a.y) * (c.x - a.x)) / area;
                const float v = ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / area;
                if (u < 0 || v < 0 || u + v > 1) continue;
                visit(static_cast<int>(y) * view.size + static_cast<int>(x),
                      a.z + u * (b.z - a.z) + v * (c.z - a.z), area < 0);
            }
    }
}

} // namespace shoal::occlusion::baselines
