// In-scattered light: what the water scatters towards the camera from each direction, up to each distance
// along it.
#pragma once

#include "content/make/video/Sea.h"
#include "content/make/video/World.h"

namespace shoal::reef {

class Veil {
  public:
    // Marches from the camera through sunlight, shadow and caustics (shafts), lamps, and the ambient grid.
    // width: width of the picture that it is for; the veil is at most 512 wide.
    void fill(const Scene& scene, const World& world, const Caustics& caustics, const vec3& camera,
              int width);
    // uv: lat-long; distance in metres.
    vec3 at(const vec2& uv, float distance) const;

  private:
    static constexpr int kSlices = 26, kFinest = 512;
    static constexpr float kNearest = 0.35f, kRatio = 0.1646f, kFirst = 0.56f; // edges at 0.11 .. 45 m
    static float edge(int slice);
    void smooth();
    int width_ = kFinest, height_ = kFinest / 2; // powers of two
    std::vector<vec3> cells_;                    // [row][column][slice]: scattered up to the slice's far edge
};

} // namespace shoal::reef
