// A thread pool, and priorities. The pool runs one parallel loop at a time; the calling thread takes part.
#pragma once

#include <memory>

namespace shoal {

class ThreadPool {
  public:
    explicit ThreadPool(int helpers); // threads besides the calling one; may be 0
    ThreadPool(ThreadPool&&) noexcept;
    ThreadPool& operator=(ThreadPool&&) noexcept;
    ~ThreadPool(); // finishes the parts in progress, drops those not yet begun

    // The helpers begin to call part(0) to part(parts - 1), each once, in any order. `part` must live until
    // finish(). Allocates nothing. One loop at a time.
    template <class Part> void start(int parts, Part& part) {
        start(
            parts, [](void* context, int k) { (*static_cast<Part*>(context))(k); }, &part);
    }
    void finish(); // takes part; returns when all parts are done

    template <class Part> void parallelFor(int parts, Part&& part) {
        start(parts, part);
        finish();
    }

  private:
    struct State;
    void start(int parts, void (*part)(void*, int), void* context);
    std::unique_ptr<State> state_;
};

// Lowers the priority of the calling thread and of those it starts from now on: for work with a deadline of a
// video frame, beside threads with the deadline of a display frame. Without effect where the system has no
// priorities for threads.
void lowerThreadPriority();

} // namespace shoal
