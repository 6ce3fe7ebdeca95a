// In which blocks of a picture of objects there is anything: most of it is empty.
#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::render {

class Coverage {
  public:
    static constexpr int kBlock = 16; // pixels, along a side

    // Rows without gaps; a pixel of which all bytes are 0 is empty.
    void find(std::span<const uint32_t> pixels, const glm::ivec2& size);

    const glm::ivec2& blocks() const { return blocks_; } // along each axis
    // Whether there is anything in one of the blocks that hold these pixels: low to high, both included. What
    // lies beyond the picture's edges is empty.
    bool any(const glm::ivec2& low, const glm::ivec2& high) const;

  private:
    glm::ivec2 blocks_{0};
    std::vector<uint8_t> covered_; // block by block, row by row
};

} // namespace shoal::render
