// A body's layered fragment buffers of either kind in graphics memory, for the shaders that trace rays
// through them (shaders/occlusion/Layers.glsl). Main thread; OpenGL 4.3.
#pragma once

#include "engine/gl/Program.h"
#include "engine/occlusion/Ollfb.h"
#include "engine/occlusion/ThesisLayers.h"

#include <utility>
#include <vector>

namespace shoal::occlusion {

inline constexpr int kStorageGlsl = 430;

// Returns whether the context can store layers: OpenGL 4.3, with storage buffers in fragment shaders. The
// error names the version or number of buffers that it has.
Status canKeepLayers();

// Makes a shader storage buffer filled from `data`. Fails if the driver has not enough memory.
Result<gl::Buffer> storageBuffer(const void* data, size_t bytes);

enum class LayerMethod {
    Ollfb,  // Ollfb.h
    Thesis, // ThesisLayers.h
};

class LayersGpu {
  public:
    // Makes the views; Thesis wants a number that ThesisViews::cellsFor() takes. mesh: world frame. Fails
    // without OpenGL 4.3, for a broken or too large mesh, or without memory. Takes up to some seconds.
    static Result<LayersGpu> make(const BodyMesh& mesh, LayerMethod method,
                                  const Ollfb::Options& options = {});

    // Upload the buffers. Both require canKeepLayers(), and fail without memory.
    static Result<LayersGpu> upload(const Ollfb& ollfb);
    static Result<LayersGpu> upload(const ThesisLayers& layers);

    LayerMethod method() const { return method_; }
    // Binds the buffers for a program in use: one with Layers.glsl, Ollfb.glsl or ThesisTrace.glsl.
    void bind(const gl::Program& program) const;

  private:
    template <class T> Status keep(int binding, const std::vector<T>& values);

    LayerMethod method_ = LayerMethod::Ollfb;
    float nearest_m_ = 0;                                // hits nearer to a ray's origin are ignored
    bool closed_ = false;                                // of an Ollfb
    ThesisViews views_;                                  // of the thesis' layers
    std::vector<std::pair<GLuint, gl::Buffer>> buffers_; // by binding
};

} // namespace shoal::occlusion
