// One body's layered fragment buffers in graphics memory, of either kind, for the shaders that trace rays
// through them (shaders/occlusion/Layers.glsl). Main thread; OpenGL 4.3.
#pragma once

#include "engine/gl/Program.h"
#include "engine/occlusion/Ollfb.h"
#include "engine/occlusion/ThesisLayers.h"

#include <utility>
#include <vector>

namespace shoal::occlusion {

inline constexpr int kStorageGlsl = 430;

// Whether the current context can keep layers: OpenGL 4.3, with storage buffers in fragment shaders. The
// error says what it has.
Status canKeepLayers();

// A shader storage buffer filled from `data`. The error says that the driver has not the memory.
Result<gl::Buffer> storageBuffer(const void* data, size_t bytes);

enum class LayerMethod {
    Ollfb,  // Ollfb.h
    Thesis, // ThesisLayers.h
};

class LayersGpu {
  public:
    // 150 views of 64 x 64 pixels. mesh: world frame. Errors: no OpenGL 4.3, a mesh that is broken or too
    // large, no memory. Takes up to some seconds.
    static Result<LayersGpu> make(const BodyMesh& mesh, LayerMethod method);

    // Errors: no OpenGL 4.3, or no memory.
    static Result<LayersGpu> upload(const Ollfb& ollfb);
    static Result<LayersGpu> upload(const ThesisLayers& layers);

    LayerMethod method() const { return method_; }
    // For a program in use that includes occlusion/Layers.glsl, or Ollfb.glsl or ThesisTrace.glsl.
    void bind(const gl::Program& program) const;

  private:
    template <class T> Status keep(int binding, const std::vector<T>& values);

    LayerMethod method_ = LayerMethod::Ollfb;
    float nearest_m_ = 0;                                // rays that leave the surface meet nothing nearer
    bool closed_ = false;                                // of an Ollfb
    ThesisViews views_;                                  // of the thesis' layers
    std::vector<std::pair<GLuint, gl::Buffer>> buffers_; // by binding
};

} // namespace shoal::occlusion
