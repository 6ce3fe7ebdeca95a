// Light at places beside a film's camera: what is near to a sunlit rock takes its colour, what stands in a
// cave's mouth less of the light that the camera sees there. Every direction of the film stands at its
// distance; from a place rays are marched to the first that stands on them, as in parallax-corrected cube
// maps (Lagarde and Zanuttini 2012, "Local Image-based Lighting With Parallax-corrected Cubemaps") with the
// film's distances in place of a box. env frame, metres from the film's camera.
#pragma once

#include "engine/core/Image.h"
#include "engine/depth/DepthMap.h"

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace shoal::depth {

// Of radiance, bands 0 to 2, in the order of math::shBasis().
using LightHarmonics = std::array<glm::vec3, 9>;

class LightBeside {
  public:
    // What is further off is endlessly far, and from half of that on ever more so. Places beyond it have the
    // less of this light, from half as far again on none.
    static constexpr float kFar_m = 4;

    // radianceLin: lat-long, the light of the frame that the map belongs to; some 64 texels around. Allocates
    // nothing once it has been made.
    void make(const ImageRgbF& radianceLin, const DepthMap& map);

    // What radiance there is at the place beyond that at the camera. Exactly 0 where all that its rays meet
    // is endlessly far.
    LightHarmonics at(const glm::vec3& placeEnv) const;

  private:
    // Directions lie on an octahedron unfolded to a square (math/Octahedron.h).
    static constexpr int kCoarse = 12, kFine = 48, kAcross = kFine / kCoarse; // rays; distances
    static int cellOf(const glm::vec3& dir);                                  // of the fine grid; dir: not 0
    static glm::vec3 directionOf(int cell, int side);                         // of its middle, unit length
    static const std::vector<glm::vec3>& fineDirections();
    static int coarseOf(int fine) { return fine / kFine / kAcross * kCoarse + fine % kFine / kAcross; }
    int firstMet(const glm::vec3& place, const glm::vec3& dir) const; // a fine cell; -1: none

    struct Ray {
        glm::vec3 dir;
        std::array<float, 9> basis; // times its solid angle
    };
    static const std::array<Ray, kCoarse * kCoarse>& rays();

    std::vector<float> inverse_perM_, near_; // by fine cell; 0: endlessly far, 1: where it stands
    std::vector<glm::vec3> radiance_;        // by coarse cell
};

} // namespace shoal::depth
