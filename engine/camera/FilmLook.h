// What shows in a frame that it was filmed and coded. Values are display-coded, 0 to 1; lengths are texels of
// the frame at its equator.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>

namespace shoal::camera {

constexpr int kBrightnesses = 8; // bands of luma, evenly from 0 to 1

struct FilmLook {
    // Standard deviation of the Gaussian by which the film's sharpest edges are softer than texels that each
    // hold the mean of their own square.
    float blur_texels = 0;

    // Standard deviation of luma by its own band. Fine: of single texels; coarse: of the mean over 2 x 2 of
    // them, beyond what fine noise leaves there.
    std::array<float, kBrightnesses> fineNoise{}, coarseNoise{};

    glm::vec3 black{0}, white{1}; // what nearly nothing in the frame is darker or brighter than, by channel

    // Share of the light that port and lens scatter over degrees; Glow.h.
    float glare = 0;

    glm::ivec2 chromaTexels{1}; // texels across and down that share one colour: 2, 2 is 4:2:0
};

// The blur as a modulation transfer function: what is left of a sine's contrast, its texel's own extent not
// counted.
inline float modulation(const FilmLook& look, float cyclesPerTexel) {
    const float turns = 6.2831853f * look.blur_texels * cyclesPerTexel;
    return std::exp(-0.5f * turns * turns);
}

} // namespace shoal::camera
