// The thesis' layered fragment buffers on the processor: what engine/occlusion/gpu/ThesisGpu.h and
// shaders/occlusion/ThesisTrace.glsl are tested against. A ray is answered by the view nearest to its
// direction, whose pixels it crosses; each pixel is a stack of flat steps.
#pragma once

#include "engine/core/Result.h"
#include "engine/occlusion/ThesisViews.h"
#include "tests/baselines/occlusion/Visibility.h"

#include <cstdint>
#include <vector>

namespace shoal::occlusion {

// The thesis' set: a cube around the body, each face cut into n x n cells of equal angle, one direction
// through the middle of each; 6 n^2 in all: 54 (n = 3), 150 (5), 486 (9). Unit vectors.
std::vector<glm::vec3> cubeDirections(int n);
// Index into cubeDirections(n) of the cell that holds this direction.
int nearestCubeDirection(const glm::vec3& direction, int n);

class OllfbThesis {
  public:
    using Options = ThesisOptions;

    // Errors: a mesh that cannot be (CheckMesh.h), options out of range, more than maxBytes.
    static Result<OllfbThesis> make(const BodyMesh& mesh, const Options& options);
    static Result<OllfbThesis> make(const BodyMesh& mesh) { return make(mesh, Options{}); }

    // As TracesRays has it, from either side of a surface.
    std::optional<Hit> trace(const glm::vec3& origin, const glm::vec3& direction, float nearest) const;

    size_t bytes() const {
        return starts_.size() * sizeof(uint32_t) + layers_.size() * sizeof(ThesisLayer) +
               viewsFromBody_.size() * sizeof(glm::mat3);
    }
    const ThesisViews& views() const { return views_; }
    // First layer of each pixel (view by view, row by row), and the end of the last; then the layers, in each
    // pixel by growing depth.
    const std::vector<uint32_t>& starts() const { return starts_; }
    const std::vector<ThesisLayer>& layers() const { return layers_; }

  private:
    ThesisViews views_;
    std::vector<glm::mat3> viewsFromBody_;
    std::vector<uint32_t> starts_;
    std::vector<ThesisLayer> layers_;
};

static_assert(TracesRays<OllfbThesis> && KeepsMemory<OllfbThesis>);

} // namespace shoal::occlusion
