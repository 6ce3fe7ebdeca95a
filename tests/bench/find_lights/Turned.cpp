#include "tests/bench/find_lights/Turned.h"

#include "engine/light/FindLights.h"
#include "engine/light/InverseToneMap.h"
#include "engine/light/Pyramid.h"
#include "engine/math/Colour.h"
#include "tests/unit/light/Angles.h"
#include "tests/unit/light/Environments.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace shoal::bench {

namespace {

constexpr int kFrameWidth = 1024;
constexpr double kLost_deg = 25; // farther off it is another light

struct Dice {
    uint32_t state = 1;
    double operator()() { // 0 to 1
        state = state * 1664525u + 1013904223u;
        return static_cast<double>(state >> 8) * 0x1p-24;
    }
};

glm::dmat3 turn(double yaw, double pitch) {
    const double cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
    return glm::dmat3(1, 0, 0, 0, cp, sp, 0, -sp, cp) * glm::dmat3(cy, 0, -sy, 0, 1, 0, sy, 0, cy);
}

float between(const ImageRgbF& image, const glm::dvec2& uv, int c) {
    const double x = uv.x * image.width - 0.5,
                 y = std::clamp(uv.y * image.height - 0.5, 0.0, image.height - 1.001);
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(y);
    const auto a = static_cast<float>(x - left), b = static_cast<float>(y - top);
    const int x0 = (left + image.width) % image.width, x1 = (left + 1) % image.width;
    return std::lerp(std::lerp(image.at(x0, top)[c], image.at(x1, top)[c], a),
                     std::lerp(image.at(x0, top + 1)[c], image.at(x1, top + 1)[c], a), b);
}

ImageRgb8 filmed(const ImageRgbF& radianceLin, const glm::dmat3& frameFromPicture, float exposure) {
    const glm::dmat3 pictureFromFrame = glm::transpose(frameFromPicture);
    ImageRgb8 frame(kFrameWidth, kFrameWidth / 2);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
            const glm::dvec3 direction = texelDirection<double>(x, y, frame.width, frame.height);
            const glm::dvec2 uv = latLongFromDirection(pictureFromFrame * direction);
            for (int c = 0; c < 3; ++c) {
                const float lin = std::clamp(exposure * between(radianceLin, uv, c), 0.0f, 1.0f);
                frame.at(x, y)[c] = static_cast<uint8_t>(255 * math::srgbFromLinear(lin) + 0.5f);
            }
        }
    return frame;
}

double luminance(const glm::dvec3& c) { return glm::dot(c, glm::dvec3(0.3, 0.59, 0.11)); }

// Where a window of this reach comes to rest that follows the light in it.
glm::dvec3 modeFrom(glm::dvec3 direction, double reach, const ImageRgbF& level) {
    const double cosReach = std::cos(reach);
    for (int i = 0; i < 60; ++i) {
        glm::dvec3 sum(0);
        for (int y = 0; y < level.height; ++y)
            for (int x = 0; x < level.width; ++x) {
                const glm::dvec3 d = texelDirection<double>(x, y, level.width, level.height);
                const float* c = level.at(x, y);
                sum += std::max(0.0, glm::dot(d, direction) - cosReach) * luminance({c[0], c[1], c[2]}) *
                       texelSolidAngle(y, level.width, level.height) * d;
            }
        if (glm::length(sum) <= 0) break;
        direction = glm::normalize(sum);
    }
    return direction;
}

double quantile(std::vector<double> values, double part) {
    std::ranges::sort(values);
    return values[std::min(values.size() - 1,
                           static_cast<size_t>(part * static_cast<double>(values.size())))];
}

} // namespace

void turnedTable(const std::vector<EnvironmentSource>& pictures, int count) {
    std::printf(
        "\n| turned and exposed at random, %d times each | truth moves, degrees | off: median, degrees "
        "| 90th percentile | most | above 2, %% | lost, %% | radius found (true) | share found (true) "
        "|\n|---|--:|--:|--:|--:|--:|--:|--:|--:|\n",
        count);
    light::PyramidMaker pyramid;
    light::RadiancePyramid radiance;
    light::LightFinder finder;
    light::FoundLights truth, found;
    for (const EnvironmentSource& source : pictures) {
        const auto picture = source.load();
        if (!picture) continue;
        pyramid.make(picture->radianceLin, 512, radiance);
        finder.find(radiance, truth);
        if (truth.count == 0) continue;
        const light::FoundLight& light = truth.lights[0];
        const glm::dvec3 towards(light.direction);
        const double reach = 1.5 * static_cast<double>(light.radius) + 0.14;
        const ImageRgbF& level = radiance.levels[2];
        const double moves = light::degreesBetween(modeFrom(towards, reach / 2, level),
                                                   modeFrom(towards, std::min(2 * reach, 1.5), level));

        const double mean = luminance(light::meanOf(picture->radianceLin));
        Dice dice;
        std::vector<double> off, radii, shares;
        for (int i = 0; i < count; ++i) {
            const glm::dmat3 frameFromPicture =
                turn(2 * std::numbers::pi * dice(), std::asin(2 * dice() - 1) / 2);
            const double key = 0.05 * std::exp2(3 * dice()); // the mean by white: 5 to 40 %
            const ImageRgb8 frame =
                filmed(picture->radianceLin, frameFromPicture, static_cast<float>(key / mean));
            pyramid.make({frame.pixels.data(), frame.width, frame.height, ptrdiff_t{3} * frame.width, false},
                         512, radiance);
            finder.find(radiance, found);
            double nearest = kLost_deg;
            size_t which = 0;
            for (size_t k = 0; k < found.count; ++k)
                if (const double away =
                        light::degreesBetween(found.lights[k].direction, frameFromPicture * towards);
                    away < nearest) {
                    nearest = away;
                    which = k;
                }
            if (nearest >= kLost_deg) continue;
            off.push_back(nearest);
            radii.push_back(glm::degrees(static_cast<double>(found.lights[which].radius)));
            shares.push_back(100 * static_cast<double>(found.lights[which].share));
        }
        if (off.empty()) continue;
        const auto above = std::ranges::count_if(off, [](double away) { return away > 2; });
        std::printf("| %s | %.1f | %.1f | %.1f | %.1f | %.0f | %.0f | %.1f (%.1f) | %.0f (%.0f) |\n",
                    picture->name.c_str(), moves, quantile(off, 0.5), quantile(off, 0.9), quantile(off, 1),
                    100 * static_cast<double>(above) / static_cast<double>(off.size()),
                    100 - 100 * static_cast<double>(off.size()) / count, quantile(radii, 0.5),
                    glm::degrees(static_cast<double>(light.radius)), quantile(shares, 0.5),
                    100 * static_cast<double>(light.share));
    }
}

} // namespace shoal::bench
