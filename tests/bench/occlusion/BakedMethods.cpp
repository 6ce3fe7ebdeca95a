// Methods that store one number, or an array of numbers, at each vertex.
#include "engine/light/Lookup.h"
#include "tests/baselines/HarmonicSums.h"
#include "tests/baselines/occlusion/Baked.h"
#include "tests/bench/occlusion/Method.h"

namespace shoal::bench {

using namespace occlusion::baselines;

namespace {

constexpr int kRays = 256, kRaysAPoint = 32; // at a vertex; at each of three points in a triangle

// Occluders of a body's rays: itself as it rests, or the whole scene as it stands.
struct Baking {
    occlusion::BodyMesh mesh;
    Occluded occluded;
};
Baking bakingOf(const Body& body, const Rays& all, bool ownBodyAtRest, float nearest) {
    if (!ownBodyAtRest)
        return {body.posed.view(), [&all, nearest](const glm::vec3& o, const glm::vec3& d) {
                    return all.occluded(o, d, nearest);
                }};
    const Rays own({&body.rest});
    return {body.rest.view(),
            [own, nearest](const glm::vec3& o, const glm::vec3& d) { return own.occluded(o, d, nearest); }};
}

glm::mat3 rotationOf(const glm::mat4& matrix) {
    const glm::mat3 linear(matrix);
    return linear / glm::length(linear[0]);
}

// Returns harmonics in a rotated frame, projected anew from even directions.
math::ShRgb inFrame(const math::ShRgb& world, const glm::mat3& worldFromFrame, int bands) {
    static const auto directions = evenDirections(1000);
    math::ShRgb out{};
    for (const glm::vec3& d : directions) {
        const glm::dvec3 radiance = math::shEvaluate(world, worldFromFrame * d, bands);
        const math::ShBasis basis = math::shBasis(d);
        for (size_t k = 0; k < out.size(); ++k) out[k] += radiance * basis[k];
    }
    for (glm::dvec3& each : out) each *= 4 * std::numbers::pi / static_cast<double>(directions.size());
    return out;
}

} // namespace

OcclusionMethod ignored() {
    const auto map = std::make_shared<const ImageRgbF*>();
    return {{"off", "off", "off", "engine/light", Part::Off},
            [](const Scene&, const Rays&) {},
            [] { return size_t{0}; },
            [=](const Lit& lit) { *map = &lit.light.diffuse; },
            [=](std::span<const Receiver> at, std::span<glm::vec3> out) {
                for (size_t i = 0; i < at.size(); ++i) out[i] = light::lookUp(**map, at[i].normal);
            }};
}

OcclusionMethod bakedOcclusion(bool ownBodyAtRest) {
    struct State {
        const ImageRgbF* map = nullptr;
        std::vector<std::vector<float>> free; // [body][vertex]
    };
    const auto state = std::make_shared<State>();
    return {{ownBodyAtRest ? "ambient occlusion, own body at rest" : "ambient occlusion, whole scene baked",
             ownBodyAtRest ? "AO" : "AO, scene", "baked at vertices", "Landis 2002"},
            [=](const Scene& scene, const Rays& rays) {
                state->free.clear();
                for (const Body& body : scene.bodies) {
                    const Baking baking = bakingOf(body, rays, ownBodyAtRest, scene.nearest);
                    state->free.push_back(
                        bakeAmbientOcclusion(baking.mesh, baking.occluded, kRaysAPoint, scene.nearest));
                }
            },
            [=] {
                size_t bytes = 0;
                for (const auto& each : state->free) bytes += each.size(); // one byte would do
                return bytes;
            },
            [=](const Lit& lit) { state->map = &lit.light.diffuse; },
            [=](std::span<const Receiver> at, std::span<glm::vec3> out) {
                for (size_t i = 0; i < at.size(); ++i)
                    out[i] = at[i].mix(state->free[at[i].body]) * light::lookUp(*state->map, at[i].normal);
            },
            ownBodyAtRest ? OcclusionMethod::Moves::Free : OcclusionMethod::Moves::Rebuilt};
}

// Baked at rest, each bone has the environment's harmonics in its own frame: once for each frame and bone.
OcclusionMethod transfer(int bands, bool ownBodyAtRest) {
    struct State {
        const Scene* scene = nullptr;
        std::vector<Transfer> bodies;
        std::vector<std::vector<math::ShRgb>> light; // [body][bone]
    };
    const auto state = std::make_shared<State>();
    const std::string brief = "PRT " + std::to_string(bands);
    return {{"radiance transfer, " + std::to_string(bands) + " bands, " +
                 (ownBodyAtRest ? "own body at rest" : "whole scene baked"),
             ownBodyAtRest ? brief : brief + ", scene", "baked at vertices", "Sloan, Kautz and Snyder 2002"},
            [=](const Scene& scene, const Rays& rays) {
                state->scene = &scene;
                state->bodies.clear();
                for (const Body& body : scene.bodies) {
                    const Baking baking = bakingOf(body, rays, ownBodyAtRest, scene.nearest);
                    state->bodies.push_back(
                        bakeTransfer(baking.mesh, baking.occluded, bands, kRays, scene.nearest));
                }
            },
            [=] {
                size_t bytes = 0;
                for (const Transfer& each : state->bodies) bytes += each.bytes();
                return bytes;
            },
            [=](const Lit& lit) {
                state->light.clear();
                for (const Body& body : state->scene->bodies) {
                    state->light.emplace_back();
                    for (const glm::mat4& bone : body.worldFromRest) {
                        state->light.back().push_back(
                            ownBodyAtRest ? inFrame(lit.harmonics, rotationOf(bone), bands) : lit.harmonics);
                    }
                }
            },
            [=](std::span<const Receiver> at, std::span<glm::vec3> out) {
                for (size_t i = 0; i < at.size(); ++i) {
                    const auto& boneOf = state->scene->bodies[at[i].body].boneOf;
                    glm::vec3 sum(0);
                    for (int k = 0; k < 3; ++k) {
                        const uint32_t vertex = at[i].corners[k];
                        sum += at[i].weights[k] * state->bodies[at[i].body].radiance(
                                                      vertex, state->light[at[i].body][boneOf[vertex]]);
                    }
                    out[i] = glm::max(sum, 0.0f);
                }
            },
            ownBodyAtRest ? OcclusionMethod::Moves::Free : OcclusionMethod::Moves::Rebuilt};
}

} // namespace shoal::bench
