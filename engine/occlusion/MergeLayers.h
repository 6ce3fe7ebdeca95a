// Merges the fragments at the sixteen samples of a pixel into layers.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace shoal::occlusion {

// A triangle's surface at one sample.
struct Fragment {
    float depth = 0;      // pixels
    glm::vec3 normal{0};  // unit, view frame
    uint8_t sample = 0;   // 4 y + x in the pixel
    bool towards = false; // whether it is front-facing
};

// A plane through a pixel: depth at its middle, and depth per pixel right and up.
struct Plane {
    float depth = 0;
    glm::vec2 slope{0};
    glm::vec3 normal{0}; // unit, view frame; its z has the sign of the side it faces and is never small
    uint16_t coverage = 0;
};

// Returns the depth per pixel of the plane with this normal, whose z is not zero.
inline glm::vec2 slopeOf(const glm::vec3& normal) { return -glm::vec2(normal) / normal.z; }

// Merges the fragments of one pixel into planes, and appends these to `planes` by ascending depth. Every
// fragment belongs to one plane, every plane covers a sample at most once. Marks all fragments as taken.
void mergeLayers(std::vector<Fragment>& fragments, std::vector<Plane>& planes);

} // namespace shoal::occlusion
