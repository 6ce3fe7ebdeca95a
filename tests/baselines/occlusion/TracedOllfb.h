// Rays through layered fragment buffers on the processor: twin of shaders/occlusion/Ollfb.glsl, and the
// reference that it is tested against.
#pragma once

#include "engine/occlusion/Ollfb.h"
#include "tests/baselines/occlusion/Visibility.h"

#include <limits>

namespace shoal::occlusion {

// A ray that begins this close behind a surface is taken to leave it.
inline constexpr float kLeaving_px = 3;

// Sides from which rays meet a surface.
enum class Sides {
    Outer,  // only where they enter, as what is drawn with its back faces culled
    Both,   // also where they leave
    ByMesh, // Outer if the mesh is closed, else Both
};

class TracedOllfb : public Ollfb {
  public:
    struct Options {
        int views = Ollfb::Options().views, resolution = Ollfb::Options().resolution;
        Sides sides = Sides::ByMesh;
        size_t maxBytes = Ollfb::Options().maxBytes;
    };
    static Result<TracedOllfb> make(const BodyMesh& mesh, const Options& options) {
        auto made = Ollfb::make(mesh, {options.views, options.resolution, options.maxBytes});
        if (!made) return made.error();
        TracedOllfb traced(std::move(*made));
        traced.onlyOuter_ =
            options.sides == Sides::Outer || (options.sides == Sides::ByMesh && traced.closed);
        return traced;
    }
    static Result<TracedOllfb> make(const BodyMesh& mesh) { return make(mesh, Options{}); }
    bool onlyOuter() const { return onlyOuter_; }

    // Implements TracesRays, up to `farthest` metres. A ray that begins on the surface is not caught by it as
    // it leaves; with both sides to be met, this is so for its first kLeaving_px.
    std::optional<Hit> trace(const glm::vec3& origin, const glm::vec3& direction, float nearest,
                             float farthest = std::numeric_limits<float>::infinity()) const;

  private:
    explicit TracedOllfb(Ollfb made) : Ollfb(std::move(made)) {}

    bool onlyOuter_ = true;
};

// Index of the axis nearest to +-direction; within half a table cell (at most 0.05 rad) of the border between
// two, it may be the second nearest.
int nearestAxis(const Axes& axes, const glm::vec3& direction);

static_assert(TracesRays<TracedOllfb>);

} // namespace shoal::occlusion
