// An off-screen picture of the objects alone, at its own resolution. The pass composites it over the
// background, enlarged as much as the background's texels are. Pairs with shaders/render/Layer.
#pragma once

#include "engine/gl/Program.h"
#include "engine/gl/Target.h"
#include "engine/render/TriangleBatch.h"
#include "engine/render/View.h"
#include "engine/render/software/SmoothOutlines.h"

#include <optional>
#include <vector>

namespace shoal::render {

// Returns the size, at most `pixels`, at which a picture is as fine as a lat-long frame of frameRows rows.
// The two are compared in the picture's middle, where a perspective picture is coarsest.
glm::ivec2 sizeAsFine(const View& view, glm::ivec2 pixels, int frameRows);

// Returns the view of the same eye with an image plane larger by factor.
View widened(const View& view, float factor);

class LayerPass {
  public:
    static Result<LayerPass> make();

    // Empties the layer; what is drawn next goes into it, with colours premultiplied by alpha.
    void begin(glm::ivec2 size, int samples);

    // Ends drawing into the layer; leaves another framebuffer bound.
    void end() const { layer_->resolve(); }

    // Antialiases outlines in the layer after end(), instead of multisampling. Waits until the layer is
    // drawn, so it suits software renderers.
    void smoothOutlines();

    // Lays the layer over the bound framebuffer. If its pixels have been read, draws only the cells of the
    // picture that are not empty.
    void layOver();
    // Lays it over rectangles of addRectangle(), in normalised device coordinates.
    void layOver(const std::vector<glm::vec2>& corners);

    // Valid after begin().
    glm::ivec2 size() const { return {layer_->width(), layer_->height()}; }
    const gl::Target& layer();
    GLuint texture() const { return layer_->texture(); } // without what smoothOutlines() has changed
    // Returns the pixels after end(), blue first, from the lowest row; waits for them on the first call.
    std::vector<uint32_t>& pixels();
    // Returns whether anything has been drawn into the pixels from low to high - 1, or a few beside them;
    // after pixels().
    bool holdsAnything(const glm::ivec2& low, const glm::ivec2& high) const;

  private:
    gl::Program program_;
    TriangleBatch drawn_;
    std::optional<gl::Target> layer_;
    int samples_ = 0;
    std::vector<uint32_t> pixels_;   // of the layer
    ChangedPixels changed_;          // scratch of smoothOutlines()
    std::vector<uint32_t> blocks_;   // not 0: the block of pixels holds something; row by row
    bool areRead_ = false;           // whether pixels_ has been read since begin()
    bool areNewer_ = false;          // whether pixels_ is newer than the layer's texture
    std::vector<glm::vec2> corners_; // scratch: of the cells that are not empty
};

} // namespace shoal::render
