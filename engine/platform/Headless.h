// An OpenGL context without display, window or display server: EGL's surfaceless platform.
#pragma once

#include "engine/core/Result.h"

#include <memory>

namespace shoal::platform {

// Versions of OpenGL that are requested, best first. Some drivers (NVIDIA's) give exactly the requested
// version: if only 3.3 were requested, layers, which need 4.3, would never be available.
struct GlVersion {
    int major, minor;
};
inline constexpr GlVersion kGlVersions[] = {{4, 3}, {3, 3}};

class Headless {
  public:
    // Makes the context current on the calling thread. OpenGL 3.3 core or newer.
    static Result<Headless> open();

  private:
    explicit Headless(void* display);
    std::unique_ptr<void, void (*)(void*)> display_; // EGL's display; destroying it destroys the context
};

} // namespace shoal::platform
