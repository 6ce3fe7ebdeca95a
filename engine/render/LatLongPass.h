// Lets objects be part of the video's frame: a layer of them, as an eye sees it, goes into the frame's own
// lat-long texels, only those that it covers, and is then shown with them by the backdrop. Pairs with
// shaders/render/LatLong.
//
// Each texel takes what the layer shows in its middle's direction, so that no triangle is ever drawn in the
// lat-long map, where straight edges bend and a pole tears them apart: seam and poles need no care.
#pragma once

#include "engine/gl/Variants.h"
#include "engine/render/Corners.h"
#include "engine/render/FilmedTexels.h"
#include "engine/render/FrameTiles.h"
#include "engine/render/SurroundGpu.h"
#include "engine/render/View.h"

#include <vector>

namespace shoal::render {

// The same eye, but so much wider (1: not at all): the backdrop's filter reaches beyond the picture's edge.
View widened(const View& view, float factor);

class LatLongPass {
  public:
    static Result<LatLongPass> make();

    // Into the texels of the chosen tiles: there must be nothing in the layer beside them. layer: a texture
    // of display values, premultiplied, seen by layerView. What the texels held is kept aside. Leaves another
    // framebuffer bound. Display-coded frames only. filmed: null for the layer as it is; the program for a
    // look of a new kind is compiled first.
    Status paint(const SurroundGpu& surround, const FrameTiles& tiles, GLuint layer, const View& layerView,
                 const glm::mat3& envFromWorld, const Filmed* filmed = nullptr);

    // Gives the texels back what they held, unless the surround has a new frame since.
    void restore(const SurroundGpu& surround);

  private:
    struct Run { // of tiles in a row, in texels
        int x, y, width, height;
    };
    void copy(GLuint from, GLuint to) const; // the runs

    gl::Variants programs_;
    gl::Texture grain_; // once something is filmed
    Corners drawn_;
    gl::Texture kept_;
    gl::Framebuffer frameBuffer_, keptBuffer_;
    glm::ivec2 keptSize_{0};         // of the frame
    uint64_t paintedFrame_ = 0;      // its number; 0: nothing is painted
    std::vector<Run> runs_;          // of tiles that are painted
    std::vector<glm::vec2> corners_; // scratch: of their triangles, uv
};

} // namespace shoal::render
