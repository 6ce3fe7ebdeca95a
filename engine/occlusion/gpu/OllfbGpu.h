// An Ollfb in graphics memory, for shaders/occlusion/Ollfb.glsl. Main thread; OpenGL 4.3.
#pragma once

#include "engine/gl/Program.h"
#include "engine/occlusion/Ollfb.h"

namespace shoal::occlusion {

class OllfbGpu {
  public:
    // Errors: no OpenGL 4.3, or no memory.
    static Result<OllfbGpu> upload(const Ollfb& ollfb);

    // For a program in use that includes occlusion/Ollfb.glsl.
    void bind(const gl::Program& program) const;

  private:
    bool closed_ = false, onlyOuter_ = true;
    gl::Buffer views_, rows_, starts_, layers_, axes_;
};

} // namespace shoal::occlusion
