// A room of known size that can be drawn from any place in it: a box with noise on its walls.
#pragma once

#include "engine/core/Image.h"
#include "engine/math/LatLong.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace shoal::depth {

struct TestRoom {
    glm::vec3 half{2, 1.5f, 2.5f}; // metres, from its middle to its walls

    float distance(const glm::vec3& from, const glm::vec3& dir) const {
        float least = 1e9f;
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(dir[axis]) > 1e-6f)
                least = std::min(least, (std::copysign(half[axis], dir[axis]) - from[axis]) / dir[axis]);
        return least;
    }

    // Returns a grey value, 0 to 255, smooth over 0.1 m and more.
    static float greyAt(const glm::vec3& at) {
        float sum = 0;
        for (const float period : {0.12f, 0.31f, 0.7f}) {
            const glm::vec3 cell = glm::floor(at / period), f = at / period - cell;
            const glm::vec3 s = f * f * (3.0f - 2.0f * f);
            for (int k = 0; k < 8; ++k) {
                const glm::vec3 corner(k & 1, k >> 1 & 1, k >> 2);
                const glm::vec3 w = glm::mix(1.0f - s, s, corner), c = cell + corner;
                const float value = std::sin(c.x * 127.1f + c.y * 311.7f + c.z * 74.7f) * 43758.547f;
                sum += w.x * w.y * w.z * (value - std::floor(value) - 0.5f);
            }
        }
        return std::clamp(128 + 110 * sum, 0.0f, 255.0f);
    }

    // Returns the lat-long picture seen from there. between_m: distance between two eyes of omnidirectional
    // stereo; below 0 the left eye's picture, above 0 the right eye's.
    ImageRgb8 seen(const glm::vec3& from, int width, float between_m = 0) const {
        ImageRgb8 picture(width, width / 2);
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < width; ++x) {
                const glm::vec3 dir = texelDirection(x, y, width, picture.height);
                const glm::vec3 right = glm::normalize(glm::vec3(-dir.z, 0, dir.x));
                const glm::vec3 eye = from + right * (between_m / 2);
                const auto grey = static_cast<uint8_t>(greyAt(eye + dir * distance(eye, dir)));
                std::fill_n(picture.at(x, y), 3, grey);
            }
        return picture;
    }
};

} // namespace shoal::depth
