#include "game/app/HeadsetReturn.h"

#include "engine/xr/Headset.h"

#include <chrono>

namespace shoal::app {

void HeadsetReturn::await() {
    awaited_ = true;
    pause_s_ = kEvery_s; // a runtime that shuts down still answers for a while
}

bool HeadsetReturn::step(float dt_s) {
    if (!awaited_) return false;
    if (answer_.valid()) {
        if (answer_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
        pause_s_ = kEvery_s;
        return answer_.get();
    }
    pause_s_ -= dt_s;
    if (pause_s_ <= 0) answer_ = std::async(std::launch::async, &xr::Headset::isThere);
    return false;
}

void HeadsetReturn::settle() {
    if (answer_.valid()) answer_.get();
}

} // namespace shoal::app
