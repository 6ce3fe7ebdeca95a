// Traces many rays at once on the graphics card, one for each pixel of a picture of floats.
#pragma once

#include "engine/gl/Program.h"
#include "engine/occlusion/gpu/LayersGpu.h"
#include "tests/baselines/occlusion/Visibility.h"

#include <span>
#include <vector>

namespace shoal::occlusion {

// A ray in the shader's memory layout.
struct RayGpu {
    glm::vec3 origin{0};
    float nearest = 0;
    glm::vec3 direction{0};
    float unused = 0;
};
static_assert(sizeof(RayGpu) == 32);

class TracePass {
  public:
    // Compiles the shader; fails without OpenGL 4.3.
    static Result<TracePass> make();

    // Traces as the methods' trace() does, body frame. Waits for the answers.
    using Answers = std::vector<std::optional<Hit>>;
    Result<Answers> trace(const LayersGpu& layers, std::span<const RayGpu> rays) const;

  private:
    gl::Program thesis_, cured_;
};

} // namespace shoal::occlusion
