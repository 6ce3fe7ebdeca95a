// A few threads that wait to share a task of the calling thread's.
#pragma once

#include <memory>

namespace shoal {

class Crew {
  public:
    explicit Crew(int helpers); // besides the thread that calls; 0: none
    Crew(Crew&&) noexcept;
    Crew& operator=(Crew&&) noexcept;
    ~Crew(); // what has begun is ended, what has not is left

    // The helpers begin: part(0) to part(parts - 1), each once, in any order. `part` must live until
    // finish(). Allocates nothing. By one thread at a time, one task at a time.
    template <class Part> void start(int parts, Part& part) {
        start(
            parts, [](void* context, int k) { (*static_cast<Part*>(context))(k); }, &part);
    }
    void finish(); // does what is left, too; returns when all is done

    template <class Part> void share(int parts, Part&& part) {
        start(parts, part);
        finish();
    }

  private:
    struct State;
    void start(int parts, void (*part)(void*, int), void* context);
    std::unique_ptr<State> state_;
};

} // namespace shoal
