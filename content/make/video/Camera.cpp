#include "content/make/video/Camera.h"

#include "content/make/video/Noise.h"
#include "content/make/video/Tone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace shoal::reef {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Returns the image at half the width and height.
ImageRgbF halved(const ImageRgbF& in) {
    ImageRgbF out(in.width / 2, in.height / 2);
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x)
            for (int c = 0; c < 3; ++c)
                out.at(x, y)[c] = 0.25f * (in.at(2 * x, 2 * y)[c] + in.at(2 * x + 1, 2 * y)[c] +
                                           in.at(2 * x, 2 * y + 1)[c] + in.at(2 * x + 1, 2 * y + 1)[c]);
    return out;
}

// Returns running means over 2 r + 1 texels along columns or closed rows; in rows r grows towards the poles.
ImageRgbF blurred(const ImageRgbF& in, float radius, bool alongRows) {
    ImageRgbF out(in.width, in.height);
    const int lines = alongRows ? in.height : in.width, length = alongRows ? in.width : in.height;
    for (int j = 0; j < lines; ++j) {
        const float ring =
            alongRows ? std::sin((static_cast<float>(j) + 0.5f) / static_cast<float>(in.height) * kPi) : 1;
        const int r = std::min(static_cast<int>(radius / ring + 0.5f), length / 2 - 1);
        const auto at = [&](int i) {
            const int k = alongRows ? ((i % length) + length) % length : std::clamp(i, 0, length - 1);
            return alongRows ? in.at(k, j) : in.at(j, k);
        };
        float sum[3] = {};
        for (int i = -r; i <= r; ++i)
            for (int c = 0; c < 3; ++c) sum[c] += at(i)[c];
        for (int i = 0; i < length; ++i) {
            float* to = alongRows ? out.at(i, j) : out.at(j, i);
            for (int c = 0; c < 3; ++c) {
                to[c] = std::max(sum[c], 0.0f) / static_cast<float>(2 * r + 1);
                sum[c] += at(i + r + 1)[c] - at(i - r)[c];
            }
        }
    }
    return out;
}

// Returns the light that the housing's port and the lens scatter: a share of the image, spread over degrees.
ImageRgbF glow(const ImageRgbF& image) {
    ImageRgbF small = image;
    while (small.width > 256) small = halved(small);
    for (float& c : small.pixels) c = std::min(c, 14.0f);
    for (int i = 0; i < 3; ++i) small = blurred(blurred(small, 2.5f, true), 2.5f, false);
    return small;
}

// Table of toned(), with finer steps for dark values, where the eye sees finer ones.
class ToneTable {
  public:
    ToneTable() {
        for (size_t i = 0; i < kSize; ++i) {
            const float root = static_cast<float>(i) / (kSize - 1);
            codes_[i] = 255 * toned(root * root * kWhite);
        }
    }
    float at(float x) const {
        const float p = std::sqrt(std::clamp(x / kWhite, 0.0f, 1.0f)) * (kSize - 1);
        return codes_[static_cast<size_t>(p + 0.5f)];
    }

  private:
    static constexpr size_t kSize = 4096;
    static constexpr float kWhite = 1.3f; // highest value in the table, beyond the clip
    std::array<float, kSize> codes_;
};

} // namespace

float meterReading(const ImageRgbF& image) {
    double sum = 0, weights = 0;
    for (int y = 0; y < image.height; ++y) {
        const float weight =
            std::sin((static_cast<float>(y) + 0.5f) / static_cast<float>(image.height) * kPi);
        for (int x = 0; x < image.width; ++x) {
            const float* c = image.at(x, y);
            sum += static_cast<double>(weight * std::log2(0.3f * c[0] + 0.6f * c[1] + 0.1f * c[2] + 0.01f));
            weights += static_cast<double>(weight);
        }
    }
    return static_cast<float>(sum / weights);
}

Exposure::Exposure(const CameraData& camera, std::vector<float> readings)
    : camera_(camera), readings_(std::move(readings)) {
    const size_t n = readings_.size();
    for (const float r : readings_) mean_ += r / static_cast<float>(n);
    mean_ = camera.mean.value_or(mean_);
    for (int pass = 0; pass < 3; ++pass) { // smooths over a few seconds, as an eye adapts
        const auto was = readings_;
        for (size_t i = 0; i < n; ++i) readings_[i] = (was[(i + n - 1) % n] + was[i] + was[(i + 1) % n]) / 3;
    }
}

float Exposure::at(float turn) const {
    const float p = (turn - std::floor(turn)) * static_cast<float>(readings_.size());
    const size_t i = static_cast<size_t>(p), n = readings_.size();
    const float t = p - static_cast<float>(i), s = t * t * (3 - 2 * t);
    const float reading = readings_[i % n] * (1 - s) + readings_[(i + 1) % n] * s;
    return camera_.exposure * std::exp2((mean_ - reading) * camera_.adaptation);
}

ImageRgb8 develop(const CameraData& camera, const ImageRgbF& image, float exposure, int frame) {
    const int width = image.width, height = image.height;
    const ImageRgbF spread = glow(image);
    const ToneTable tones;
    ImageRgb8 out(width, height);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < height; ++y) {
        const int up = std::max(y - 1, 0), down = std::min(y + 1, height - 1);
        for (int x = 0; x < width; ++x) {
            const int left = x ? x - 1 : width - 1, right = x + 1 < width ? x + 1 : 0;
            const float sx = (static_cast<float>(x) + 0.5f) * static_cast<float>(spread.width) /
                                 static_cast<float>(width) -
                             0.5f;
            const float sy = (static_cast<float>(y) + 0.5f) * static_cast<float>(spread.height) /
                                 static_cast<float>(height) -
                             0.5f;
            const int x0 = static_cast<int>(std::floor(sx)), y0 = static_cast<int>(std::floor(sy));
            const float fx = sx - static_cast<float>(x0), fy = sy - static_cast<float>(y0);
            const auto soft = [&](int i, int j) {
                return spread.at((i + spread.width) % spread.width, std::clamp(j, 0, spread.height - 1));
            };
            const uint32_t grain =
                hash(static_cast<uint32_t>(x), static_cast<uint32_t>(y), static_cast<uint32_t>(frame) + 1);
            for (int c = 0; c < 3; ++c) {
                const float sharp =
                    0.48f * image.at(x, y)[c] + 0.13f * (image.at(left, y)[c] + image.at(right, y)[c] +
                                                         image.at(x, up)[c] + image.at(x, down)[c]);
                const float halo = (soft(x0, y0)[c] * (1 - fx) + soft(x0 + 1, y0)[c] * fx) * (1 - fy) +
                                   (soft(x0, y0 + 1)[c] * (1 - fx) + soft(x0 + 1, y0 + 1)[c] * fx) * fy;
                const float signal =
                    (0.94f * std::min(sharp, 40.0f) + 0.06f * halo) * exposure * camera.white[c];
                // Photon noise grows with the signal's root; the sum of two dice is near enough to normal.
                const uint32_t own = hash(grain, static_cast<uint32_t>(c), 5);
                const float dice = static_cast<float>(own & 0xffff) / 65536.0f +
                                   static_cast<float>(own >> 16) / 65536.0f - 1;
                const float noisy =
                    signal + 2.4f * camera.noise * dice * std::sqrt(std::min(signal, 1.0f) + 0.02f);
                out.at(x, y)[c] =
                    static_cast<uint8_t>(std::clamp(tones.at(noisy) + 0.5f + 0.5f * dice, 0.0f, 255.0f));
            }
        }
    }
    return out;
}

} // namespace shoal::reef
