// A copy of what shadows leave of a film, for shaders: those with SHADED have a sampler2D named shadowsLeft.
#pragma once

#include "engine/gl/Program.h"
#include "engine/render/FilmShadows.h"

namespace shoal::render {

class ShadowTexture {
  public:
    // Brings it up to date. Leaves another texture bound.
    GLuint update(const FilmShadows& shadows);

  private:
    gl::Texture texture_;
    glm::ivec2 size_{0};
    FilmShadows::Version shown_;
};

} // namespace shoal::render
