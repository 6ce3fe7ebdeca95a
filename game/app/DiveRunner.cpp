#include "game/app/DiveRunner.h"

#include <glm/common.hpp>

namespace shoal::app {

void DiveRunner::beginFrame(std::optional<double> display_s) {
    clock.beginFrame();
    elapsed_s = clock.elapsed_s(display_s) * static_cast<double>(options_.speed);
}

void DiveRunner::moveMouse(const Controls* controls, glm::ivec2 size) {
    const glm::vec2 shape = glm::max(size, 1);
    if (auto* mouse = std::get_if<MouseSource>(&session.source))
        mouse->frame(controls, options_.controls, session.shown, static_cast<float>(elapsed_s),
                     glm::radians(options_.fov_deg), shape.x / shape.y);
}

float DiveRunner::advance_ms() {
    const auto began = std::chrono::steady_clock::now();
    session.advance(elapsed_s);
    return std::chrono::duration<float, std::milli>(std::chrono::steady_clock::now() - began).count();
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
    const Status written = session.endRecording();
    return written ? session.verdict : written;
}

} // namespace shoal::app
