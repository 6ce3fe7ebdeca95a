// Copies a target's depth to a framebuffer of another size or format, and adds that of a film. Pairs with
// shaders/render/Depth.
#pragma once

#include "engine/gl/Program.h"
#include "engine/render/EyePicture.h"
#include "engine/render/TriangleBatch.h"

namespace shoal::render {

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
