// A thread pool that runs one parallel loop at a time, with the calling thread's help; and thread priorities.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace shoal {

class ThreadPool {
  public:
    explicit ThreadPool(int helpers); // threads besides the calling one; may be 0
    ~ThreadPool();                    // finishes the parts in progress, drops those not yet begun

    // Begins a loop: the helpers, and then finish(), call part(0) to part(parts - 1), each once, in any
    // order. `part` must live until finish() returns. Allocates nothing. One loop at a time.
    template <class Part> void start(int parts, Part& part) { begin(parts, std::ref(part)); }
    void finish(); // helps with the parts; returns when all are done

    template <class Part> void parallelFor(int parts, Part&& part) {
        start(parts, part);
        finish();
    }

  private:
    ThreadPool() = default;
    void begin(int parts, std::function<void(int)> part);
    void work(std::unique_lock<std::mutex>& lock);
    void wait();

    std::mutex mutex_;
    std::condition_variable called_, done_;
    // Guarded by mutex_:
    std::function<void(int)> part_;
    int next_ = 0, parts_ = 0, unfinished_ = 0;
    bool stop_ = false;
    std::vector<std::jthread> helpers_; // last: joined before the others end
};

// Lowers the priority of the calling thread and of its later ones, where the system has priorities: for work
// that must be done within a video frame, beside threads that must be done within a display frame.
void lowerThreadPriority();

} // namespace shoal
