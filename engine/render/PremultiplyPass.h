// Makes the picture that a headset's runtime lays over its cameras' pictures: converts display values times
// coverage to light times coverage, coded as sRGB. Pairs with shaders/render/Premultiply.
#pragma once

#include "engine/gl/Program.h"
#include "engine/gl/Target.h"
#include "engine/render/WholePicture.h"

namespace shoal::render {

class PremultiplyPass {
  public:
    static Result<PremultiplyPass> make();

    // Draws into a framebuffer's lower left rectangle, as large as the target; leaves the framebuffer bound.
    void draw(const gl::Target& from, GLuint into);

  private:
    gl::Program program_;
    WholePicture picture_;
};

} // namespace shoal::render
