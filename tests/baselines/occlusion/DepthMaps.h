// Methods that look orthographically at triangles in software, and keep every fragment, not the nearest
// alone.
#pragma once

#include "tests/baselines/occlusion/Visibility.h"

#include <array>
#include <cstdint>
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

// visit(pixel index, depth, whether the triangle's front faces the viewer) for every covered pixel centre.
template <class Visit> void rasterise(const OrthoView& view, const BodyMesh& body, const Visit& visit) {
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

// Layered depth images of the whole scene, rays marched through them. After Niessner, Schaefer and Stamminger
// 2010, "Fast Indirect Illumination Using Layered Depth Images". Ours: three views along the axes, each layer
// marked front or back, so that what lies between is solid and steep surfaces leave no gaps; a ray takes the
// view nearest to it.
class LayeredDepth {
  public:
    // Closed bodies, in the world; they may overlap.
    LayeredDepth(std::span<const BodyMesh> bodies, int size);

    // Counts what lies beyond `nearest`, which should be a pixel or two: depths are those at pixels' centres.
    bool occluded(const glm::vec3& origin, const glm::vec3& direction, float nearest) const;
    float pixel_m() const { return 1 / views_[0].view.pixelsPerMetre(); }
    std::size_t bytes() const;

  private:
    struct View {
        OrthoView view;
        std::vector<uint32_t> first; // per pixel and one more: index of its first layer
        std::vector<float> solid;    // pairs: where matter begins and where it ends, by depth
    };
    std::array<View, 3> views_;
};

// A shadow map from each of many directions, compressed by their likeness. Ritschel, Grosch, Kautz and
// Mueller 2007, "Interactive Illumination with Coherent Shadow Maps": any depth between the first surface and
// the second casts the same shadow, so one value serves a pixel for as many successive directions as their
// intervals share.
class CoherentShadowMaps {
  public:
    // Closed bodies, in the world. directions: light travels against them; any order, alike ones should
    // follow another.
    CoherentShadowMaps(std::span<const BodyMesh> bodies, std::span<const glm::vec3> directions, int size);

    // Whether a point on the surface of a body is occluded in the direction of this index.
    bool occluded(const glm::vec3& position, size_t direction) const;
    std::size_t bytes() const {
        return runs_.size() * sizeof(Run) + first_.size() * sizeof(uint32_t) + views_.size() * 12;
    }
    // Uncompressed.
    std::size_t plainBytes() const { return first_.size() * views_.size() * sizeof(uint16_t); }

  private:
    struct Run {
        uint16_t from = 0;  // direction that it begins with
        uint16_t depth = 0; // 0 the near end of the sphere, 65535 nothing there
    };
    std::vector<OrthoView> views_;
    std::vector<uint32_t> first_; // per pixel and one more
    std::vector<Run> runs_;
    float depthScale_ = 1;
};

// Directions along a spiral from pole to pole: each is near the one before.
std::vector<glm::vec3> spiralDirections(int count);

} // namespace shoal::occlusion::baselines
