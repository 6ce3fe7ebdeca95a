// Asks after a headset that was lost in mid-dive until it is back. A runtime may take seconds to answer, so
// it is asked on a thread of its own. Main thread.
#pragma once

#include <future>

namespace shoal::app {

class HeadsetReturn {
  public:
    void await();                       // it was lost just now
    void forget() { awaited_ = false; } // somebody goes on without it, or with it
    // Once a frame. True: it is there; open it.
    bool step(float dt_s);
    // Waits for the answer to what was asked: before a headset is opened.
    void settle();

    static constexpr float kEvery_s = 2;

  private:
    bool awaited_ = false;
    float pause_s_ = 0; // until it is asked for again
    std::future<bool> answer_;
};

} // namespace shoal::app
