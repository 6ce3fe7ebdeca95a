#include "game/session/GameSession.h"

#include <algorithm>
#include <array>

namespace shoal::app {

namespace {

HandSource makeSource(const SessionConfig& config) {
    if (config.script) return game::ScriptRun(*config.script, config.rig, config.species);
    if (config.replay) return ReplaySource{*config.replay};
    if (config.handSource.kind == HandSourceKind::OpenXr) return OpenXrSource{};
    return MouseSource(config.rig, config.species);
}

} // namespace

GameSession::GameSession(const SessionConfig& config)
    : source(makeSource(config)), dive(config.species, config.dive, config.seed),
      recording(game::recordingHeader(dive), 16384) {
    if (std::holds_alternative<MouseSource>(source) && config.handSource.kind != HandSourceKind::Mouse)
        tracked.emplace(config.handSource, config.hands, config.rig, config.live);
    events.reserve(256);
    dive.snapshot(after);
    before = after;
    shown = after;
}

void GameSession::tick(bool record, float share, int ticksLeft) {
    game::TickInput input;
    if (playedByAPerson(source)) {
        if (auto* mouse = std::get_if<MouseSource>(&source)) mouse->next(input);
        if (tracked) tracked->tick(input, ticksLeft);
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
        if (replay->tick >= replay->recording.ticks()) {
            ended = true;
            return;
        }
        input = game::fromBytes(replay->recording.input(replay->tick).first<game::kTickInputBytes>());
    }
    tickEvents_.clear();
    dive.step(input, tickEvents_);
    std::swap(before, after);
    dive.snapshot(after);
    ++ticks;
    events.insert(events.end(), tickEvents_.begin(), tickEvents_.end());
    if (record) {
        std::array<uint8_t, game::kTickInputBytes> bytes;
        game::toBytes(input, bytes);
        recording.add(bytes, dive.stateHash());
    }
    if (auto* script = std::get_if<game::ScriptRun>(&source)) {
        script->observe(tickEvents_, after);
        if (script->finished()) {
            ended = true;
            verdict = script->verdict();
        }
    } else if (auto* replay = std::get_if<ReplaySource>(&source)) {
        if (Status same = replay->recording.compare(replay->tick, dive.stateHash()); !same) {
            ended = true;
            verdict = same;
        }
        ++replay->tick;
        ended |= replay->tick >= replay->recording.ticks();
    }
}

void GameSession::advance(double elapsed_s, bool record) {
    events.clear();
    if (tracked) tracked->frame(elapsed_s);
    const int count = clock.advance(elapsed_s);
    for (int i = 0; i < count && !ended; ++i) {
        const double ticksAfter = static_cast<double>(clock.alpha()) + count - 1 - i; // to this frame
        tick(record, static_cast<float>(1 - std::min(1.0, ticksAfter / sim::kTickRate_Hz / elapsed_s)),
             count - i);
    }
    headBefore_ = head;
    game::interpolate(before, after, clock.alpha(), shown);
}

} // namespace shoal::app
