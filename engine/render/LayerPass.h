// Lets objects share the video's resolution: they are drawn into a smaller picture of their own, which is
// then scaled up and laid over the backdrop, as the backdrop's texels are scaled up themselves. Pairs with
// shaders/render/Layer.
#pragma once

#include "engine/gl/Program.h"
#include "engine/gl/Target.h"
#include "engine/render/Corners.h"
#include "engine/render/View.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace shoal::render {

// A part of the picture: -1 to 1, right and up positive.
struct Box {
    glm::vec2 low{-1}, high{1};
};

// In which the ball is seen; all of the picture where it surrounds the eye. May reach beyond the edges.
Box boxAround(const glm::vec3& centreWorld, float radius, const View& view);

// How large a picture of `pixels` has to be drawn to show as many pixels in its middle, where a picture of a
// plane is coarsest, as a lat-long frame of so many rows has: never more than `pixels`.
glm::ivec2 sizeAsFine(const View& view, glm::ivec2 pixels, int frameRows);

class LayerPass {
  public:
    static Result<LayerPass> make();

    // What is drawn next goes into the layer, which is empty: colours premultiplied by alpha.
    void begin(glm::ivec2 size, int samples);

    // Nothing more is drawn into it; leaves another framebuffer bound.
    void end() const { layer_->resolve(); }

    // What is in it: blue first, premultiplied, rows from the bottom. Waits until it is drawn; leaves another
    // framebuffer bound. Good until the next call.
    std::span<const uint32_t> read();

    // Over the bound framebuffer, wherever one of the boxes is: there must be nothing in the layer beside
    // them.
    void layOver(std::span<const Box> boxes);

    const gl::Target& layer() const { return *layer_; } // after begin()

  private:
    gl::Program program_;
    Corners drawn_;
    std::optional<gl::Target> layer_;
    int samples_ = 0;
    std::vector<uint32_t> pixels_;   // scratch: what was read
    std::vector<bool> marked_;       // scratch: the cells of a grid over the picture
    std::vector<glm::vec2> corners_; // scratch: of their triangles
};

} // namespace shoal::render
