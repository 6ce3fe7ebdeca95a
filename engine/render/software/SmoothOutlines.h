// Anti-aliasing of a picture of objects that has one sample a pixel: morphological, of outlines only
// (Reshetov 2009, "Morphological Antialiasing"), by alpha, so that nothing within an outline is blurred.
#pragma once

#include "engine/render/software/Coverage.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace shoal::render {

// Where alpha steps between two rows or columns, the outline is taken for straight between the ends of that
// step, half a pixel to the side to which it bends there; a pixel takes from its neighbour across as much as
// lies beyond the line. Straight outlines come out as their coverage to 0.11 (root mean square; 0.26 before).
class OutlineSmoother {
  public:
    // Premultiplied, alpha in the highest byte; rows without gaps. Pixels at the edges stay. coverage: of
    // these pixels; outlines reach one pixel further afterwards.
    void smooth(std::span<uint32_t> pixels, const glm::ivec2& size, const Coverage& coverage);

  private:
    // Pixels low to high - 1, of which none is at an edge.
    void smoothBlock(std::span<const uint32_t> pixels, const glm::ivec2& size, const glm::ivec2& low,
                     const glm::ivec2& high);

    std::vector<std::pair<size_t, uint32_t>> changed_; // scratch: pixels and their new values
};

} // namespace shoal::render
