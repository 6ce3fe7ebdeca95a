// Methods that test a set of directions for occlusion at each point.
#include "engine/light/Lookup.h"
#include "tests/baselines/occlusion/DepthMaps.h"
#include "tests/baselines/occlusion/Directions.h"
#include "tests/baselines/occlusion/OllfbThesis.h"
#include "tests/baselines/occlusion/TracedOllfb.h"
#include "tests/bench/occlusion/LayeredBodies.h"
#include "tests/bench/occlusion/Method.h"

namespace shoal::bench {

using namespace occlusion::baselines;

namespace {

std::vector<occlusion::BodyMesh> meshesOf(const Scene& scene) {
    std::vector<occlusion::BodyMesh> all;
    for (const Body& body : scene.bodies) all.push_back(body.posed.view());
    return all;
}

// Returns the level of the environment's pyramid that directions sample.
const ImageRgbF& directedFrom(const Lit& lit) {
    for (const ImageRgbF& level : lit.light.radiance.levels)
        if (level.width <= 128) return level;
    return lit.light.radiance.levels.back();
}

// Makes a method from any structure that can tell whether rays are occluded. make(scene, rays) -> Structure;
// occluded(structure, receiver, direction, its index) -> bool.
template <class Structure, class Make, class IsOccluded>
OcclusionMethod rayMethod(OcclusionLabel label, std::vector<glm::vec3> directions,
                          OcclusionMethod::Moves moves, Make make, IsOccluded occluded) {
    struct State {
        std::optional<Structure> structure;
        DirectedLight light;
        const ImageRgbF* map = nullptr;
        std::vector<bool> known; // [receiver][direction]: whether it is occluded
    };
    const auto state = std::make_shared<State>();
    return {std::move(label),
            [=](const Scene& scene, const Rays& rays) {
                state->structure.emplace(make(scene, rays));
                state->known.clear();
            },
            [=] { return state->structure->bytes(); },
            [=](const Lit& lit) {
                state->light = directedLight(directedFrom(lit), directions);
                state->map = &lit.light.diffuse;
            },
            [=](std::span<const Receiver> at, std::span<glm::vec3> out) {
                const size_t count = state->light.directions.size();
                for (size_t i = 0; i < at.size(); ++i)
                    out[i] = light::lookUp(*state->map, at[i].normal) *
                             shareSeen(state->light, at[i].normal, [&](size_t k) {
                                 return !(state->known.empty() ? occluded(*state->structure, at[i],
                                                                          state->light.directions[k], k)
                                                               : state->known[i * count + k]);
                             });
            },
            moves,
            [=](std::span<const Receiver> at) {
                state->known.clear();
                for (const Receiver& each : at)
                    for (size_t k = 0; k < directions.size(); ++k)
                        state->known.push_back(glm::dot(directions[k], each.normal) <= 0 ||
                                               occluded(*state->structure, each, directions[k], k));
            }};
}

template <class Buffers>
OcclusionMethod layers(OcclusionLabel label, int directions, const typename Buffers::Options& options) {
    return rayMethod<LayeredBodies<Buffers>>(
        std::move(label), evenDirections(directions), OcclusionMethod::Moves::Rigid,
        [=](const Scene& scene, const Rays&) { return LayeredBodies<Buffers>(scene, options); },
        [](const LayeredBodies<Buffers>& bodies, const Receiver& at, const glm::vec3& direction, size_t) {
            return bodies.occluded(at.position, direction, at.body);
        });
}

// The chart names the points of the usual size alone; the others have a picture of their own.
OcclusionLabel layersLabel(const std::string& kind, int directions, int views, int resolution,
                           const char* source, Part part) {
    const bool usual = views == kUsualViews && resolution == kUsualPixels;
    return {"layered fragment buffers " + std::string(kind == "thesis" ? "of the thesis" : kind) + ", " +
                std::to_string(views) + " views of " + std::to_string(resolution) + ", " +
                std::to_string(directions) + " directions",
            usual ? kind + " " + std::to_string(directions) : "", "layered fragments, " + kind, source, part};
}

} // namespace

OcclusionMethod exactRays(int directions) {
    struct Exact {
        const Rays* rays = nullptr;
        float nearest = 0;
        static size_t bytes() { return 0; }
    };
    return rayMethod<Exact>(
        {"exact rays, " + std::to_string(directions) + " directions", "exact " + std::to_string(directions),
         "exact rays", "Embree", Part::Exact},
        evenDirections(directions), OcclusionMethod::Moves::Rebuilt,
        [](const Scene& scene, const Rays& rays) {
            return Exact{&rays, scene.nearest};
        },
        [](const Exact& exact, const Receiver& at, const glm::vec3& direction, size_t) {
            return exact.rays->occluded(at.position, direction, exact.nearest);
        });
}

OcclusionMethod coherentShadowMaps(int directions, int size) {
    const auto spiral = spiralDirections(directions);
    return rayMethod<CoherentShadowMaps>(
        {"coherent shadow maps, " + std::to_string(directions) + " of " + std::to_string(size),
         "CSM " + std::to_string(directions) + "x" + std::to_string(size), "coherent shadow maps",
         "Ritschel et al. 2007"},
        spiral, OcclusionMethod::Moves::Rebuilt,
        [=](const Scene& scene, const Rays&) { return CoherentShadowMaps(meshesOf(scene), spiral, size); },
        [](const CoherentShadowMaps& maps, const Receiver& at, const glm::vec3&, size_t k) {
            return maps.occluded(at.position, k);
        });
}

OcclusionMethod layeredDepth(int directions, int size) {
    return rayMethod<LayeredDepth>(
        {"layered depth images 3x" + std::to_string(size) + ", " + std::to_string(directions) + " directions",
         "LDI " + std::to_string(directions), "layered depth images", "after Niessner et al. 2010"},
        evenDirections(directions), OcclusionMethod::Moves::Rebuilt,
        [=](const Scene& scene, const Rays&) { return LayeredDepth(meshesOf(scene), size); },
        [](const LayeredDepth& images, const Receiver& at, const glm::vec3& direction, size_t) {
            const glm::vec3 start = at.position + images.pixel_m() * at.normal;
            return images.occluded(start, direction, images.pixel_m());
        });
}

OcclusionMethod thesisLayers(int directions, int cells, int resolution) {
    return layers<occlusion::OllfbThesis>(
        layersLabel("thesis", directions, 6 * cells * cells, resolution, "thesis, chapter 6", Part::Thesis),
        directions, {.cells = cells, .resolution = resolution});
}

OcclusionMethod curedLayers(int directions, int views, int resolution) {
    return layers<occlusion::TracedOllfb>(
        layersLabel("cured", directions, views, resolution, "engine/occlusion", Part::Baseline), directions,
        {.views = views, .resolution = resolution});
}

} // namespace shoal::bench
