#include "tests/baselines/light/Baselines.h"

#include "engine/light/Lookup.h"

#include <memory>

namespace shoal::light::baselines {

GlossyMethod thesisRings() {
    auto pyramid = std::make_shared<const RadiancePyramid*>(nullptr);
    return {{"36 samples on Phong rings", "36 rings", "per pixel, Phong rings", "thesis, section 4.1",
             Role::Thesis},
            true,
            [pyramid](const Input& input) { *pyramid = input.pyramid; },
            [pyramid](std::span<const glm::vec3> dirs, float roughness, std::span<glm::vec3> out) {
                for (size_t i = 0; i < dirs.size(); ++i)
                    out[i] = phongRingsRadiance(**pyramid, dirs[i], static_cast<double>(roughness));
            }};
}

} // namespace shoal::light::baselines
