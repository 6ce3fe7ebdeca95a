#include "tests/bench/occlusion/Environment.h"

#include "engine/light/MakeLight.h"
#include "tests/bench/light/Environments.h"

#include <cstdio>

namespace shoal::bench {

std::vector<LitEnvironment> litEnvironments(const Path& shared, bool quick) {
    std::vector<LitEnvironment> all;
    light::LightMaker video({.baseWidth = 512, .minRoughness = 0.25f});
    light::LightMaker still(
        {.baseWidth = 1024, .minRoughness = 0.25f, .quality = light::LightQuality::Still});
    for (const EnvironmentSource& source : environmentSources(shared, quick)) {
        const auto environment = source.load();
        if (!environment) {
            std::fprintf(stderr, "occlusion: left out, not at hand: %s\n", source.name.c_str());
            continue;
        }
        LitEnvironment& lit = all.emplace_back();
        lit.lit.name = source.name;
        lit.lit.pointSun = hasPointSun(environment->radianceLin);
        if (environment->coded())
            video.make(environment->view(), lit.lit.light);
        else
            still.makeFromHdr(environment->radianceLin, lit.lit.light);
        lit.lit.harmonics = math::shProject(lit.lit.light.radiance.levels[1]);
        lit.fine = fineOf(environment->radianceLin);
    }
    return all;
}

Result<Lit> reefLight() {
    const auto sources = filmedSources();
    const auto environment = sources.empty() ? std::nullopt : sources.front().load();
    if (!environment) return Error{"content/video/reef.mp4", "cannot be read"};
    Lit lit{.name = environment->name};
    light::LightMaker({.baseWidth = 2048, .minRoughness = 0.25f}).make(environment->view(), lit.light);
    lit.harmonics = math::shProject(lit.light.radiance.levels[2]);
    return lit;
}

} // namespace shoal::bench
