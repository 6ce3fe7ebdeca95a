// Anti-aliasing of a picture of objects with one sample a pixel: morphological (Reshetov 2009, "Morphological
// Antialiasing"), by alpha, of outlines only, so that nothing within an outline is blurred.
#pragma once

#include "engine/render/software/Coverage.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace shoal::render {

// Where alpha steps between two rows or columns, the outline is assumed to be straight between the step's
// ends, half a pixel to the side to which it bends there; a pixel takes from its neighbour across the share
// beyond that line. Straight outlines match their coverage to 0.11 (root mean square; 0.26 before).
class OutlineSmoother {
  public:
    // Smooths a picture: premultiplied, alpha in the highest byte, rows without gaps. Pixels at the edges
    // stay. coverage: of these pixels; outlines reach one pixel further afterwards.
    void smooth(std::span<uint32_t> pixels, const glm::ivec2& size, const Coverage& coverage);

  private:
    // Smooths pixels low to high - 1, none of which is at an edge.
    void smoothBlock(std::span<const uint32_t> pixels, const glm::ivec2& size, const glm::ivec2& low,
                     const glm::ivec2& high);

    std::vector<std::pair<size_t, uint32_t>> changed_; // scratch: pixels and their new values
};

} // namespace shoal::render
