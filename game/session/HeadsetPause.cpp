#include "game/session/HeadsetPause.h"

#include <algorithm>

namespace shoal::app {

void HeadsetPause::step(const HeadsetMoment& now, float dt_s, bool& paused, bool& restart) {
    fade_ = std::clamp(fade_ + (now.headTracked ? -dt_s / kFadeIn_s : dt_s / kFadeOut_s), 0.0f, 1.0f);
    followHeadset(now, dt_s, paused);
    if (now.menu && !menuWas_ && now.plays && begun_ && !now.results) {
        paused = !paused;
        byItself_ = false;
    }
    menuWas_ = now.menu;
    readFists(now, dt_s, paused, restart);
}

void HeadsetPause::followHeadset(const HeadsetMoment& now, float dt_s, bool& paused) {
    if (now.plays && now.headTracked) {
        steady_s_ += dt_s;
        if (begun_ && !(paused && byItself_)) return;
        const bool steady = steady_s_ >= kSteady_s;
        begun_ |= steady;
        paused = byItself_ = !steady;
        return;
    }
    steady_s_ = 0;
    const bool takenOff = !now.plays && begun_;
    if (!paused || takenOff) byItself_ = !takenOff;
    paused = true;
}

void HeadsetPause::readFists(const HeadsetMoment& now, float dt_s, bool& paused, bool& restart) {
    const bool asks = now.plays && (now.results || (paused && !byItself_));
    if (!asks || !waiting_) {
        opened_ = {};
        fist_s_ = {};
    }
    waiting_ = asks;
    if (!asks) return;
    for (size_t i = 0; i < 2; ++i) {
        if (now.grip[i] >= 0 && now.grip[i] < kOpen) opened_[i] = true;
        fist_s_[i] = opened_[i] && now.grip[i] > kFist ? fist_s_[i] + dt_s : 0;
    }
    if (now.results) {
        restart |= std::min(fist_s_[0], fist_s_[1]) >= kAgain_s;
        if (restart) fist_s_ = {};
    } else if (std::max(fist_s_[0], fist_s_[1]) >= kGoOn_s) {
        paused = false;
    }
}

} // namespace shoal::app
