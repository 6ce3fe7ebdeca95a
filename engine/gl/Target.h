// An off-screen render target: colour (RGBA8) and depth, optionally multisampled.
#pragma once

#include "engine/core/Image.h"
#include "engine/gl/Objects.h"

#include <cstdint>
#include <vector>

namespace shoal::gl {

class Target {
  public:
    Target() = default;
    // samples: limited to 1 and to the driver's maximum.
    Target(int width, int height, int samples);

    int width() const { return width_; }
    int height() const { return height_; }
    int samples() const { return samples_; }

    void bind() const; // also sets the viewport; the first call makes the depth
    // Binds it without depth, for passes that need none: Mesa's llvmpipe then draws rectangles whole instead
    // of as triangles.
    void bindColour() const;
    GLuint framebuffer() const { return drawn_.name(); } // with depth after bind()

    // Returns the colour texture: linear filter, clamped to its edges. With several samples it contains the
    // drawing only after resolve(), which leaves another framebuffer bound.
    GLuint texture() const { return texture_.name(); }
    void resolve() const;

    // Resolves (if multisampled) into `destination` (0: the window) at column x, scaled with a linear filter
    // if sizes differ; leaves the destination bound.
    void blitTo(GLuint destination, int x, int width, int height) const;

    // Reads the colours after resolve(): blue first, premultiplied, rows from the bottom. Waits until they
    // are drawn.
    void readBgra(std::vector<uint32_t>& pixels) const;

    // Resolves, then reads the picture: top row first, premultiplied by alpha.
    ImageRgba8 read() const;

  private:
    void makeStorage(Renderbuffer& buffer, GLenum format) const;

    int width_ = 0, height_ = 0, samples_ = 1;
    Framebuffer drawn_, colourOnly_, resolved_; // resolved_: of the texture alone
    Renderbuffer samplesColour_;                // only if multisampled
    mutable Renderbuffer depth_;                // a canvas under a layer of objects needs none
    Texture texture_;
};

} // namespace shoal::gl
