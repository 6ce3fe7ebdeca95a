// The versions of OpenGL that are requested, best first. Some drivers (NVIDIA's) give exactly the requested
// version, not their newest: with 3.3 alone layers, which need 4.3, would never be available.
#pragma once

namespace shoal::platform {

struct GlVersion {
    int major, minor;
};
inline constexpr GlVersion kGlVersions[] = {{4, 3}, {3, 3}};

} // namespace shoal::platform
