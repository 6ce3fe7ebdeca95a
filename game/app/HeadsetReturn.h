// Polls the OpenXR runtime for a headset that was lost in mid-dive. The runtime may take seconds to answer,
// so a thread of its own asks it. Main thread.
#pragma once

#include <future>

namespace shoal::app {

class HeadsetReturn {
  public:
    void await();                       // begins polling: the headset was just lost
    void forget() { awaited_ = false; } // ends polling: the dive goes on without the headset, or with it
    // Polls, once a frame. Returns true when the headset is there and can be opened.
    bool step(float dt_s);
    // Waits for the answer under way; to be called before a headset is opened.
    void settle();

    static constexpr float kEvery_s = 2;

  private:
    bool awaited_ = false;
    float pause_s_ = 0; // seconds before the next question
    std::future<bool> answer_;
};

} // namespace shoal::app
