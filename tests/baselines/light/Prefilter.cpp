#include "tests/baselines/light/Baselines.h"

#include "engine/light/Lookup.h"
#include "tests/baselines/light/Taps.h"

#include <algorithm>
#include <functional>
#include <memory>

namespace shoal::light::baselines {

namespace {

// Maps of roughness 0, 0.2 .. 1; the first is the pyramid's own level.
constexpr size_t kMaps = 6;
constexpr int kWidest = 256;

using MakeTaps = std::function<std::vector<Tap>(float roughness, int baseWidth)>;

struct State {
    MakeTaps makeTaps;
    int narrowest;
    int baseWidth = 0; // that the filters are for
    std::vector<TapFilter> filters;
    std::vector<ImageRgbF> maps{kMaps};

    void make(const RadiancePyramid& pyramid) {
        if (baseWidth != pyramid.levels[0].width) {
            baseWidth = pyramid.levels[0].width;
            filters.clear();
            for (size_t k = 1; k < kMaps; ++k)
                filters.emplace_back(makeTaps(static_cast<float>(k) / (kMaps - 1), baseWidth),
                                     std::max(narrowest, kWidest >> k), baseWidth);
        }
        maps[0] = pyramid.ofWidth(kWidest);
        for (size_t k = 1; k < kMaps; ++k) filters[k - 1].apply(pyramid, maps[k]);
    }

    glm::vec3 shade(const glm::vec3& dir, float roughness) const {
        const float at = roughness * (kMaps - 1);
        const size_t low = std::min(static_cast<size_t>(at), kMaps - 2);
        const float f = at - static_cast<float>(low);
        return lookUp(maps[low], dir) * (1 - f) + lookUp(maps[low + 1], dir) * f;
    }
};

GlossyMethod prefilter(Label label, int narrowest, MakeTaps makeTaps) {
    auto state = std::make_shared<State>(State{std::move(makeTaps), narrowest});
    return {std::move(label), [state](const Input& input) { state->make(*input.pyramid); },
            [state](std::span<const glm::vec3> dirs, float roughness, std::span<glm::vec3> out) {
                for (size_t i = 0; i < dirs.size(); ++i) out[i] = state->shade(dirs[i], roughness);
            }};
}

std::string sizes(int narrowest) { return ", maps 256 to " + std::to_string(narrowest); }

} // namespace

GlossyMethod importancePrefilter(int samples, int narrowest) {
    const std::string count = std::to_string(samples);
    return prefilter({"prefiltered, " + count + " samples a texel" + sizes(narrowest),
                      "IS " + count + " to " + std::to_string(narrowest), "prefiltered, importance sampling",
                      "Karis 2013"},
                     narrowest, [samples](float roughness, int baseWidth) {
                         return ggxTaps(roughness, samples, baseWidth);
                     });
}

GlossyMethod fittedPrefilter(int narrowest) {
    const std::string count = std::to_string(kFittedTaps);
    return prefilter({"prefiltered, " + count + " fitted taps a texel" + sizes(narrowest),
                      "taps " + count + " to " + std::to_string(narrowest), "prefiltered, few fitted taps",
                      "after Manson and Sloan 2016"},
                     narrowest, fittedTaps);
}

} // namespace shoal::light::baselines
