// Rays through layered fragment buffers on the processor: twin of shaders/occlusion/Ollfb.glsl, and the
// reference that it is tested against.
#pragma once

#include "engine/occlusion/Ollfb.h"
#include "tests/baselines/occlusion/Visibility.h"

#include <limits>

namespace shoal::occlusion {

// A ray that begins this close behind a surface is taken to leave it.
inline constexpr float kLeaving_px = 3;
class TracedOllfb : public Ollfb {
  public:
    static Result<TracedOllfb> make(const BodyMesh& mesh, const Options& options = Options()) {
        auto made = Ollfb::make(mesh, options);
        if (!made) return made.error();
        return TracedOllfb(std::move(*made));
    }

    // As TracesRays has it, up to `farthest` metres. A ray that begins on the surface is not caught by it as
    // it leaves; with both sides to be met, this is so for its first kLeaving_px.
    std::optional<Hit> trace(const glm::vec3& origin, const glm::vec3& direction, float nearest,
                             float farthest = std::numeric_limits<float>::infinity()) const;

  private:
    explicit TracedOllfb(Ollfb made) : Ollfb(std::move(made)) {}
};

// Index of the axis nearest to +-direction; within half a table cell (at most 0.05 rad) of the border between
// two, it may be the second nearest.
int nearestAxis(const Axes& axes, const glm::vec3& direction);

static_assert(TracesRays<TracedOllfb> && KeepsMemory<TracedOllfb>);

} // namespace shoal::occlusion
