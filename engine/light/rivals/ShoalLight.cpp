#include "engine/light/rivals/Rivals.h"

#include "engine/light/Lookup.h"
#include "engine/light/MakeLight.h"

#include <memory>

namespace shoal::light::rivals {

namespace {

struct State {
    LightMaker maker;
    EnvironmentLight light;

    LightReport make(const Input& input) {
        return input.radianceLin ? maker.makeFromHdr(*input.radianceLin, light)
                                 : maker.make(input.coded, light);
    }
};

Label label() { return {"Shoal", "Shoal", "Shoal", "engine/light", Role::Default}; }

} // namespace

DiffuseMethod shoalDiffuse() {
    auto state = std::make_shared<State>();
    return {label(), false,
            [state](const Input& input) { return 1e3 * static_cast<double>(state->make(input).glossy_ms); },
            [state](std::span<const glm::vec3> normals, std::span<glm::vec3> out) {
                for (size_t i = 0; i < normals.size(); ++i) out[i] = lookUp(state->light.diffuse, normals[i]);
            }};
}

GlossyMethod shoalGlossy() {
    auto state = std::make_shared<State>();
    return {label(), false,
            [state](const Input& input) { return 1e3 * static_cast<double>(state->make(input).diffuse_ms); },
            [state](std::span<const glm::vec3> dirs, float roughness, std::span<glm::vec3> out) {
                for (size_t i = 0; i < dirs.size(); ++i)
                    out[i] = lookUpGlossy(state->light, dirs[i], roughness);
            }};
}

} // namespace shoal::light::rivals
