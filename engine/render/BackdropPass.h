// Draws the surround behind everything. Pairs with shaders/render/Backdrop.
#pragma once

#include "engine/gl/Variants.h"
#include "engine/render/SurroundGpu.h"
#include "engine/render/View.h"

#include <vector>

namespace shoal::render {

class BackdropPass {
  public:
    static Result<BackdropPass> make();

    // Over the whole picture, before the objects: depth is neither asked nor changed, and need not be there.
    // The program for a curve that is new is compiled first.
    Status draw(const SurroundGpu& surround, const View& view, const glm::mat3& envFromWorld,
                const Exposure& exposure);

  private:
    struct Corner {
        glm::vec2 place, uv;
    };

    // Fills corners_ with four for each cell, polar cells last; returns how many are not polar.
    size_t makeCells(const View& view, const glm::mat3& envFromRay);

    gl::Variants programs_;
    gl::VertexArray vertexArray_;
    gl::Buffer vertices_, indices_; // indices: of as many cells as there have been, the same for all
    size_t indexedCells_ = 0;
    std::vector<glm::vec2> uvs_; // scratch: of the grid's corners
    std::vector<Corner> corners_;
};

} // namespace shoal::render
