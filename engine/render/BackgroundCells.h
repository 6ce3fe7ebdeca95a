// Divides a view of an equirectangular map into rectangles within which the map's coordinates are affine to a
// tenth of a texel, so that no pixel needs trigonometry.
#pragma once

#include "engine/render/View.h"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace shoal::render {

struct BackgroundCell {
    glm::ivec2 low{0}, high{0};          // of the picture's pixels, from the bottom
    glm::vec2 first{0}, right{0}, up{0}; // of the map: at the corner, and from there to the next ones
    bool polar = false;                  // so near a pole that coordinates have to be found for each pixel

    // What it shows lies between these.
    glm::vec2 mapLow() const { return first + glm::min(right, 0.0f) + glm::min(up, 0.0f); }
    glm::vec2 mapHigh() const { return first + glm::max(right, 0.0f) + glm::max(up, 0.0f); }
};

struct CellToDraw {
    const BackgroundCell* cell;
    bool painted; // shows the frame with objects in it, else the environment's own
};

class BackgroundCells {
  public:
    // size: in pixels. Nothing allocates once there have been as many.
    void make(const View& view, const glm::mat3& envFromRay, const glm::ivec2& size);

    std::span<const BackgroundCell> all() const { return cells_; } // row by row
    int columns() const { return static_cast<int>(columns_.size()) - 1; }
    int rows() const { return static_cast<int>(rows_.size()) - 1; }

  private:
    std::vector<BackgroundCell> cells_;
    std::vector<int> columns_, rows_; // edges, in pixels
    std::vector<glm::vec2> uvs_;      // scratch: of corners
};

} // namespace shoal::render
