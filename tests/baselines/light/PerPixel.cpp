#include "tests/baselines/light/Baselines.h"

#include "engine/light/Lookup.h"
#include "tests/baselines/light/Taps.h"

#include <memory>

namespace shoal::light::baselines {

GlossyMethod thesisRings() {
    auto pyramid = std::make_shared<const RadiancePyramid*>(nullptr);
    return {{"36 samples on Phong rings", "36 rings", "per pixel, Phong rings", "thesis, section 4.1",
             Role::Thesis},
            [pyramid](const Input& input) { *pyramid = input.pyramid; },
            [pyramid](std::span<const glm::vec3> dirs, float roughness, std::span<glm::vec3> out) {
                for (size_t i = 0; i < dirs.size(); ++i)
                    out[i] = phongRingsRadiance(**pyramid, dirs[i], roughness);
            }};
}

GlossyMethod filteredImportanceSampling(int samples) {
    auto pyramid = std::make_shared<const RadiancePyramid*>(nullptr);
    const std::string count = std::to_string(samples);
    return {{"importance sampling, " + count + " a pixel", "FIS " + count, "per pixel, importance sampling",
             "Krivanek and Colbert 2008"},
            [pyramid](const Input& input) { *pyramid = input.pyramid; },
            [pyramid, samples](std::span<const glm::vec3> dirs, float roughness, std::span<glm::vec3> out) {
                const auto taps = ggxTaps(roughness, samples, (*pyramid)->levels[0].width);
                for (size_t i = 0; i < dirs.size(); ++i) out[i] = gather(**pyramid, taps, dirs[i]);
            }};
}

} // namespace shoal::light::baselines
