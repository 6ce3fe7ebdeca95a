// What the game draws: bodies as ellipsoids on their joints, in closed form.
#include "engine/light/Lookup.h"
#include "engine/occlusion/rivals/AmbientOcclusion.h"
#include "tests/bench/occlusion/EllipsoidParts.h"
#include "tests/bench/occlusion/Method.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace shoal::bench {

namespace {

constexpr int kRays = 32; // at each of three points in a triangle, where occlusion is baked

struct State {
    const Scene* scene = nullptr;
    const ImageRgbF* map = nullptr;
    occlusion::SmoothLight smooth;
    std::vector<std::vector<occlusion::Occluder>> others, own; // [body]: what takes its light
    std::vector<std::vector<float>> baked; // [body][vertex]: factor of the light; empty without
    size_t parts = 0;
};

// Factors of a body's light by itself. What its own ellipsoids take at rest is left to them.
std::vector<float> bakedFactors(const Body& body, float nearest, std::span<const occlusion::Occluder> own) {
    const Rays rays({&body.rest});
    const auto occluded = [&](const glm::vec3& o, const glm::vec3& d) {
        return rays.occluded(o, d, nearest);
    };
    auto factors = occlusion::rivals::bakeAmbientOcclusion(body.rest.view(), occluded, kRays, nearest);
    for (size_t i = 0; i < factors.size(); ++i) {
        const auto taken = occlusion::take(body.rest.positions[i], body.rest.normals[i], own, {});
        factors[i] = std::min(factors[i] / std::max(1 - taken.share, 0.1f), 2.0f);
    }
    return factors;
}

void build(State& state, const Scene& scene, Casting casting) {
    state = {.scene = &scene};
    state.others = castingOnOthers(scene);
    state.own.resize(scene.bodies.size());
    for (size_t b = 0; b < scene.bodies.size(); ++b) {
        const Body& body = scene.bodies[b];
        std::vector<occlusion::Occluder> resting;
        for (const occlusion::BodyPart& part : partsOf(body)) {
            ++state.parts;
            if (casting == Casting::All) state.own[b].push_back(posed(part, body));
            if (casting == Casting::All) resting.push_back({part.atRest});
        }
        if (casting != Casting::Others) state.baked.push_back(bakedFactors(body, scene.nearest, resting));
    }
}

const OcclusionLabel kLabels[] = {
    {"ellipsoids of other bodies", "ellipsoids", "ellipsoids on joints", "engine/occlusion", Part::Game},
    {"ellipsoids of other bodies, own occlusion baked at rest", "ellipsoids, AO", "ellipsoids on joints",
     "engine/occlusion"},
    {"ellipsoids of all bodies, the rest of own occlusion baked", "all ellipsoids, AO",
     "ellipsoids on joints", "engine/occlusion"}};

} // namespace

OcclusionMethod ellipsoids(Casting casting) {
    const auto state = std::make_shared<State>();
    return {kLabels[static_cast<size_t>(casting)],
            [=](const Scene& scene, const Rays&) { build(*state, scene, casting); },
            [=] {
                size_t bytes = state->parts * sizeof(occlusion::BodyPart);
                for (const auto& each : state->baked) bytes += each.size(); // one byte would do
                return bytes;
            },
            [=](const Lit& lit) {
                state->map = &lit.light.diffuse;
                const auto small = std::ranges::find_if(
                    lit.light.radiance.levels, [](const ImageRgbF& level) { return level.width <= 32; });
                state->smooth = occlusion::smoothLight(*small);
            },
            [=](std::span<const Receiver> at, std::span<glm::vec3> out) {
                for (size_t i = 0; i < at.size(); ++i) {
                    const glm::vec3 open = light::lookUp(*state->map, at[i].normal);
                    const auto taken = occlusion::take(at[i].position, at[i].normal,
                                                       state->others[at[i].body], state->smooth);
                    out[i] = glm::max(open - taken.radiance, 0.0f);
                    if (state->baked.empty()) continue;
                    const glm::uvec3 corner =
                        state->scene->bodies[at[i].body].posed.triangles[at[i].triangle];
                    const auto& baked = state->baked[at[i].body];
                    const auto byItself =
                        occlusion::take(at[i].position, at[i].normal, state->own[at[i].body], state->smooth);
                    out[i] *=
                        (1 - byItself.share) *
                        glm::dot(at[i].weights, glm::vec3(baked[corner.x], baked[corner.y], baked[corner.z]));
                }
            },
            OcclusionMethod::Moves::Free};
}

} // namespace shoal::bench
