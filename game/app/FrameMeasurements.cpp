#include "game/app/FrameMeasurements.h"

#include <algorithm>

namespace shoal::app {

void FrameMeasurements::environmentUpdated(const Environment& environment, bool fresh) {
    fresh_ = fresh;
    times_.light_ms = environment.light_ms();
    times_.decode_ms = environment.decode_ms();
    times_.upload_ms = environment.upload_ms();
    if (!fresh || !measured_) return;
    statistics_.light_ms.add(static_cast<double>(times_.light_ms));
    statistics_.decode_ms.add(static_cast<double>(times_.decode_ms));
    statistics_.upload_ms.add(static_cast<double>(times_.upload_ms));
}

void FrameMeasurements::drawn(int draws, int triangles, const Quality& quality) {
    times_.draws = draws;
    times_.triangles = triangles;
    times_.quality = quality;
}

void FrameMeasurements::qualityChosen(const Quality& quality) {
    statistics_.minScale = std::min(statistics_.minScale, quality.scale);
}

void FrameMeasurements::frameDone(const Environment& environment, double frame_ms, bool firstFrame) {
    times_.add(static_cast<float>(frame_ms));
    if (!measured_) return;
    if (!firstFrame) statistics_.frame_ms.add(frame_ms);
    if (const media::LivePlayer* stream = environment.live())
        statistics_.live.add(*stream, fresh_ && !firstFrame);
}

void FrameMeasurements::endSession(const GameSession& session) {
    statistics_.draws = times_.draws;
    statistics_.triangles = times_.triangles;
    statistics_.caught = session.after.caught;
    statistics_.score = session.after.score;
    statistics_.stateHash = session.dive.stateHash();
    statistics_.ticks = session.ticks;
}

} // namespace shoal::app
