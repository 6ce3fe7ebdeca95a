// Fades a headset's picture to one colour. Pairs with shaders/render/Fade.
#pragma once

#include "engine/gl/Program.h"
#include "engine/render/WholePicture.h"

#include <glm/vec4.hpp>

namespace shoal::render {

class FadePass {
  public:
    static Result<FadePass> make();

    // Draws over the bound framebuffer. amount: 0 keeps the picture, 1 leaves only the colour (display
    // values, premultiplied by alpha).
    void draw(const glm::vec4& colour, float amount);

  private:
    gl::Program program_;
    WholePicture picture_;
};

} // namespace shoal::render
