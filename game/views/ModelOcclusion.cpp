#include "game/views/ModelOcclusion.h"

#include "engine/core/Log.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

namespace shoal::app {

namespace {

// Returns nothing if the file is missing or is another model's.
std::optional<render::BakedOcclusion> stored(const Path& file, scene::Model& model) {
    const auto baked = render::readBakedOcclusion(file);
    return baked && render::applyBakedOcclusion(*baked, model) ? std::optional(*baked) : std::nullopt;
}

bool run(std::array<std::string, 3> words) {
    const std::array arguments = {words[0].data(), words[1].data(), words[2].data(),
                                  static_cast<char*>(nullptr)};
    const log::QuietStandardError quiet; // the caller reports the failure in one sentence
    pid_t child = 0;
    int status = 0;
    return ::posix_spawn(&child, arguments[0], nullptr, nullptr, arguments.data(), environ) == 0 &&
           ::waitpid(child, &status, 0) == child && status == 0;
}

} // namespace

std::optional<render::BakedOcclusion> occlusionOf(const Path& file, scene::Model& model) {
    if (auto beside = stored(render::bakedOcclusionBeside(file), model)) return beside;
    const Path kept = cacheFolder() / "occlusion" / fmt::format("{:016x}.json", render::skinHash(model));
    if (auto before = stored(kept, model)) return before;
    const Path maker = programFolder() / "shoal-occlusion";
    if (run({maker.string(), file.string(), kept.string()}))
        if (auto made = stored(kept, model)) return made;
    log::warn("{}: is shown without shadows of its own parts: {} could not make them", file.string(),
              maker.string());
    return std::nullopt;
}

} // namespace shoal::app
