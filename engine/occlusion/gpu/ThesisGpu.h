// The thesis' layers, seen by the graphics card: count pass, offsets, fill pass with atomics, sort.
#pragma once

#include "engine/gl/Program.h"
#include "engine/occlusion/OllfbThesis.h"

namespace shoal::occlusion {

// Same buffers as OllfbThesis, but for layers on the very edge of a triangle and the last bits of depth.
class ThesisGpu {
  public:
    // Errors: as OllfbThesis::make; no OpenGL 4.3; shaders. Reads the counts back to sum them up, so it waits
    // for the card. Leaves no framebuffer and no vertex array bound.
    static Result<ThesisGpu> see(const BodyMesh& mesh, const OllfbThesis::Options& options);

    // For a program in use that includes occlusion/ThesisTrace.glsl.
    void bind(const gl::Program& program) const;

    // As OllfbThesis has them; slow.
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
