// Tone curve of the films' camera.
#pragma once

#include <algorithm>
#include <cmath>

namespace shoal::reef {

// Applies a short toe, a shoulder that compresses highlights below the clip, and the sRGB encoding.
inline float toned(float x) {
    x = std::max(x, 0.0f);
    const float toe = x * x / (x + 0.004f);
    const float shoulder = toe < 0.55f ? toe : 0.55f + (toe - 0.55f) / (1 + (toe - 0.55f) * 0.62f);
    const float y = std::min(shoulder, 1.0f);
    return y <= 0.0031308f ? 12.92f * y : 1.055f * std::pow(y, 1 / 2.4f) - 0.055f;
}

} // namespace shoal::reef
