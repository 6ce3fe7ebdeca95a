#include "game/app/Run.h"

#include "game/Playback.h"

#include <algorithm>
#include <array>

namespace shoal::app {

namespace {

HandSource makeSource(const Plan& plan) {
    if (plan.script) return game::ScriptRun(*plan.script, plan.rig, plan.species);
    if (plan.replay) return ReplaySource{*plan.replay};
    if (plan.openXrHands) return OpenXrSource{};
    return MouseSource(plan.rig, plan.species);
}

} // namespace

Run::Run(const Plan& plan)
    : source(makeSource(plan)), dive(plan.species, plan.dive, plan.seed),
      recording(game::headerFor(dive), 16384) {
    if (std::holds_alternative<MouseSource>(source) && plan.hands.source != "mouse")
        tracked.emplace(plan.hands, plan.rig, plan.live);
    events.reserve(256);
    dive.snapshot(after);
    before = after;
    shown = after;
}

void Run::tick(bool keep, float share, int ticksLeft) {
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
    if (keep) {
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

void Run::advance(double elapsed_s, bool keep) {
    events.clear();
    if (tracked) tracked->frame(elapsed_s);
    const int count = clock.advance(elapsed_s);
    for (int i = 0; i < count && !ended; ++i) {
        const double ticksAfter = static_cast<double>(clock.alpha()) + count - 1 - i; // to this frame
        tick(keep, static_cast<float>(1 - std::min(1.0, ticksAfter / sim::kTickRate_Hz / elapsed_s)),
             count - i);
    }
    headBefore_ = head;
    game::interpolate(before, after, clock.alpha(), shown);
}

} // namespace shoal::app
