#include "tests/baselines/light/Baselines.h"

#include "engine/light/BruteForceDiffuse.h"
#include "engine/light/Lookup.h"

#include <memory>

namespace shoal::light::baselines {

DiffuseMethod bruteForce(int width) {
    struct State {
        BruteForceDiffuse method;
        ImageRgbF map;
    };
    auto state = std::make_shared<State>(State{BruteForceDiffuse(width), {}});
    const std::string size = std::to_string(width) + "x" + std::to_string(width / 2);
    return {{"brute force " + size, size, "brute force", "thesis, eq. 2.2",
             width == BruteForceDiffuse::kThesisWidth ? Role::Thesis : Role::Baseline},
            [state](const Input& input) { state->method.make(*input.pyramid, state->map); },
            [state](std::span<const glm::vec3> normals, std::span<glm::vec3> out) {
                for (size_t i = 0; i < normals.size(); ++i) out[i] = lookUp(state->map, normals[i]);
            }};
}

} // namespace shoal::light::baselines
