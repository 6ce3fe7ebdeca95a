// Makes a picture for a headset's runtime to lay over its cameras': display values that were multiplied by
// their coverage become light multiplied by it, coded as sRGB. Pairs with shaders/render/Premultiply.
#pragma once

#include "engine/gl/Program.h"
#include "engine/gl/Target.h"
#include "engine/render/WholePicture.h"

namespace shoal::render {

class PremultiplyPass {
  public:
    static Result<PremultiplyPass> make();

    // Draws into the lowest left pixels of a framebuffer, as many as the target has; leaves it bound.
    void draw(const gl::Target& from, GLuint into);

  private:
    gl::Program program_;
    WholePicture picture_;
};

} // namespace shoal::render
