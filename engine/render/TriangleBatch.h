// Triangles in a plane, new in every frame: of the picture or of a map, as the vertex shader takes them
// (ATTRIBUTE_POSITION, two floats).
#pragma once

#include "engine/gl/Objects.h"

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace shoal::render {

class TriangleBatch {
  public:
    static TriangleBatch make();

    // Three corners a triangle, with the program in use, regardless of depth and of which way round.
    void draw(std::span<const glm::vec2> corners);
    // The same, over what is there: colours premultiplied by alpha.
    void drawOver(std::span<const glm::vec2> corners);

  private:
    gl::VertexArray vertexArray_;
    gl::Buffer vertices_;
};

// Two triangles.
void addRectangle(const glm::vec2& low, const glm::vec2& high, std::vector<glm::vec2>& corners);

// run(first, end, row) for each longest row of neighbours that are marked. marked: row by row, cells.x of
// them in each.
template <class Run> void eachRun(const std::vector<bool>& marked, const glm::ivec2& cells, Run&& run) {
    for (int y = 0; y < cells.y; ++y)
        for (int x = 0; x < cells.x; ++x) {
            const int first = x;
            while (x < cells.x && marked[static_cast<size_t>(y * cells.x + x)]) ++x;
            if (x > first) run(first, x, y);
        }
}

} // namespace shoal::render
