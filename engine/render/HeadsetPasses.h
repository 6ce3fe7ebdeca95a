// The passes over a headset's whole picture. Pairs with shaders/render/Fade and Premultiply.
#pragma once

#include "engine/gl/Program.h"
#include "engine/gl/Target.h"
#include "engine/render/TriangleBatch.h"

namespace shoal::render {

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

} // namespace shoal::render
