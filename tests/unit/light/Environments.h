// Environments for tests: painted by a function of direction.
#pragma once

#include "engine/core/Image.h"
#include "engine/math/LatLong.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace shoal::light {

inline ImageRgbF paint(int width, int height, const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    ImageRgbF image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 value = radiance(texelDirection<double>(x, y, width, height));
            for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<float>(value[c]);
        }
    return image;
}

inline ImageRgbF uniform(int width, const glm::dvec3& radiance) {
    return paint(width, width / 2, [&](const glm::dvec3&) { return radiance; });
}

// Returns bright noise that differs in every texel, so that a wrong index shows.
inline ImageRgbF noise(int width, int height, uint32_t seed = 1) {
    ImageRgbF image(width, height);
    for (float& value : image.pixels) {
        seed = seed * 1664525u + 1013904223u;
        value = static_cast<float>(seed >> 8) * 0x1p-24f;
    }
    return image;
}

// Returns the mean over the sphere.
inline glm::dvec3 meanOf(const ImageRgbF& image) {
    glm::dvec3 sum(0);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                sum[c] += texelSolidAngle(y, image.width, image.height) * image.at(x, y)[c];
    return sum / (4 * std::numbers::pi);
}

inline double largestDifference(const ImageRgbF& image, const glm::dvec3& value) {
    double worst = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i)
        worst = std::max(worst, std::abs(image.pixels[i] - value[static_cast<int>(i % 3)]));
    return worst;
}

// Returns the angle between unit vectors; exact where they are close, too.
inline double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(2 * std::asin(std::min(1.0, 0.5 * glm::length(a - b))));
}

} // namespace shoal::light
