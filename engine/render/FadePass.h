// What lies between the player and the picture: pixels that a headset's lenses hide, and fading to one
// colour. Pairs with shaders/render/Fade.
#pragma once

#include "engine/gl/Program.h"
#include "engine/render/TriangleBatch.h"
#include "engine/render/View.h"

#include <span>

namespace shoal::render {

class FadePass {
  public:
    static Result<FadePass> make();

    // Clears the bound framebuffer to black, sets its stencil to 1 on the triangles and to 0 elsewhere.
    // corners: three a triangle, on the image plane at distance 1 before the eye (right and up positive).
    void hide(std::span<const glm::vec2> corners, const View& view);

    // While one lives, what hide() has hidden is not drawn.
    class OnlySeen {
      public:
        OnlySeen();
        ~OnlySeen();
        OnlySeen(const OnlySeen&) = delete;
        OnlySeen& operator=(const OnlySeen&) = delete;
    };

    // Over the bound framebuffer. amount: 0 leaves it as it is, 1 leaves nothing but the colour (display
    // values).
    void fade(const glm::vec3& colour, float amount);

  private:
    void draw(std::span<const glm::vec2> corners, const glm::vec2& halfExtent, const glm::vec2& shift,
              const glm::vec4& colour);

    gl::Program program_;
    TriangleBatch drawn_;
};

} // namespace shoal::render
