// One triangle that covers the viewport. Pairs with shaders/render/WholePicture.glsl.
#pragma once

#include "engine/gl/Objects.h"

namespace shoal::render {

class WholePicture {
  public:
    static WholePicture make() {
        WholePicture made;
        made.noAttributes_ = gl::VertexArray::make();
        return made;
    }

    // With the program in use; depth, at 0.5 everywhere, and blending as they are.
    void draw() const {
        glDisable(GL_CULL_FACE);
        glBindVertexArray(noAttributes_.name());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glBindVertexArray(0);
    }

  private:
    gl::VertexArray noAttributes_; // the shader makes the corners; OpenGL wants one bound
};

} // namespace shoal::render
