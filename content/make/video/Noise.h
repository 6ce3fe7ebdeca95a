// Noise: functions for meshes that are built once, and a small repeating volume for look-ups in each pixel.
#pragma once

#include "content/make/video/Scene.h"

#include <array>
#include <cstdint>

namespace shoal::reef {

uint32_t hash(uint32_t x, uint32_t y, uint32_t z);
inline float unitFrom(uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

// Gradient noise about -1..1, lattice of one metre; `period` > 0 repeats it after so many cells.
float gradientNoise(const vec3& p, int period = 0);
// Sum of octaves of gradient noise, each of half the scale and half the strength.
float fractalNoise(const vec3& p, int octaves);
// Distance to the nearest of scattered points (one a cell), about 0..1, and that point's own number 0..1.
vec2 cellNoise(const vec3& p, int period = 0);

// A field of height -1..1 and its gradient, repeating after 1 in each direction.
class NoiseVolume {
  public:
    static constexpr int kSide = 64;
    enum class Kind { Lumps, Cells };
    explicit NoiseVolume(Kind kind);
    // x, y, z: gradient per unit of p, w: height.
    vec4 at(const vec3& p) const;

  private:
    std::vector<std::array<int8_t, 4>> texels_;
    float gradientScale_ = 1;
};

} // namespace shoal::reef
