// A picture to draw into, off screen: colour (RGBA8) and depth, optionally multisampled.
#pragma once

#include "engine/core/Image.h"
#include "engine/gl/Objects.h"

#include <cstdint>
#include <vector>

namespace shoal::gl {

class Target {
  public:
    Target() = default;
    // samples: 1, or up to what the driver has (more is lowered to that).
    Target(int width, int height, int samples);

    int width() const { return width_; }
    int height() const { return height_; }
    int samples() const { return samples_; }

    void bind() const; // and sets the viewport
    // The same without depth, for what does not need it: Mesa's llvmpipe then takes rectangles whole instead
    // of as triangles.
    void bindColour() const;
    GLuint framebuffer() const { return drawn_.name(); }

    // Scaled with a linear filter, ends at its edges. What was drawn is in it after resolve(), which leaves
    // another framebuffer bound.
    GLuint texture() const { return texture_.name(); }
    void resolve() const;
    void bindResolved() const; // to be read, after resolve()

    // Resolves (if multisampled) into `destination` (0: the window) at column x, scaled with a linear filter
    // if sizes differ; leaves the destination bound.
    void blitTo(GLuint destination, int x, int width, int height) const;

    // What is in it after resolve(): blue first, premultiplied, rows from the bottom. Waits until it is
    // drawn.
    void readBgra(std::vector<uint32_t>& pixels) const;

    // The resolved picture, top row first; colour is premultiplied by alpha as drawn.
    ImageRgba8 read() const;

  private:
    int width_ = 0, height_ = 0, samples_ = 1;
    Framebuffer drawn_, colourOnly_, resolved_;
    Renderbuffer samplesColour_, depth_; // the first only if multisampled
    Texture texture_;
};

} // namespace shoal::gl
