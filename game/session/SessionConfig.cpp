#include "game/session/SessionConfig.h"

#include "game/rules/TickInput.h"
#include "game/session/TrackedHands.h"

namespace shoal::app {

namespace {

// "KIND" or "KIND:ARGUMENT".
Result<HandSourceChoice> parseHandSource(const std::string& text) {
    const size_t colon = text.find(':');
    const bool hasArgument = colon != std::string::npos;
    if (const auto kind = enumNamed<HandSourceKind>(text.substr(0, colon))) {
        const bool needsArgument = *kind == HandSourceKind::Script || *kind == HandSourceKind::Replay;
        if (hasArgument == needsArgument || *kind == HandSourceKind::Webcam)
            return HandSourceChoice{*kind, hasArgument ? text.substr(colon + 1) : ""};
    }
    return Error{"--hands " + text,
                 "is not auto, mouse, leap, webcam[:FILE or number], openxr, script:FILE or replay:FILE"};
}

// What the options ask for, with the defaults that depend on other options.
Result<HandSourceChoice> handSourceFor(const PlayOptions& options) {
    const std::string& text = options.hands.source;
    if (options.xr && (text.empty() || text == "auto")) return HandSourceChoice{HandSourceKind::OpenXr, {}};
    auto choice = parseHandSource(!text.empty() ? text : options.headless ? "mouse" : "auto");
    if (choice && choice->kind == HandSourceKind::OpenXr && !options.xr)
        return Error{"--hands openxr", "needs --xr: these hands are tracked by a headset"};
    return choice;
}

} // namespace

Result<SessionConfig> makeSessionConfig(const PlayOptions& options) {
    SessionConfig config;
    config.seed = options.seed;
    config.hands = options.hands;
    config.live = !options.headless && !options.timedemo;
    std::string diveName = options.dive;
    auto source = handSourceFor(options);
    if (!source) return source.error();
    config.handSource = std::move(*source);
    const std::string& file = config.handSource.argument;
    if (config.handSource.kind == HandSourceKind::Script) {
        auto script = game::loadScript(file);
        if (!script) return script.error();
        diveName = script->dive;
        config.seed = script->seed;
        config.script = std::move(*script);
    } else if (config.handSource.kind == HandSourceKind::Replay) {
        auto recording = sim::readRecording(file);
        if (!recording) return recording.error();
        if (recording->header().inputBytes != game::kTickInputBytes)
            return Error{file, "holds inputs of another kind than this version of the game takes"};
        diveName = recording->header().dive;
        config.seed = recording->header().seed;
        config.replay = std::move(*recording);
    } else if (Status there = checkHandSource(config.handSource); !there) {
        return there.error();
    }
    auto files = game::loadDiveFiles(diveName);
    if (!files) return files.error();
    config.species = std::move(files->species);
    config.dive = std::move(files->dive);
    auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    if (!rig) return rig.error();
    config.rig = std::move(*rig);
    return config;
}

} // namespace shoal::app
