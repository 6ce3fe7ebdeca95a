// Chooses among the variants of shaders that include render/Output.glsl by an exposure.
#pragma once

#include "engine/render/View.h"

namespace shoal::render {

// The defines of the variants' first bits, in this order.
#define SHOAL_TONE_DEFINES "TONE_ACES", "TONE_LINEAR", "FRAME_SRGB"
constexpr int kToneFeatures = 3;

inline unsigned toneFeatures(const Exposure& exposure) {
    return (exposure.curve == ToneCurve::Aces ? 1u << 0 : 0u) | (exposure.isLinear() ? 1u << 1 : 0u) |
           (exposure.frames == FrameCoding::Srgb ? 1u << 2 : 0u);
}

} // namespace shoal::render
