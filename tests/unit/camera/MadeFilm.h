// Frames with a known blur, known noise, known levels and known chroma.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Random.h"
#include "engine/light/FrameView.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::camera {

struct Film {
    int width = 800, height = 256; // pixels; the estimator reads every row of the middle half
    float blur_texels = 1;
    float softer = 0;     // additional blur of four edges in five, as of things without sharp edges
    float noise = 0;      // standard deviation, in values of 255
    float noiseSlope = 0; // increase of it from black to white, in values of 255
    int grain_texels = 1; // squares that share their noise
    float black = 20, white = 235;
};

inline float gaussian(Random& random) { // Box and Muller 1958
    const float u = std::max(random.unit(), 1e-7f);
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi_v<float> * random.unit());
}

// Returns a frame of tilted bars (up to 20 degrees) 40 texels apart, of random greys with a tint. Each row is
// stretched by its latitude, so that the blur is the same angle everywhere.
inline ImageRgb8 filmed(const Film& film, uint64_t seed = 1) {
    ImageRgb8 frame(film.width, film.height);
    Random random(seed, 3);
    constexpr int kApart = 40;
    const int bars = film.width / kApart;
    std::vector<float> greys, blues, reds, leans, places;
    for (int i = 0; i < bars; ++i) {
        greys.push_back(random.between(film.black, film.white));
        blues.push_back(random.between(-25, 25));
        reds.push_back(random.between(-25, 25));
        leans.push_back(random.between(-0.36f, 0.36f));
        places.push_back(static_cast<float>((i + 1) * kApart) + random.between(-4, 4));
    }
    const auto shown = [&](const std::vector<float>& of, float x, float y) {
        const float latitude = (0.5f - y / static_cast<float>(film.height)) * std::numbers::pi_v<float>;
        const int near = static_cast<int>(x) / kApart;
        float value = of[static_cast<size_t>(std::clamp(near - 1, 0, bars - 1))];
        for (int i = std::max(near - 1, 0); i < std::min(near + 2, bars - 1); ++i) {
            const auto n = static_cast<size_t>(i);
            const float blur = i % 5 ? std::hypot(film.blur_texels, film.softer) : film.blur_texels;
            const float sigma = std::max(blur / std::cos(latitude), 1e-3f);
            const float at = places[n] + leans[n] * (std::fmod(y, 16.0f) - 8);
            const float beyond =
                std::erf((x - at) * std::cos(std::atan(leans[n])) / sigma * std::numbers::sqrt2_v<float> / 2);
            value += (of[n + 1] - of[n]) * (0.5f + 0.5f * beyond);
        }
        return value;
    };
    // Bars are tilted so little that their positions within a row count as even.
    const auto mean = [&](const std::vector<float>& of, int x, int y, int size) {
        float sum = 0;
        const int samples = 5 * size;
        for (int i = 0; i < samples; ++i)
            sum += shown(of, static_cast<float>(x) + (static_cast<float>(i) + 0.5f) / 5,
                         static_cast<float>(y) + 0.5f * static_cast<float>(size));
        return sum / static_cast<float>(samples);
    };
    // Colours also change in bands down the frame.
    const auto meanTint = [&](const std::vector<float>& of, int x, int y, int size) {
        const float turn = 2 * std::numbers::pi_v<float> / 11, top = turn * static_cast<float>(y),
                    bottom = turn * static_cast<float>(y + size);
        return mean(of, x, y, size) + 15 * (std::cos(top) - std::cos(bottom)) / (bottom - top);
    };
    std::vector<float> grains(static_cast<size_t>(film.width));
    for (int y = 0; y < film.height; ++y) {
        if (y % film.grain_texels == 0)
            for (int x = 0; x < film.width; ++x)
                grains[static_cast<size_t>(x)] =
                    x % film.grain_texels ? grains[static_cast<size_t>(x - 1)] : gaussian(random);
        for (int x = 0; x < film.width; ++x) {
            float luma = mean(greys, x, y, 1);
            luma += grains[static_cast<size_t>(x)] * (film.noise + film.noiseSlope * luma / 255);
            const float blueLess = meanTint(blues, x, y, 1), redLess = meanTint(reds, x, y, 1);
            const float r = luma + redLess, b = luma + blueLess;
            const float g = (luma - 0.2126f * r - 0.0722f * b) / 0.7152f;
            uint8_t* to = frame.at(x, y);
            const float values[3] = {r, g, b};
            for (int k = 0; k < 3; ++k)
                to[k] = static_cast<uint8_t>(std::clamp(values[k] + 0.5f, 0.0f, 255.0f));
        }
    }
    return frame;
}

inline light::FrameView viewOf(const ImageRgb8& frame) {
    return {frame.pixels.data(), frame.width, frame.height, 3 * frame.width, false};
}

} // namespace shoal::camera
