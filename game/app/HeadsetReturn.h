// Polls the OpenXR runtime for a headset that was lost in mid-dive. The runtime may take seconds to answer,
// so a thread of its own asks it. Main thread.
#pragma once

#include "engine/xr/Headset.h"

#include <chrono>
#include <future>

namespace shoal::app {

class HeadsetReturn {
  public:
    // Begins polling: the headset was just lost.
    void await() {
        awaited_ = true;
        pause_s_ = kEvery_s; // a runtime that shuts down still answers for a while
    }
    void forget() { awaited_ = false; } // ends polling: the dive goes on without the headset, or with it
    // Polls, once a frame. Returns true when the headset is there and can be opened.
    bool step(float dt_s) {
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
    // Waits for the answer under way; to be called before a headset is opened.
    void settle() {
        if (answer_.valid()) answer_.get();
    }

  private:
    static constexpr float kEvery_s = 2;
    bool awaited_ = false;
    float pause_s_ = 0; // seconds before the next question
    std::future<bool> answer_;
};

} // namespace shoal::app
