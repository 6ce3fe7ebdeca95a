// Frames of a sea whose water is known: a sandy floor below, a surface above, walls of rock where asked for.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Random.h"
#include "engine/light/FrameView.h"
#include "engine/math/Colour.h"
#include "engine/math/LatLong.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/trigonometric.hpp>

namespace shoal::water {

struct Sea {
    glm::vec3 attenuation_perM{0.20f, 0.10f, 0.08f};
    glm::vec3 veilLin{0.02f, 0.10f, 0.20f}; // at the horizon
    glm::vec3 sandLin{0.45f, 0.50f, 0.45f}; // albedo of the floor
    glm::vec3 rockLin{0.05f, 0.07f, 0.07f};
    float eyeHeight_m = 1.2f;
    float downwelling = 0.4f; // K / beta
    float wallShare = 0;      // share of the horizon with a wall `wall_m` away, up to 30 degrees
    float wall_m = 4;
    float texture = 0; // relative variation of sand and rock
};

// A ray through water: the light scattered into it, and the transmitted share of the light from its end.
struct Ray {
    glm::vec3 glowLin, left;
    glm::vec3 from(const glm::vec3& endLin) const { return glowLin + left * endLin; }
};

// Sums single scattering along a ray, in steps of a centimetre at first. sine: sine of the ray's
// elevation.
inline Ray rayThrough(const Sea& sea, float sine, float distance_m) {
    Ray ray{glm::vec3(0), glm::exp(-sea.attenuation_perM * distance_m)};
    const glm::vec3 source = sea.veilLin * sea.attenuation_perM, k = sea.downwelling * sea.attenuation_perM;
    float at = 0;
    while (at < distance_m && at < 200) {
        const float step = std::min(0.01f + 0.01f * at, distance_m - at), middle = at + step / 2;
        ray.glowLin += source * glm::exp((k * sine - sea.attenuation_perM) * middle) * step;
        at += step;
    }
    return ray;
}

constexpr float kFar_m = 1e4f;

inline ImageRgb8 filmed(const Sea& sea, uint64_t seed = 1) {
    constexpr int kWidth = 512, kHeight = kWidth / 2;
    const glm::vec3 skyLin(0.7f, 0.85f, 1.0f); // seen through the surface
    ImageRgb8 frame(kWidth, kHeight);
    Random random(seed, 1);
    for (int y = 0; y < kHeight; ++y) {
        const float elevation = (0.5f - (static_cast<float>(y) + 0.5f) / kHeight) * 3.14159265f;
        const float sine = std::sin(elevation);
        const float open_m = sine < 0 ? sea.eyeHeight_m / -sine : kFar_m;
        const float wall_m = sea.wall_m / std::cos(elevation);
        const bool wallHere = sine < 0.5f && wall_m < open_m;
        const Ray open = rayThrough(sea, sine, open_m), toWall = rayThrough(sea, sine, wall_m);
        for (int x = 0; x < kWidth; ++x) {
            const float texture = 1 + sea.texture * random.between(-1, 1);
            const bool wall = wallHere && static_cast<float>(x) < sea.wallShare * kWidth;
            const glm::vec3 lin = elevation > 0.72f ? skyLin
                                  : wall            ? toWall.from(sea.rockLin * texture)
                                                    : open.from(sea.sandLin * texture);
            for (int c = 0; c < 3; ++c)
                frame.at(x, y)[c] = static_cast<uint8_t>(
                    std::lround(255 * glm::clamp(math::srgbFromLinear(lin[c]), 0.0f, 1.0f)));
        }
    }
    return frame;
}

inline ImageRgb8 evenFrame(uint8_t red, uint8_t green, uint8_t blue) {
    ImageRgb8 frame(256, 128);
    for (size_t i = 0; i < frame.pixels.size(); i += 3)
        frame.pixels[i] = red, frame.pixels[i + 1] = green, frame.pixels[i + 2] = blue;
    return frame;
}

inline light::FrameView viewOf(const ImageRgb8& frame) {
    return {frame.pixels.data(), frame.width, frame.height, 3 * frame.width, false};
}

} // namespace shoal::water
