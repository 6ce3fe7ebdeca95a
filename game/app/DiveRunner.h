// Runs one session, with a picture or without: its clock, the mouse's hand, ticks, recording, end and
// figures. Main thread.
#pragma once

#include "game/app/FrameClock.h"
#include "game/session/GameSession.h"
#include "game/session/Statistics.h"

namespace shoal::app {

class DiveRunner {
  public:
    // The options must outlive this.
    DiveRunner(const SessionConfig& config, const PlayOptions& options, FrameClock::Mode clockMode)
        : session(config), clock(clockMode, static_cast<double>(options.fps)), options_(options) {}

    // Begins a frame. display_s: time between two pictures by the display; empty: it does not know.
    void beginFrame(std::optional<double> display_s);
    // Moves the mouse's hand, if the session has it. controls: null where nobody plays. size: of the picture.
    void moveMouse(const Controls* controls, glm::ivec2 size);
    // Runs the ticks of this frame; returns the time that they took.
    float advance_ms();
    // Returns whether the session is complete; one that nobody watches ends with its results.
    bool isOver() const;
    // Ends the session: completes its recording and its figures. Returns its verdict.
    Status end(Statistics& statistics);

    GameSession session;
    FrameClock clock;
    double elapsed_s = 0; // game time of this frame

  private:
    const PlayOptions& options_;
};

} // namespace shoal::app
