// The passes over a headset's whole picture.
#pragma once

#include "engine/gl/Program.h"
#include "engine/render/EyePicture.h"
#include "engine/render/TriangleBatch.h"

namespace shoal::render {

// Pairs with shaders/render/Fade and Premultiply.
class HeadsetPasses {
  public:
    static Result<HeadsetPasses> make();

    // Fades the bound framebuffer to one colour. amount: 0 keeps the picture, 1 leaves only the colour
    // (display values, premultiplied by alpha).
    void fade(const glm::vec4& colour, float amount) const;

    // Makes the picture that a headset's runtime lays over its cameras' pictures: converts display values
    // times coverage to light times coverage, coded as sRGB. Draws into a framebuffer's lower left rectangle,
    // as large as the target; leaves the framebuffer bound.
    void premultiply(const gl::Target& from, GLuint into) const;

  private:
    gl::Program fade_, premultiply_;
    WholePicture picture_;
};

// Copies a target's depth to a framebuffer of another size or format, and adds that of a film. Pairs with
// shaders/render/Depth.
class DepthPass {
  public:
    static Result<DepthPass> make();

    // Copies each pixel's nearest sample, unfiltered, into a framebuffer with depth of the picture's size.
    // part: share of the target's width and height that is copied, about its middle. film: whether the
    // picture shows a film with distances, whose depth counts where it is nearer.
    void draw(const gl::Target& from, float part, GLuint into, const EyePicture& picture, bool film);

  private:
    gl::Program plain_, filmed_;
    WholePicture picture_;
    gl::Texture copy_; // without multisampling
    gl::Framebuffer copyTarget_;
    glm::ivec2 copySize_{0};
};

} // namespace shoal::render
