// An OpenGL context without display, window or display server: EGL's surfaceless platform.
#pragma once

#include "engine/core/Result.h"

#include <memory>

namespace shoal::platform {

class Headless {
  public:
    // Makes the context current on the calling thread. OpenGL 3.3 core or newer.
    static Result<Headless> open();

    Headless(Headless&&) noexcept;
    Headless& operator=(Headless&&) noexcept;
    ~Headless();

  private:
    struct State;
    explicit Headless(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace shoal::platform
