// An OpenGL context without display, window or display server: EGL's surfaceless platform.
#pragma once

#include "engine/core/Result.h"

#include <memory>

namespace shoal::platform {

class Headless {
  public:
    // Makes the context current on the calling thread. OpenGL 3.3 core or newer.
    static Result<Headless> open();

  private:
    explicit Headless(void* display);
    std::unique_ptr<void, void (*)(void*)> display_; // EGL's display; destroying it destroys the context
};

} // namespace shoal::platform
