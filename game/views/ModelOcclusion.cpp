#include "game/views/ModelOcclusion.h"

#include "engine/core/Log.h"
#include "engine/core/RunProgram.h"

namespace shoal::app {

namespace {

// Returns nothing if the file is missing or is another model's.
std::optional<render::BakedOcclusion> stored(const Path& file, scene::Model& model) {
    const auto baked = render::readBakedOcclusion(file);
    return baked && render::applyBakedOcclusion(*baked, model) ? std::optional(*baked) : std::nullopt;
}

} // namespace

std::optional<render::BakedOcclusion> occlusionOf(const Path& file, scene::Model& model) {
    if (auto beside = stored(render::bakedOcclusionBeside(file), model)) return beside;
    const Path kept = cacheFolder() / "occlusion" / fmt::format("{:016x}.json", render::skinHash(model));
    if (auto before = stored(kept, model)) return before;
    const Path maker = programFolder() / "shoal-occlusion";
    const auto status = [&] {
        const log::QuietStandardError quiet; // the warning below says it in one sentence
        return runProgram({maker.string(), file.string(), kept.string()});
    }();
    if (status == 0)
        if (auto made = stored(kept, model)) return made;
    log::warn("{}: is shown without shadows of its own parts: {} could not make them", file.string(),
              maker.string());
    return std::nullopt;
}

} // namespace shoal::app
