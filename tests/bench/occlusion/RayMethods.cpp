// Methods that test a set of directions for occlusion at each point.
#include "engine/light/Lookup.h"
#include "tests/baselines/occlusion/CoherentShadowMaps.h"
#include "tests/baselines/occlusion/LayeredDepth.h"
#include "tests/bench/occlusion/RayMethod.h"

namespace shoal::bench {

using namespace occlusion::baselines;

namespace {

std::vector<Triangles> trianglesOf(const Scene& scene) {
    std::vector<Triangles> all;
    for (const Body& body : scene.bodies) all.push_back({body.posed.positions, body.posed.triangles});
    return all;
}

} // namespace

const ImageRgbF& directedFrom(const Lit& lit) {
    for (const ImageRgbF& level : lit.light.radiance.levels)
        if (level.width <= 128) return level;
    return lit.light.radiance.levels.back();
}

OcclusionMethod exactRays(int directions) {
    struct Exact {
        const Rays* rays = nullptr;
        float nearest = 0;
    };
    return rayMethod<Exact>(
        {"exact rays, " + std::to_string(directions) + " directions", "exact " + std::to_string(directions),
         "exact rays", "Embree", Part::Exact},
        evenDirections(directions), OcclusionMethod::Moves::Rebuilt,
        [](const Scene& scene, const Rays& rays) {
            return Exact{&rays, scene.nearest};
        },
        [](const Exact& exact, const Receiver& at, const glm::vec3& direction, size_t) {
            return exact.rays->occluded(at.position, direction, exact.nearest) ? 0.0f : 1.0f;
        },
        [](const Exact&) { return size_t{0}; });
}

OcclusionMethod coherentShadowMaps(int directions, int size) {
    const auto spiral = spiralDirections(directions);
    return rayMethod<CoherentShadowMaps>(
        {"coherent shadow maps, " + std::to_string(directions) + " of " + std::to_string(size),
         "CSM " + std::to_string(directions) + "x" + std::to_string(size), "coherent shadow maps",
         "Ritschel et al. 2007"},
        spiral, OcclusionMethod::Moves::Rebuilt,
        [=](const Scene& scene, const Rays&) { return CoherentShadowMaps(trianglesOf(scene), spiral, size); },
        [](const CoherentShadowMaps& maps, const Receiver& at, const glm::vec3&, size_t k) {
            return maps.occluded(at.position, k) ? 0.0f : 1.0f;
        },
        [](const CoherentShadowMaps& maps) { return maps.bytes(); });
}

OcclusionMethod layeredDepth(int directions, int size) {
    return rayMethod<LayeredDepth>(
        {"layered depth images 3x" + std::to_string(size) + ", " + std::to_string(directions) + " directions",
         "LDI " + std::to_string(directions), "layered depth images", "after Niessner et al. 2010"},
        evenDirections(directions), OcclusionMethod::Moves::Rebuilt,
        [=](const Scene& scene, const Rays&) { return LayeredDepth(trianglesOf(scene), size); },
        [](const LayeredDepth& images, const Receiver& at, const glm::vec3& direction, size_t) {
            const glm::vec3 start = at.position + images.pixel_m() * at.normal;
            return images.occluded(start, direction, images.pixel_m()) ? 0.0f : 1.0f;
        },
        [](const LayeredDepth& images) { return images.bytes(); });
}

} // namespace shoal::bench
