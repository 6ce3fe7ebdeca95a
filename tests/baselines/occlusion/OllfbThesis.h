// Rays through the thesis' layered fragment buffers on the processor: what shaders/occlusion/ThesisTrace.glsl
// is tested against. A ray is answered by the view nearest to its direction, whose pixels it crosses; each
// pixel is a stack of flat steps.
#pragma once

#include "engine/occlusion/ThesisLayers.h"
#include "tests/baselines/occlusion/Visibility.h"

namespace shoal::occlusion {

// Index into cubeDirections(n) of the cell that holds this direction.
int nearestCubeDirection(const glm::vec3& direction, int n);

class OllfbThesis : public ThesisLayers {
  public:
    static Result<OllfbThesis> make(const BodyMesh& mesh, const Options& options = Options()) {
        auto made = ThesisLayers::make(mesh, options);
        if (!made) return made.error();
        return OllfbThesis(std::move(*made));
    }

    // Implements TracesRays, from either side of a surface.
    std::optional<Hit> trace(const glm::vec3& origin, const glm::vec3& direction, float nearest) const;

  private:
    explicit OllfbThesis(ThesisLayers made);

    std::vector<glm::mat3> viewsFromBody_;
};

static_assert(TracesRays<OllfbThesis>);

} // namespace shoal::occlusion
