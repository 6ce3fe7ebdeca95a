// One body's layered fragment buffers in graphics memory, of either kind, for the shaders that trace rays
// through them (shaders/occlusion/Layers.glsl). Main thread; OpenGL 4.3.
#pragma once

#include "engine/occlusion/gpu/OllfbGpu.h"
#include "engine/occlusion/gpu/ThesisGpu.h"

#include <variant>

namespace shoal::occlusion {

enum class LayerMethod {
    Ollfb,  // Ollfb.h
    Thesis, // ThesisViews.h
};

class LayersGpu {
  public:
    // 150 views of 64 x 64 pixels. mesh: world frame. Errors: no OpenGL 4.3, a mesh that is broken or too
    // large, no memory. Takes up to some seconds; waits for the graphics card.
    static Result<LayersGpu> make(const BodyMesh& mesh, LayerMethod method);

    LayerMethod method() const {
        return std::holds_alternative<ThesisGpu>(layers_) ? LayerMethod::Thesis : LayerMethod::Ollfb;
    }
    // For a program in use that includes occlusion/Layers.glsl.
    void bind(const gl::Program& program) const;

  private:
    explicit LayersGpu(std::variant<OllfbGpu, ThesisGpu> layers, float nearest_m)
        : layers_(std::move(layers)), nearest_m_(nearest_m) {}

    std::variant<OllfbGpu, ThesisGpu> layers_;
    float nearest_m_; // rays that leave the surface meet nothing nearer
};

} // namespace shoal::occlusion
