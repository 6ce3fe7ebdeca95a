#include "game/session/GameSession.h"

#include "engine/core/Log.h"
#include "game/session/Statistics.h"

#include <fmt/core.h>
#include <glm/common.hpp>

#include <array>
#include <random>

namespace shoal::app {

static HandSource makeSource(const SessionConfig& config) {
    if (config.script)
        return game::ScriptRun(*config.script, config.rig, config.species, config.dive.space != nullptr);
    if (config.replay) return ReplaySource{*config.replay};
    if (config.handSource.kind == HandSourceKind::OpenXr) return OpenXrSource{};
    return MouseSource(config.rig, config.species);
}

uint64_t drawnSeed() {
    std::random_device device;
    return std::uniform_int_distribution<uint64_t>(100'000, 999'999)(device);
}

Result<SessionConfig> makeSessionConfig(const PlayOptions& options) {
    SessionConfig config;
    config.hands = options.hands;
    config.live = !options.headless && !options.timedemo;
    config.rules = {options.assist, options.freeSwim};
    config.inputSettings = {{"speed", fmt::format("{}", options.speed)},
                            {"closing", enumName(options.controls.closing)}};
    config.seed = options.seed ? *options.seed : config.live ? drawnSeed() : 1;
    std::string diveName = options.dive.empty() ? kFirstDive : options.dive;
    if (Status s = handSourceFor(options).moveTo(config.handSource); !s) return s.error();
    const std::string& file = config.handSource.argument;
    if (config.handSource.kind == HandSourceKind::Script) {
        if (Status s = game::loadScript(file).moveTo(config.script); !s) return s.error();
        config.seed = config.script->seed;
        config.rules = config.script->rules;
    } else if (config.handSource.kind == HandSourceKind::Replay) {
        if (Status s = sim::RecordingReader::open(file).moveTo(config.replay); !s) return s.error();
        const sim::RecordingHeader& header = config.replay->header();
        if (Status s = game::rulesOf(header).moveTo(config.rules); !s) return Error{file, s.error().reason};
        diveName = header.dive;
        config.seed = header.seed;
    }
    auto files = config.script ? game::loadDiveFiles(*config.script) : game::loadDiveFiles(diveName);
    if (!files) return files.error();
    config.species = std::move(files->species);
    config.dive = std::move(files->dive);
    if (config.replay) config.dive.video = game::filmOf(config.replay->header(), config.dive.video);
    if (Status s = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json").moveTo(config.rig);
        !s)
        return s.error();
    return config;
}

GameSession::GameSession(const SessionConfig& config)
    : source(makeSource(config)), dive(config.species, config.dive, config.seed, config.rules),
      inputSettings_(config.inputSettings) {
    track(config);
    events.reserve(256);
    dive.snapshot(after);
    before = after;
    shown = after;
}

void GameSession::tick(float share, float ago_s) {
    game::TickInput input;
    if (playedByAPerson(source)) {
        if (auto* mouse = std::get_if<MouseSource>(&source)) mouse->next(input);
        if (tracked) tracked->tick(input, ago_s);
        if (auto* headset = std::get_if<OpenXrSource>(&source)) headset->next(input, share);
        if (head) {
            const xr::Pose at = xr::between(headBefore_.value_or(*head), *head, share);
            input.worldFromView = at.orientation;
            input.headWorld = at.position;
        }
        input.pause = paused;
        input.restart = restart;
        restart = false;
    } else if (auto* script = std::get_if<game::ScriptRun>(&source)) {
        script->next(after, input);
    } else if (auto* replay = std::get_if<ReplaySource>(&source)) {
        if (!replay->next(input)) {
            ended = true;
            verdict = replay->verdict;
            return;
        }
    }
    const size_t firstEvent = events.size();
    dive.step(input, events);
    const uint64_t hash = recording_ || !playedByAPerson(source) ? dive.stateHash() : 0;
    std::swap(before, after);
    dive.snapshot(after);
    ++ticks;
    if (recording_) addToRecording(input, hash);
    if (auto* script = std::get_if<game::ScriptRun>(&source)) {
        script->observe(std::span(events).subspan(firstEvent), hash, after);
        if (script->finished()) {
            ended = true;
            verdict = script->verdict();
            summary = fmt::format("{} {:016x}", script->name(), script->hash());
        }
    } else if (auto* replay = std::get_if<ReplaySource>(&source)) {
        replay->compare(hash);
        ended |= replay->atEnd();
        if (ended) verdict = replay->verdict;
    }
}

Status GameSession::record(const Path& file) {
    sim::RecordingHeader header = game::recordingHeader(dive);
    header.settings.insert(inputSettings_.begin(), inputSettings_.end());
    return sim::RecordingWriter::create(file, header).moveTo(recording_);
}

void GameSession::addToRecording(const game::TickInput& input, uint64_t hash) {
    std::array<uint8_t, game::kTickInputBytes> bytes;
    game::toBytes(input, bytes);
    recorded_ = recording_->add(bytes, hash);
    if (recorded_) return;
    log::error("{}; the recording ends here", recorded_.error().message());
    recording_.reset();
}

void GameSession::advance(double elapsed_s) {
    events.clear();
    if (tracked) tracked->frame(elapsed_s);
    const int count = clock.advance(elapsed_s);
    for (int i = 0; i < count && !ended; ++i) {
        const double ago_s = (static_cast<double>(clock.alpha()) + count - 1 - i) / sim::kTickRate_Hz;
        tick(static_cast<float>(1 - std::min(1.0, ago_s / elapsed_s)), static_cast<float>(ago_s));
    }
    headBefore_ = head;
    game::interpolate(before, after, clock.alpha(), shown);
    if (tracked) tracked->showElbows(shown);
    const auto* mouse = std::get_if<MouseSource>(&source);
    if (mouse && !(tracked && tracked->moveHands())) mouse->show(shown);
}

void DiveRunner::moveMouse(const Controls* controls, glm::ivec2 size) {
    const glm::vec2 shape = glm::max(size, 1);
    if (auto* mouse = std::get_if<MouseSource>(&session.source))
        mouse->frame(controls, options_.controls, session.shown, dt_s(), glm::radians(options_.fov_deg),
                     shape.x / shape.y);
}

bool DiveRunner::isOver() const {
    if (session.ended) return true;
    const bool watched = clock.mode() == FrameClock::Mode::RealTime;
    if (options_.at_s) {
        const auto at_s = static_cast<double>(*options_.at_s);
        const double frames = at_s * static_cast<double>(options_.fps) / static_cast<double>(options_.speed);
        if (session.shown.time_s >= at_s || (!watched && static_cast<double>(clock.frame()) >= frames))
            return true;
    }
    return !watched && std::holds_alternative<MouseSource>(session.source) &&
           session.after.phase == game::Phase::Results;
}

Status DiveRunner::end(Statistics& statistics) {
    statistics.caught = session.after.caught;
    statistics.score = session.after.score;
    statistics.stateHash = session.dive.stateHash();
    statistics.ticks = session.ticks;
    statistics.summary = session.summary;
    const Status written = session.endRecording();
    return written ? session.verdict : written;
}

} // namespace shoal::app
