// Times and counts of frames: of the last ones for the developer's panel, of all measured ones for --stats.
#pragma once

#include "game/session/GameSession.h"
#include "game/session/Statistics.h"
#include "game/ui/Hud.h"
#include "game/views/Environment.h"

#include <string>

namespace shoal::app {

class FrameMeasurements {
  public:
    void setRenderer(std::string name) { statistics_.renderer = std::move(name); }
    void beginSession(bool measured) { measured_ = measured; }

    void simulated(double ms) { times_.sim_ms = static_cast<float>(ms); }
    // fresh: a new frame of the video is shown.
    void environmentUpdated(const Environment& environment, bool fresh);
    void drawn(int draws, int triangles, const Quality& quality);
    void qualityChosen(const Quality& quality); // for the next frame
    void frameDone(const Environment& environment, double frame_ms, bool firstFrame);
    void endSession(const GameSession& session);

    const FrameTimes& times() const { return times_; }
    const Statistics& statistics() const { return statistics_; }

  private:
    Statistics statistics_;
    FrameTimes times_;
    bool measured_ = false, fresh_ = false;
};

} // namespace shoal::app
