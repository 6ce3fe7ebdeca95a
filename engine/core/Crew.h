// A few threads that wait to share a task of the calling thread's.
#pragma once

#include <memory>
#include <type_traits>

namespace shoal {

class Crew {
  public:
    explicit Crew(int helpers); // besides the thread that calls; 0: none
    Crew(Crew&&) noexcept;
    Crew& operator=(Crew&&) noexcept;
    ~Crew();

    // part(0) to part(parts - 1), each once, in any order, by any of the threads; returns when all are done.
    // Allocates nothing. By one thread at a time.
    template <class Part> void share(int parts, Part&& part) {
        run(
            parts, [](void* context, int k) { (*static_cast<std::remove_reference_t<Part>*>(context))(k); },
            &part);
    }

  private:
    struct State;
    void run(int parts, void (*part)(void*, int), void* context);
    std::unique_ptr<State> state_;
};

} // namespace shoal
