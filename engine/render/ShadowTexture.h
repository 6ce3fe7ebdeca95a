// A texture of FilmShadows::left(), for shaders with SHADED, which have a sampler2D named shadowsLeft.
#pragma once

#include "engine/gl/Program.h"
#include "engine/render/FilmShadows.h"

namespace shoal::render {

class ShadowTexture {
  public:
    // Uploads new shadows and returns the texture. Leaves another texture bound.
    GLuint update(const FilmShadows& shadows);

  private:
    gl::Texture texture_;
    glm::ivec2 size_{0};
    FilmShadows::Version shown_;
};

} // namespace shoal::render
