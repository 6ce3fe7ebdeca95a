// The versions of OpenGL that are asked for, best first. Some drivers (NVIDIA's) give exactly what is asked
// for, not the newest that they have: asked for 3.3 alone, they would never keep layers, which need 4.3.
#pragma once

namespace shoal::platform {

struct GlVersion {
    int major, minor;
};
inline constexpr GlVersion kGlVersions[] = {{4, 3}, {3, 3}};

} // namespace shoal::platform
