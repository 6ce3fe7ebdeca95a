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
    Akyuz,  // akyuzRadiance()
    Landis, // landisRadiance()
};

// Returns whether a PQ or HLG film's light is taken as measured; other methods work on coded values.
inline bool takesMeasured(FrameRadiance from) {
    return from == FrameRadiance::Auto || from == FrameRadiance::Linear;
}

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

// --- Operators that the thesis names beside its own. decoded: linear sRGB, 0 to 1.

constexpr float kExpandedWhite = 10; // radiance of white

// Returns the luminance of linear light, Rec. 709.
inline float linearLuminance(const glm::vec3& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

// Returns the radiance of luminance k ((L - minimum) / (maximum - minimum))^gamma, the thesis' eq. 2.3:
// Akyuz, Fleming, Riecke, Reinhard and Buelthoff 2007, "Do HDR Displays Support LDR Content?". minimum,
// maximum: luminances of the frame. gamma: of the two on tests/bench/figures/chart.md the better one.
inline glm::vec3 akyuzRadiance(const glm::vec3& decoded, float minimum, float maximum,
                               float k = kExpandedWhite, float gamma = 2.2f) {
    const float l = linearLuminance(decoded), range = std::max(maximum - minimum, 1e-6f);
    return l > 0 ? decoded * (k * std::pow(std::max(0.0f, l - minimum) / range, gamma) / l) : glm::vec3(0);
}

// Returns the radiance by Landis 2002, "Production-Ready Global Illumination": up to a luminance of 0.5 as
// decoded; above, blended to kExpandedWhite times that with the square of how far above.
inline glm::vec3 landisRadiance(const glm::vec3& decoded) {
    const float above = std::max(0.0f, linearLuminance(decoded) - 0.5f) / 0.5f;
    return decoded * (1 + above * above * (kExpandedWhite - 1));
}

} // namespace shoal::light
