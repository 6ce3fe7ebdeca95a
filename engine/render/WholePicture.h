// One triangle that covers the viewport. Pairs with shaders/render/WholePicture.glsl.
#pragma once

#include "engine/gl/Objects.h"

namespace shoal::render {

class WholePicture {
  public:
    // Draws with the program in use; depth is 0.5 everywhere, tested and blended as the caller has set.
    void draw() const {
        glDisable(GL_CULL_FACE);
        glBindVertexArray(noAttributes_.name());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glBindVertexArray(0);
    }

  private:
    // The shader makes the corners, but OpenGL requires that a vertex array is bound.
    gl::VertexArray noAttributes_ = gl::VertexArray::make();
};

} // namespace shoal::render
