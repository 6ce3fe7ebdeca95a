// The thesis' layered fragment buffers (ThesisViews.h), built by the graphics card: count pass, offsets, fill
// pass with atomics, sort. Main thread; OpenGL 4.3.
#pragma once

#include "engine/gl/Program.h"
#include "engine/occlusion/BodyMesh.h"
#include "engine/occlusion/ThesisViews.h"

namespace shoal::occlusion {

class ThesisGpu {
  public:
    // Errors: a mesh that cannot be (BodyMesh.h), options out of range, more than maxBytes; no OpenGL 4.3;
    // shaders. Reads the counts back to sum them up, so it waits for the card. Leaves no framebuffer and no
    // vertex array bound.
    static Result<ThesisGpu> see(const BodyMesh& mesh, const ThesisOptions& options);

    // For a program in use that includes occlusion/ThesisTrace.glsl.
    void bind(const gl::Program& program) const;

    // First layer of each pixel (view by view, row by row) and the end of the last; the layers, in each pixel
    // by growing depth. Slow.
    std::vector<uint32_t> readStarts() const;
    std::vector<ThesisLayer> readLayers() const;

    const ThesisViews& views() const { return views_; }
    size_t bytes() const { return startCount_ * sizeof(uint32_t) + layerCount_ * sizeof(ThesisLayer); }

  private:
    ThesisViews views_;
    size_t startCount_ = 0, layerCount_ = 0;
    gl::Buffer starts_, layers_;
};

} // namespace shoal::occlusion
