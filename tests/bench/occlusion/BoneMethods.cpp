// What rides on bones, or is read from the picture.
#include "engine/light/Lookup.h"
#include "tests/baselines/occlusion/AmbientOcclusion.h"
#include "tests/baselines/occlusion/BallOcclusion.h"
#include "tests/baselines/occlusion/BoneBalls.h"
#include "tests/baselines/occlusion/BoneDistance.h"
#include "tests/baselines/occlusion/ScreenSpace.h"
#include "tests/bench/occlusion/RayMethod.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace shoal::bench {

using namespace occlusion::baselines;

// Its own body's ellipsoids would swallow a surface that they stand for: only the others cast.
OcclusionMethod spheres() {
    struct State {
        std::vector<std::vector<Ellipsoid>> bodies;
        const ImageRgbF* map = nullptr;
    };
    const auto state = std::make_shared<State>();
    return {{"balls for bones, of other bodies", "balls", "on bones", "after Ren et al. 2006"},
            [=](const Scene& scene, const Rays&) {
                state->bodies.clear();
                for (const Body& body : scene.bodies) {
                    const int bones = static_cast<int>(body.worldFromRest.size());
                    auto fitted = fitEllipsoids(body.rest.view(), body.boneOf, bones);
                    for (Ellipsoid& each : fitted)
                        each = moved(each, body.worldFromRest[static_cast<size_t>(each.bone)]);
                    state->bodies.push_back(std::move(fitted));
                }
            },
            [=] {
                size_t count = 0;
                for (const auto& each : state->bodies) count += each.size();
                return count * sizeof(Ellipsoid);
            },
            [=](const Lit& lit) { state->map = &lit.light.diffuse; },
            [=](std::span<const Receiver> at, std::span<glm::vec3> out) {
                for (size_t i = 0; i < at.size(); ++i) {
                    float free = 1;
                    for (size_t b = 0; b < state->bodies.size(); ++b) {
                        if (b == at[i].body) continue;
                        for (const Ellipsoid& each : state->bodies[b]) {
                            const SeenSphere sphere = seenFrom(at[i].position, each);
                            free *= 1 - sphereOcclusion(at[i].normal, sphere.to, sphere.radius);
                        }
                    }
                    out[i] = free * light::lookUp(*state->map, at[i].normal);
                }
            },
            OcclusionMethod::Moves::Free};
}

OcclusionMethod boneDistances(int cones, int cells) {
    struct Fields {
        std::vector<std::vector<DistanceGrid>> grids; // [body]
        std::vector<PlacedGrid> placed;
        float nearest = 0, furthest = 0, tangent = 0;
    };
    return rayMethod<std::shared_ptr<Fields>>(
        {"distance field of " + std::to_string(cells) + " cells a bone, " + std::to_string(cones) + " cones",
         "SDF " + std::to_string(cones), "on bones", "after Wright 2015"},
        evenDirections(cones), OcclusionMethod::Moves::Free,
        [=](const Scene& scene, const Rays&) {
            const auto fields = std::make_shared<Fields>();
            glm::vec3 low(1e30f), high(-1e30f);
            for (const Body& body : scene.bodies) {
                fields->grids.push_back(distanceGrids(body.rest.view(), body.boneOf,
                                                      static_cast<int>(body.worldFromRest.size()), cells));
                for (const glm::vec3& p : body.posed.positions)
                    low = glm::min(low, p), high = glm::max(high, p);
            }
            for (size_t b = 0; b < scene.bodies.size(); ++b)
                for (const DistanceGrid& grid : fields->grids[b]) {
                    const glm::mat4& world = scene.bodies[b].worldFromRest[static_cast<size_t>(grid.bone)];
                    fields->placed.push_back({&grid, glm::inverse(world),
                                              glm::vec3(world * glm::vec4(0.5f * (grid.low + grid.high), 1)),
                                              0.5f * glm::distance(grid.low, grid.high)});
                }
            fields->furthest = glm::distance(low, high);
            fields->nearest = 20 * scene.nearest;
            // Each cone has its share of the sphere: solid angle 2 pi (1 - cos).
            const float cosine = 1 - 2 / static_cast<float>(cones);
            fields->tangent = std::sqrt(1 - cosine * cosine) / cosine;
            return fields;
        },
        [](const std::shared_ptr<Fields>& f, const Receiver& at, const glm::vec3& direction, size_t) {
            return coneFree(f->placed, at.position + 0.5f * f->nearest * at.normal, direction, f->tangent,
                            f->nearest, f->furthest);
        },
        [](const std::shared_ptr<Fields>& f) {
            size_t bytes = 0;
            for (const auto& body : f->grids)
                for (const DistanceGrid& grid : body) bytes += grid.bytes();
            return bytes;
        });
}

OcclusionMethod screenSpace(int samples) {
    struct State {
        DepthPicture picture;
        float reach_m = 0.1f;
        const ImageRgbF* map = nullptr;
    };
    const auto state = std::make_shared<State>();
    return {{"screen space, " + std::to_string(samples) + " samples (seen points only)",
             "SSAO " + std::to_string(samples), "screen space", "Filion and McNaughton 2008"},
            [=](const Scene& scene, const Rays& rays) {
                DepthPicture& picture = state->picture;
                picture = {glm::lookAt(scene.camera.eye, scene.camera.target, glm::vec3(0, 1, 0)),
                           std::tan(scene.camera.fovY / 2),
                           480,
                           360,
                           {}};
                const glm::mat3 worldFromEye = glm::transpose(glm::mat3(picture.eyeFromWorld));
                const float half = 0.5f * static_cast<float>(picture.height);
                for (int y = 0; y < picture.height; ++y)
                    for (int x = 0; x < picture.width; ++x) {
                        const glm::vec3 ray(
                            (static_cast<float>(x) + 0.5f - 0.5f * static_cast<float>(picture.width)) / half *
                                picture.tanHalfFovY,
                            (half - static_cast<float>(y) - 0.5f) / half * picture.tanHalfFovY, -1);
                        const auto at = rays.touch(scene.camera.eye, worldFromEye * glm::normalize(ray), 0);
                        picture.depth_m.push_back(at ? at->distance / glm::length(ray) : 1e30f);
                    }
                state->reach_m = 0.15f * glm::distance(scene.camera.eye, scene.camera.target);
            },
            [=] { return state->picture.bytes(); },
            [=](const Lit& lit) { state->map = &lit.light.diffuse; },
            [=](std::span<const Receiver> at, std::span<glm::vec3> out) {
                for (size_t i = 0; i < at.size(); ++i) {
                    if (!state->picture.shows(at[i].position, 0.02f * state->reach_m)) {
                        out[i] = kUnknown;
                        continue;
                    }
                    out[i] = screenSpaceOcclusion(state->picture, at[i].position, at[i].normal,
                                                  state->reach_m, samples) *
                             light::lookUp(*state->map, at[i].normal);
                }
            },
            OcclusionMethod::Moves::Free};
}

} // namespace shoal::bench
