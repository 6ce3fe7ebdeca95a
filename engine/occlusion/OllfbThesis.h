// Orthographic linearised layered fragment buffers as Iorns 2016 (chapter 6) has them: a body seen from many
// directions, every layer's depth and normal kept, those of all pixels in one line with each pixel's first. A
// ray is answered by the view nearest to its direction, whose pixels it crosses; each pixel is a stack of
// flat steps.
#pragma once

#include "engine/core/Result.h"
#include "engine/occlusion/CheckMesh.h"
#include "engine/occlusion/Visibility.h"

#include <cstdint>
#include <vector>

namespace shoal::occlusion {

// One layer in one pixel: 64 bits.
struct ThesisLayer {
    float depth = 0;     // along the view's direction from the ball's near side, in pixels
    uint32_t normal = 0; // body frame, octahedral, 2 x 16 bits (Octahedral.h)
};
static_assert(sizeof(ThesisLayer) == 8);

// How a body is seen: the view of direction k is lookingAlong(cubeDirections(cells)[k], 0), a square of
// resolution^2 pixels that just holds the ball.
struct ThesisViews {
    int cells = 5; // views = 6 cells^2: 54 (3), 150 (5), 486 (9)
    int resolution = 64;
    Ball ball;

    int count() const { return 6 * cells * cells; }
    // A pixel of margin, for what lies on the ball itself.
    float pixelsPerMetre() const {
        return ball.radius > 0 ? static_cast<float>(resolution - 1) / (2 * ball.radius) : 1.0f;
    }
    // Body frame, metres, to pixels right, up and along the direction.
    glm::vec3 pixelFromBody(const glm::mat3& viewFromBody, const glm::vec3& position) const {
        return viewFromBody * (position - ball.centre) * pixelsPerMetre() +
               static_cast<float>(resolution) / 2;
    }
};

class OllfbThesis {
  public:
    struct Options {
        int cells = 5;       // 1 to 16: 6 to 1536 views
        int resolution = 64; // 1 to 1024
        size_t mostBytes = 256u << 20;
    };

    // Errors: a mesh that cannot be (CheckMesh.h), options out of range, more than mostBytes.
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

// Whether the options are in range.
Status checkOptions(const OllfbThesis::Options& options);

static_assert(TracesRays<OllfbThesis> && KeepsMemory<OllfbThesis>);

} // namespace shoal::occlusion
