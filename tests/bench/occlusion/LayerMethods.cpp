// Rays through layered fragment buffers, one for each body.
#include "tests/baselines/occlusion/OllfbThesis.h"
#include "tests/baselines/occlusion/TracedOllfb.h"
#include "tests/bench/occlusion/LayeredBodies.h"
#include "tests/bench/occlusion/RayMethod.h"

namespace shoal::bench {

namespace {

template <class Buffers>
OcclusionMethod layers(OcclusionLabel label, int directions, const typename Buffers::Options& options) {
    return rayMethod<LayeredBodies<Buffers>>(
        std::move(label), occlusion::baselines::evenDirections(directions), OcclusionMethod::Moves::Rigid,
        [=](const Scene& scene, const Rays&) { return LayeredBodies<Buffers>(scene, options); },
        [](const LayeredBodies<Buffers>& bodies, const Receiver& at, const glm::vec3& direction, size_t) {
            return bodies.occluded(at.position, direction, at.body) ? 0.0f : 1.0f;
        },
        [](const LayeredBodies<Buffers>& bodies) { return bodies.bytes(); });
}

} // namespace

OcclusionMethod thesisLayers(int directions) {
    return layers<occlusion::OllfbThesis>({"layered fragment buffers of the thesis, 150 views of 64, " +
                                               std::to_string(directions) + " directions",
                                           "thesis " + std::to_string(directions),
                                           "layered fragments, thesis", "thesis, chapter 6", Part::Thesis},
                                          directions, {.cells = 5, .resolution = 64});
}

OcclusionMethod curedLayers(int directions) {
    return layers<occlusion::TracedOllfb>(
        {"layered fragment buffers cured, 150 views of 64, " + std::to_string(directions) + " directions",
         "cured " + std::to_string(directions), "layered fragments, cured", "engine/occlusion"},
        directions, {.views = 150, .resolution = 64});
}

} // namespace shoal::bench
