// Finds the blocks of a picture that show objects: most of it is empty.
#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::render {

class Coverage {
  public:
    static constexpr int kBlock = 16; // pixels, along a side

    // Finds the blocks. Rows are without gaps; a pixel whose bytes are all 0 is empty.
    void find(std::span<const uint32_t> pixels, const glm::ivec2& size);

    const glm::ivec2& blocks() const { return blocks_; } // along each axis
    // Returns whether a block that holds any of these pixels shows an object. low to high: both included;
    // beyond the picture's edges all is empty.
    bool any(const glm::ivec2& low, const glm::ivec2& high) const;

  private:
    glm::ivec2 blocks_{0};
    std::vector<uint8_t> covered_; // block by block, row by row
};

} // namespace shoal::render
