// Ways to have the light at a place beside a film's camera from the camera's light and distances, to be
// measured beside the engine's (engine/depth/LightDifference.h).
#pragma once

#include "engine/depth/LightDifference.h"
#include "engine/math/SphericalHarmonics.h"
#include "engine/media/DepthTrack.h"

#include <vector>

namespace shoal::bench {

// A frame's light as patches of what the film shows: lat-long texels, each at its distance. env frame,
// metres.
class Patches {
  public:
    // Texels farther than far_m count as endlessly far; from half of that on ever more so.
    Patches(const ImageRgbF& radianceLin, const media::DepthFrame& depth, float far_m);

    // At the camera, of the same texels.
    depth::LightHarmonics atCamera() const { return camera_; }

    // Every texel is a disc that faces the camera, seen from the place; all together fill the sphere.
    depth::LightHarmonics discs(const glm::vec3& place) const;
    // The same as pieces of the surface that neighbouring texels lie on.
    depth::LightHarmonics surface(const glm::vec3& place) const;

  private:
    struct Patch {
        glm::vec3 place, normal;
        glm::vec3 radiance;
        float area;       // square metres
        float facingArea; // the same, of a disc that faces the camera
    };
    glm::vec3 direction(int x, int y) const;

    int width_, height_;
    std::vector<Patch> patches_;
    depth::LightHarmonics camera_{};
};

} // namespace shoal::bench
