// Converts display values to light and back: the thesis' inverse tone mapping, its eq. 4.1 to 4.3, and its
// exact inverse. Twin of shaders/light/ToneCurve.glsl.
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::light {

// Method of computing radiance from a frame's coded values.
enum class FrameRadiance {
    Auto,   // decoded sRGB, with an estimate of clipped light: ClippedLight.h
    Thesis, // radianceFromDisplay()
    Linear, // decoded sRGB: clipped light stays white
};

// Returns the luminance by eq. 4.3, made for coded values. Being linear, it serves for linear light too.
inline float thesisLuminance(const glm::vec3& c) { return 0.30f * c.x + 0.59f * c.y + 0.11f * c.z; }

// Returns the radiance by eq. 4.1 and 4.2: 11.8 for white, 0 for black. colour: coded RGB, 0 to 1.
inline glm::vec3 radianceFromDisplay(const glm::vec3& colour) {
    const float l = thesisLuminance(colour);
    const float l2 = l * l;
    const float l4 = l2 * l2;
    return (10.0f * l4 * l4 * l2 + 1.8f) * colour;
}

// Returns the inverse of radianceFromDisplay(): a perfect mirror shows the video's own colours. radiance: not
// negative; the result is not clamped.
//
// Colour is a multiple of radiance, so only its luminance L is unknown: y = 10 L^11 + 1.8 L, with y the
// radiance's luminance. That function is convex and rising, and the start lies at or above its root, so
// Newton's method converges from above; after six steps only rounding errors are left (the start is worst
// near y = 3.3).
inline glm::vec3 displayFromRadiance(const glm::vec3& radiance) {
    const float y = thesisLuminance(radiance);
    if (y <= 1e-6f) return radiance / 1.8f;
    float l = std::min(y / 1.8f, std::pow(y * 0.1f, 1.0f / 11.0f));
    for (int i = 0; i < 6; ++i) {
        const float l2 = l * l;
        const float l4 = l2 * l2;
        const float l10 = l4 * l4 * l2;
        l -= (10.0f * l10 * l + 1.8f * l - y) / (110.0f * l10 + 1.8f);
    }
    return radiance * (l / y);
}

} // namespace shoal::light
