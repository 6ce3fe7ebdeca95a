// Layered depth images of the whole scene, rays marched through them. After Niessner, Schaefer and Stamminger
// 2010, "Fast Indirect Illumination Using Layered Depth Images". Ours: three views along the axes, each layer
// marked front or back, so that what lies between is solid and steep surfaces leave no gaps; a ray takes the
// view nearest to it.
#pragma once

#include "tests/baselines/occlusion/Fragments.h"
#include "tests/baselines/occlusion/Visibility.h"

#include <array>
#include <cstdint>

namespace shoal::occlusion::baselines {

class LayeredDepth {
  public:
    // Closed bodies, in the world; they may overlap.
    LayeredDepth(std::span<const Triangles> bodies, int size);

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

} // namespace shoal::occlusion::baselines
