// One run of the simulation, and what feeds it.
#pragma once

#include "engine/sim/FixedStep.h"
#include "engine/sim/Recording.h"
#include "engine/xr/Tracked.h"
#include "game/Dive.h"
#include "game/app/HandSource.h"
#include "game/app/Plan.h"
#include "game/app/TrackedHands.h"

#include <optional>
#include <vector>

namespace shoal::app {

struct Run {
    explicit Run(const Plan& plan);

    // Steps as many ticks as this much display time is worth. keep: into the recording.
    void advance(double elapsed_s, bool keep);

    HandSource source;
    std::optional<TrackedHands> tracked; // beside the mouse
    game::Dive dive;
    sim::FixedStep clock;
    sim::Recording recording;
    game::Snapshot before, after, shown;
    std::vector<game::Event> events; // of this frame's ticks
    uint64_t ticks = 0;
    std::optional<xr::Pose> head; // of a headset; else the source tells where the player looks
    bool paused = false, restart = false;
    bool ended = false; // the source has no more to say
    Status verdict = Done{};

  private:
    // share: where the tick lies between the last frame and this one, 0 to 1; ticksLeft: of this frame, this
    // one counted.
    void tick(bool keep, float share, int ticksLeft);
    std::optional<xr::Pose> headBefore_; // in the last frame
    std::vector<game::Event> tickEvents_;
};

} // namespace shoal::app
