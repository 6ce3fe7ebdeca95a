// Copies the depth of what was drawn into a target to a framebuffer of another size or format. Pairs with
// shaders/render/Depth.
#pragma once

#include "engine/gl/Program.h"
#include "engine/gl/Target.h"
#include "engine/render/WholePicture.h"

#include <glm/vec2.hpp>

namespace shoal::render {

class DepthPass {
  public:
    static Result<DepthPass> make();

    // Of one sample a pixel, the nearest, not filtered. part: of the target's width and height, about its
    // middle. `into` has depth; its lowest left `size` pixels are filled.
    void draw(const gl::Target& from, float part, GLuint into, glm::ivec2 size);

  private:
    gl::Program program_;
    WholePicture picture_;
    gl::Texture copy_; // without samples
    gl::Framebuffer copyTarget_;
    glm::ivec2 copySize_{0};
};

} // namespace shoal::render
