#include "tests/bench/occlusion/Surround.h"

#include "engine/light/MakeLight.h"
#include "tests/bench/light/Surrounds.h"

#include <cstdio>

namespace shoal::bench {

std::vector<LitSurround> litSurrounds(const Path& shared, bool quick) {
    std::vector<LitSurround> all;
    light::LightMaker video({.baseWidth = 512, .leastRoughness = 0.25f});
    light::LightMaker still(
        {.baseWidth = 1024, .leastRoughness = 0.25f, .quality = light::LightQuality::Still});
    for (const SurroundSource& source : surroundSources(shared, quick)) {
        const auto surround = source.load();
        if (!surround) {
            std::fprintf(stderr, "occlusion: left out, not at hand: %s\n", source.name.c_str());
            continue;
        }
        LitSurround& lit = all.emplace_back();
        lit.lit.name = source.name;
        lit.lit.pointSun = hasPointSun(surround->radianceLin);
        if (surround->coded())
            video.make(surround->view(), lit.lit.light);
        else
            still.makeFromHdr(surround->radianceLin, lit.lit.light);
        lit.lit.harmonics = math::shProject(lit.lit.light.radiance.levels[1]);
        lit.fine = fineOf(surround->radianceLin);
    }
    return all;
}

Result<Lit> reefLight() {
    const auto sources = filmedSources();
    const auto surround = sources.empty() ? std::nullopt : sources.front().load();
    if (!surround) return Error{"content/video/reef.mp4", "cannot be read"};
    Lit lit{.name = surround->name};
    light::LightMaker({.baseWidth = 2048, .leastRoughness = 0.25f}).make(surround->view(), lit.light);
    lit.harmonics = math::shProject(lit.light.radiance.levels[2]);
    return lit;
}

} // namespace shoal::bench
