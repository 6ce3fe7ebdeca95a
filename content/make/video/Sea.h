// The moving surface and the light that it focuses: both repeat after the film, and in space after a tile.
#pragma once

#include "content/make/video/Scene.h"

#include <complex>

namespace shoal::reef {

// The surface's slopes at one time, from a sum of waves whose frequencies fit the film a whole number of
// times (Tessendorf 2001, "Simulating Ocean Water", with the frequencies rounded as in its section 4.2).
class Sea {
  public:
    static constexpr int kSide = 512;
    explicit Sea(const Scene& scene);

    // turn: time in films, 0..1.
    void advance(float turn);
    // d height / d (x, z) at a place of the surface, averaged over about `width` metres.
    vec2 slope(const vec2& xz, float width) const;
    const std::vector<vec2>& slopes() const { return levels_[0]; }
    float tile() const { return tile_; }

  private:
    float tile_ = 0;
    std::vector<std::complex<float>> amplitudes_; // of slope along x and z per wave, at time 0
    std::vector<float> turns_;                    // periods a film
    std::vector<std::vector<vec2>> levels_;       // means over 1, 2, 4.. texels
};

// Sunlight below the waves, as a multiple of what a level sea would let through.
class Caustics {
  public:
    explicit Caustics(const Scene& scene);
    void advance(const Sea& sea);
    float at(const vec3& pWorld) const;

  private:
    static constexpr int kSide = 512;
    vec3 toSun_{0}, toSunAir_{0};
    float tile_ = 0;
    std::vector<float> depths_; // metres, a layer each
    std::vector<std::vector<float>> layers_;
};

} // namespace shoal::reef
