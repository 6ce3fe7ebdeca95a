// What the game draws: bodies as ellipsoids on their joints, in closed form.
#include "engine/light/Lookup.h"
#include "engine/occlusion/FitEllipsoids.h"
#include "engine/occlusion/Shade.h"
#include "engine/occlusion/rivals/AmbientOcclusion.h"
#include "tests/bench/occlusion/Method.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace shoal::bench {

namespace {

constexpr size_t kHandParts = 26, kFishParts = 4, kSharkParts = 6; // as the game fits them
constexpr int kRays = 64; // at each of three points in a triangle, where occlusion is baked

occlusion::Ellipsoid<float> moved(const occlusion::Ellipsoid<float>& at, const glm::mat4& to) {
    occlusion::Ellipsoid<float> out = at;
    const float scale = std::cbrt(std::abs(glm::determinant(glm::mat3(to))));
    out.centre = glm::vec3(to * glm::vec4(at.centre, 1));
    out.worldFromAxes = glm::mat3(to) * at.worldFromAxes / scale;
    out.semiAxes = scale * at.semiAxes;
    return out;
}

std::vector<occlusion::BodyPart> partsOf(const Body& body) {
    const std::vector<uint16_t> joints(body.boneOf.begin(), body.boneOf.end());
    std::vector<uint32_t> indices;
    for (const glm::uvec3& t : body.rest.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
    const bool hand = body.name == "hand";
    return occlusion::fitEllipsoids({body.rest.positions, indices, joints},
                                    hand ? occlusion::Parts::ByJoint : occlusion::Parts::ByShape,
                                    hand                   ? kHandParts
                                    : body.name == "shark" ? kSharkParts
                                                           : kFishParts);
}

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
    state.others.resize(scene.bodies.size());
    state.own.resize(scene.bodies.size());
    for (size_t b = 0; b < scene.bodies.size(); ++b) {
        const Body& body = scene.bodies[b];
        std::vector<occlusion::Occluder> resting;
        for (const occlusion::BodyPart& part : partsOf(body)) {
            ++state.parts;
            const occlusion::Occluder posed{moved(part.atRest, body.worldFromRest[part.joint])};
            for (size_t other = 0; other < scene.bodies.size(); ++other)
                if (other != b) state.others[other].push_back(posed);
            if (casting == Casting::All) state.own[b].push_back(posed);
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
