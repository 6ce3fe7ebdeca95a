#include "game/app/Plan.h"

#include "game/Playback.h"
#include "game/TickInput.h"
#include "game/app/TrackedHands.h"

#include <string_view>

namespace shoal::app {

Result<Plan> makePlan(const PlayOptions& options) {
    Plan plan;
    plan.seed = options.seed;
    plan.hands = options.hands;
    plan.live = !options.headless && !options.timedemo;
    std::string diveName = options.dive;
    const auto after = [&](std::string_view prefix) -> std::optional<std::string> {
        if (!options.hands.source.starts_with(prefix)) return std::nullopt;
        return options.hands.source.substr(prefix.size());
    };
    if (const auto file = after("script:")) {
        auto script = game::loadScript(*file);
        if (!script) return script.error();
        diveName = script->dive;
        plan.seed = script->seed;
        plan.script = std::move(*script);
    } else if (const auto replayFile = after("replay:")) {
        auto recording = sim::readRecording(*replayFile);
        if (!recording) return recording.error();
        if (recording->header().inputBytes != game::kTickInputBytes)
            return Error{*replayFile, "holds inputs of another kind than this version of the game takes"};
        diveName = recording->header().dive;
        plan.seed = recording->header().seed;
        plan.replay = std::move(*recording);
    } else if (options.hands.source == "openxr" ||
               (options.xr && (options.hands.source.empty() || options.hands.source == "auto"))) {
        if (!options.xr) return Error{"--hands openxr", "needs --xr: these hands are tracked by a headset"};
        plan.openXrHands = true;
    } else {
        if (plan.hands.source.empty()) plan.hands.source = options.headless ? "mouse" : "auto";
        if (Status known = checkHandSource(plan.hands); !known) return known.error();
    }
    auto files = game::loadDiveFiles(diveName);
    if (!files) return files.error();
    plan.species = std::move(files->species);
    plan.dive = std::move(files->dive);
    auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    if (!rig) return rig.error();
    plan.rig = std::move(*rig);
    return plan;
}

} // namespace shoal::app
