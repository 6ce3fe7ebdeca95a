// Response of a video's camera and codec: blur, noise, levels, glare and chroma subsampling. Values are
// display-coded, 0 to 1; lengths are texels of the frame at its equator.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace shoal::camera {

constexpr int kBrightnesses = 8; // bands of luma, evenly from 0 to 1

struct CameraResponse {
    // Standard deviation of the Gaussian blur of the sharpest edges, beyond a box filter of one texel.
    float blur_texels = 0;

    // Standard deviation of luma's noise by band of brightness. Fine: of single texels; coarse: of means over
    // 2 x 2 texels, beyond the contribution of fine noise.
    std::array<float, kBrightnesses> fineNoise{}, coarseNoise{};

    glm::vec3 black{0}, white{1}; // 0.1 and 99.9 % quantiles of each channel

    // Fraction of the light that port and lens scatter by some degrees; Glare.h.
    float glare = 0;

    glm::ivec2 chromaTexels{1}; // chroma subsampling, horizontal and vertical: 2, 2 is 4:2:0
};

} // namespace shoal::camera
