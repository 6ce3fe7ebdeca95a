#include "engine/light/ClippedLight.h"

#include "engine/math/Colour.h"
#include "engine/math/LatLong.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace shoal::light {

namespace {

// Video is compressed: white is not 255 everywhere. From the first value to the last a pixel counts as
// clipped more and more, so that none flickers between the two.
constexpr float kFirstClipped = 243, kWhollyClipped = 255;
constexpr float kLastBlack = 4, kFirstSeen = 12; // a covered lens, a tripod's patch, bars
constexpr float kFullHeight = 0.3f;              // sine of the elevation from which on all is scaled
constexpr float kGroundNeeded = 0.25f;           // of the half sphere below, weighed by its cosine

float ramp(float value, float from, float to) { return std::clamp((value - from) / (to - from), 0.0f, 1.0f); }

// 0 to 1.
float clippedShare(uint8_t coded) { return ramp(static_cast<float>(coded), kFirstClipped, kWhollyClipped); }

float sineOfElevation(int row, int height) {
    return static_cast<float>(std::sin(std::numbers::pi * (0.5 - (row + 0.5) / height)));
}

float heightShare(float sine) { return ramp(sine, 0, kFullHeight); }

} // namespace

float ClippedLight::mostGain() {
    return std::pow(kUsualGain, 1 - kTrust) * std::pow(1 + kMostFromGround, kTrust);
}

ClippedLight::ClippedLight(const FrameView& frame) : height_(frame.height) {
    const std::array<float, 256>& linear = math::linearOfByte();
    const int redAt = frame.bgr ? 2 : 0, blueAt = 2 - redAt;
    // Irradiance of a level plane from above, as decoded, and by what would be scaled if it were 1; radiance
    // of the ground, of the part that is seen; that part.
    double fromAbove = 0, scaled = 0, ground = 0, groundSeen = 0, below = 0;
    for (int y = std::min(kStep / 2, frame.height / 2); y < frame.height; y += kStep) {
        const float sine = sineOfElevation(y, frame.height);
        const float up = heightShare(sine);
        float rowLight = 0, rowScaled = 0, rowSeen = 0;
        int pixels = 0;
        for (int x = std::min(kStep / 2, frame.width / 2); x < frame.width; x += kStep, ++pixels) {
            const uint8_t* p = frame.pixels + y * frame.rowStride + ptrdiff_t{3} * x;
            const uint8_t red = p[redAt], green = p[1], blue = p[blueAt];
            // Rec. 709
            const float luminance = 0.2126f * linear[red] + 0.7152f * linear[green] + 0.0722f * linear[blue];
            if (sine >= 0) {
                rowLight += luminance;
                rowScaled += clippedShare(std::min({red, green, blue}));
            } else {
                const uint8_t most = std::max({red, green, blue});
                const float seen =
                    (1 - clippedShare(most)) * ramp(static_cast<float>(most), kLastBlack, kFirstSeen);
                rowLight += seen * luminance;
                rowSeen += seen;
            }
        }
        const double area = texelSolidAngle(y, frame.width, frame.height) * kStep * kStep;
        const double cosine = static_cast<double>(std::abs(sine)) * area;
        if (sine >= 0) {
            fromAbove += cosine * static_cast<double>(rowLight);
            scaled += cosine * static_cast<double>(up * rowScaled);
        } else {
            ground += cosine * static_cast<double>(rowLight);
            groundSeen += cosine * static_cast<double>(rowSeen);
            below += cosine * pixels;
        }
    }
    const double radiance = groundSeen > 0 ? ground / groundSeen : 0;
    const double missing = std::numbers::pi * radiance / kGroundAlbedo - fromAbove;
    const double times =
        std::clamp(missing / std::max(scaled, 1e-6), 0.0, static_cast<double>(kMostFromGround));
    const float trust =
        below > 0 ? kTrust * static_cast<float>(std::min(1.0, groundSeen / (kGroundNeeded * below))) : 0.0f;
    gain_ = std::pow(kUsualGain, 1 - trust) * std::pow(1 + static_cast<float>(times), trust);
}

float ClippedLight::rowGain(int row) const {
    return (gain_ - 1) * heightShare(sineOfElevation(row, height_));
}

float ClippedLight::scaleOf(float rowGain, const uint8_t* pixel) {
    return rowGain > 0 ? 1 + rowGain * clippedShare(std::min({pixel[0], pixel[1], pixel[2]})) : 1.0f;
}

} // namespace shoal::light
