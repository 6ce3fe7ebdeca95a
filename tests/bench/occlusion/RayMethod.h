// Makes a method from any structure that can tell how free a direction is.
#pragma once

#include "engine/light/Lookup.h"
#include "tests/baselines/occlusion/Directions.h"
#include "tests/bench/occlusion/Method.h"

#include <memory>
#include <optional>

namespace shoal::bench {

// Returns the level of the environment's pyramid that directions sample.
const ImageRgbF& directedFrom(const Lit& lit);

// make(scene, rays) -> Structure; free(structure, receiver, direction, its index) -> 0 to 1;
// bytes(structure).
template <class Structure, class Make, class Free, class Bytes>
OcclusionMethod rayMethod(OcclusionLabel label, std::vector<glm::vec3> directions,
                          OcclusionMethod::Moves moves, Make make, Free free, Bytes bytes) {
    struct State {
        std::optional<Structure> structure;
        occlusion::baselines::DirectedLight light;
        const ImageRgbF* map = nullptr;
        std::vector<float> known; // [receiver][direction]
    };
    const auto state = std::make_shared<State>();
    return {std::move(label),
            [=](const Scene& scene, const Rays& rays) {
                state->structure.emplace(make(scene, rays));
                state->known.clear();
            },
            [=] { return bytes(*state->structure); },
            [=](const Lit& lit) {
                state->light = occlusion::baselines::directedLight(directedFrom(lit), directions);
                state->map = &lit.light.diffuse;
            },
            [=](std::span<const Receiver> at, std::span<glm::vec3> out) {
                const size_t count = state->light.directions.size();
                for (size_t i = 0; i < at.size(); ++i)
                    out[i] = light::lookUp(*state->map, at[i].normal) *
                             occlusion::baselines::shareSeen(state->light, at[i].normal, [&](size_t k) {
                                 return state->known.empty()
                                            ? free(*state->structure, at[i], state->light.directions[k], k)
                                            : state->known[i * count + k];
                             });
            },
            moves,
            [=](std::span<const Receiver> at) {
                state->known.clear();
                for (const Receiver& each : at)
                    for (size_t k = 0; k < directions.size(); ++k)
                        state->known.push_back(glm::dot(directions[k], each.normal) <= 0
                                                   ? 0
                                                   : free(*state->structure, each, directions[k], k));
            }};
}

} // namespace shoal::bench
