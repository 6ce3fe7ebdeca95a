#include "engine/light/ClippedLight.h"

#include "engine/light/Vectorise.h"
#include "engine/math/Colour.h"
#include "engine/math/LatLong.h"

#include <array>
#include <cmath>
#include <numbers>

namespace shoal::light {

namespace {

constexpr float kFullHeight = 0.3f;    // sine of the elevation from which on all is scaled
constexpr float kGroundNeeded = 0.25f; // of the half sphere below, weighed by its cosine

// Of the largest channel, coded: a covered lens, a tripod's patch, bars.
constexpr int kLastBlack = 4, kFirstSeen = 12;

// What the ground is trusted with light from the side and from straight above; up to which sine of its
// elevation light is from the side.
constexpr float kLeastTrust = 0.2f, kMostTrust = 1, kFromTheSide = 0.7f;

double edgeSine(int row, int height) {
    return std::sin(std::numbers::pi * (0.5 - static_cast<double>(row) / height));
}

// Between two edges' sines, of a texel of `width`: the integral of the sine over the solid angle.
double irradianceBetween(double top, double bottom, int width) {
    return std::numbers::pi / width * std::abs(top * top - bottom * bottom);
}

inline float luminance(float red, float green, float blue) {
    return 0.2126f * red + 0.7152f * green + 0.0722f * blue; // Rec. 709
}

SHOAL_VECTORISE float luminanceOf(const float* row, int width) {
    const auto [red, green, blue] = sumsOf<3>(row, 3 * static_cast<size_t>(width));
    return luminance(red, green, blue);
}

// Of which the whole is width.
struct Ground {
    float light = 0, seen = 0;
};

// Linear values between which a texel comes to be seen, and to be clipped.
struct Seen {
    float first, perRise, last, perFall;
};

// 0 to 1; without a branch that would keep a loop from being vectorised.
inline float ramp(float value) { return 0.5f * (std::abs(value) - std::abs(value - 1) + 1); }

SHOAL_VECTORISE Ground groundOf(const float* row, int width, const Seen& by) {
    constexpr int kTexels = 512; // at a time
    std::array<float, kTexels> light, seen;
    Ground ground;
    for (int first = 0; first < width; first += kTexels, row += 3 * kTexels) {
        const int count = std::min(kTexels, width - first);
        for (int x = 0; x < count; ++x) {
            const float red = row[3 * x], green = row[3 * x + 1], blue = row[3 * x + 2];
            const float most = std::max(std::max(red, green), blue);
            const float part = ramp(std::min((most - by.first) * by.perRise, (by.last - most) * by.perFall));
            seen[static_cast<size_t>(x)] = part;
            light[static_cast<size_t>(x)] = part * luminance(red, green, blue);
        }
        ground.light += sumsOf<1>(light.data(), static_cast<size_t>(count))[0];
        ground.seen += sumsOf<1>(seen.data(), static_cast<size_t>(count))[0];
    }
    return ground;
}

} // namespace

float clippedShare(int row, int height) {
    const double sine = std::sin(std::numbers::pi * (0.5 - (row + 0.5) / height));
    return std::clamp(static_cast<float>(sine) / kFullHeight, 0.0f, 1.0f);
}

double levelIrradiance(int row, int width, int height) {
    return irradianceBetween(edgeSine(row, height), edgeSine(row + 1, height), width);
}

float groundTrust(float sine) {
    const float high = std::clamp((sine - kFromTheSide) / (1 - kFromTheSide), 0.0f, 1.0f);
    return kLeastTrust + (kMostTrust - kLeastTrust) * high;
}

void ClippedAbove::addRow(int row, int width, int height, double sum) {
    const double light = levelIrradiance(row, width, height) * sum;
    irradiance += light;
    bySine += light * std::sin(std::numbers::pi * (0.5 - (row + 0.5) / height));
}

float clippedGainOf(const ImageRgbF& decoded, const ClippedAbove& clipped) {
    const std::array<float, 256>& linear = math::linearOfByte();
    constexpr float kWhite = 0.999f; // means are off by a few 1e-4
    const Seen by = {linear[kLastBlack], 1 / (linear[kFirstSeen] - linear[kLastBlack]), kWhite,
                     1 / (kWhite - linear[kLastUnclipped])};
    // Irradiance of a level plane from above; radiance of the ground, of the part that is seen; that part.
    double fromAbove = 0, ground = 0, groundSeen = 0;
    double top = 1;
    for (int y = 0; y < decoded.height; ++y) {
        const double bottom = edgeSine(y + 1, decoded.height);
        const double weight = irradianceBetween(top, bottom, decoded.width);
        if (2 * y < decoded.height) {
            fromAbove += weight * static_cast<double>(luminanceOf(decoded.at(0, y), decoded.width));
        } else {
            const Ground row = groundOf(decoded.at(0, y), decoded.width, by);
            ground += weight * static_cast<double>(row.light);
            groundSeen += weight * static_cast<double>(row.seen);
        }
        top = bottom;
    }
    const double below = std::numbers::pi; // of groundSeen, the whole
    const double radiance = groundSeen > 0 ? ground / groundSeen : 0;
    const double missing = std::numbers::pi * radiance / static_cast<double>(kGroundAlbedo) - fromAbove;
    const double times =
        std::clamp(missing / std::max(clipped.irradiance, 1e-6), 0.0, static_cast<double>(kMostFromGround));
    const float trust =
        groundTrust(static_cast<float>(clipped.bySine / std::max(clipped.irradiance, 1e-12))) *
        static_cast<float>(std::min(1.0, groundSeen / (static_cast<double>(kGroundNeeded) * below)));
    return std::pow(kUsualGain, 1 - trust) * std::pow(1 + static_cast<float>(times), trust);
}

} // namespace shoal::light
