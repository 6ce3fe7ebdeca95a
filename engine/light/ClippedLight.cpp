#include "engine/light/ClippedLight.h"

#include "engine/core/Vectorise.h"
#include "engine/light/InverseToneMap.h"
#include "engine/math/Colour.h"
#include "engine/math/LatLong.h"

#include <glm/exponential.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace shoal::light {

namespace {

constexpr float kFullHeight = 0.15f; // sine of the elevation from which clippedShare() is 1
// Cosine-weighted share of the lower hemisphere that must show ground for the ground's gain to count in full.
constexpr float kGroundNeeded = 0.25f;

// Coded values of a texel's largest channel: up to kLastBlack it shows a covered lens, a tripod's patch or
// bars; from kFirstSeen on it shows ground.
constexpr int kLastBlack = 4, kFirstSeen = 12;

constexpr float kWhite = 0.999f; // linear; means are off by a few 1e-4

// Exponent of the ground's gain for clipped light at the horizon, if enough ground is seen; it rises to 1 at
// the zenith. ClippedGain::seen multiplies both. The usual gain's exponent is 1 minus the product.
constexpr float kMinTrust = 0.1f;

// Irradiance added to that of clipped pixels, so that the gain does not jump where few of them are left.
constexpr double kFewClipped = 0.015;

constexpr double kMaxOfMean = 1.75; // times the ground's mean luminance; brighter texels are clamped

// Returns each channel's sum over interleaved values. 16 partial sums a channel let compilers vectorise.
template <size_t kChannels> std::array<float, kChannels> sumsOf(const float* values, size_t count) {
    std::array<float, 16 * kChannels> parts{};
    size_t at = 0;
    for (; at + parts.size() <= count; at += parts.size())
        for (size_t i = 0; i < parts.size(); ++i) parts[i] += values[at + i];
    for (size_t i = 0; at + i < count; ++i) parts[i] += values[at + i];
    for (size_t half = 8 * kChannels; half >= kChannels; half /= 2)
        for (size_t i = 0; i < half; ++i) parts[i] += parts[half + i];
    std::array<float, kChannels> sums;
    std::copy_n(parts.begin(), kChannels, sums.begin());
    return sums;
}

SHOAL_VECTORISE float sumOf(const float* values, int count) {
    return sumsOf<1>(values, static_cast<size_t>(count))[0];
}

SHOAL_VECTORISE float luminanceOf(const float* row, int width) {
    const auto [red, green, blue] = sumsOf<3>(row, 3 * static_cast<size_t>(width));
    return linearLuminance({red, green, blue});
}

// Sums over a row's texels: visibility of the ground, 0 to 1 for each texel, and its luminance.
struct Ground {
    float seen = 0, light = 0;
};

// Two ramps of a channel's linear value, 0 to 1: the first rises from 0 at `first` by `perRise` for each
// unit, the second falls to 0 at `white` by `perFall`.
struct Ramps {
    float first, perRise, white, perFall;
};

// Rise: 0 at the coded value lastWithout, 1 at firstWhole. Fall: 1 at kLastUnclipped, 0 at white.
Ramps rampsOf(int lastWithout, int firstWhole) {
    const std::array<float, 256>& linear = math::linearOfByte();
    const float first = linear[lastWithout];
    return {first, 1 / (linear[firstWhole] - first), kWhite, 1 / (kWhite - linear[kLastUnclipped])};
}

// Clamps to 0 .. 1 without a branch, so that loops are vectorised.
inline float ramp(float value) { return 0.5f * (std::abs(value) - std::abs(value - 1) + 1); }

constexpr int kTexels = 512; // texels of one pass

// most: greatest luminance; brighter texels are clamped to it.
SHOAL_VECTORISE Ground groundOf(const float* row, int width, const Ramps& by, float most) {
    std::array<float, kTexels> light, seen;
    Ground ground;
    for (int first = 0; first < width; first += kTexels, row += 3 * kTexels) {
        const int count = std::min(kTexels, width - first);
        for (int x = 0; x < count; ++x) {
            const float red = row[3 * x], green = row[3 * x + 1], blue = row[3 * x + 2];
            const float largest = std::max(std::max(red, green), blue);
            const float part =
                ramp(std::min((largest - by.first) * by.perRise, (by.white - largest) * by.perFall));
            seen[x] = part;
            light[x] = part * std::min(linearLuminance({red, green, blue}), most);
        }
        ground.light += sumsOf<1>(light.data(), static_cast<size_t>(count))[0];
        ground.seen += sumsOf<1>(seen.data(), static_cast<size_t>(count))[0];
    }
    return ground;
}

// Sums over a row's texels.
struct RowColours {
    std::array<float, 3> unclipped; // texels that are not clipped in any channel
    std::array<float, 3> bright;    // bright texels that are not clipped in all channels
};

SHOAL_VECTORISE RowColours coloursOf(const float* row, int width, const Ramps& by) {
    std::array<float, 3 * kTexels> unclipped, bright;
    RowColours colours{};
    for (int first = 0; first < width; first += kTexels, row += 3 * kTexels) {
        const int count = std::min(kTexels, width - first);
        for (int x = 0; x < count; ++x) {
            const float red = row[3 * x], green = row[3 * x + 1], blue = row[3 * x + 2];
            const float most = std::max(std::max(red, green), blue),
                        least = std::min(std::min(red, green), blue);
            const float asUnclipped = ramp((by.white - most) * by.perFall);
            const float asBright =
                std::min(ramp((most - by.first) * by.perRise), ramp((by.white - least) * by.perFall));
            const auto at = static_cast<size_t>(3 * x);
            unclipped[at] = asUnclipped * red, bright[at] = asBright * red;
            unclipped[at + 1] = asUnclipped * green, bright[at + 1] = asBright * green;
            unclipped[at + 2] = asUnclipped * blue, bright[at + 2] = asBright * blue;
        }
        const auto more = sumsOf<3>(unclipped.data(), static_cast<size_t>(3 * count)),
                   moreBright = sumsOf<3>(bright.data(), static_cast<size_t>(3 * count));
        for (size_t c = 0; c < 3; ++c) colours.unclipped[c] += more[c], colours.bright[c] += moreBright[c];
    }
    return colours;
}

// Returns the step between rows that are read: every second of 256 or more gives accurate enough means.
int rowStep(int height) { return height >= 256 ? 2 : 1; }

glm::dvec3 ofLuminanceOne(const glm::dvec3& colour) {
    return colour / (0.2126 * colour.r + 0.7152 * colour.g + 0.0722 * colour.b);
}

constexpr int kDensityColumns = 256; // cells around

// Box-filters a circular row of `count` values: the mean of 2 radius + 1 values, at most `count`, for each.
void blurRow(const float* in, size_t count, size_t radius, float* out) {
    const size_t window = 2 * radius + 1;
    float sum = 0;
    for (size_t i = 0; i < window; ++i) sum += in[(count - radius + i) % count];
    size_t next = (radius + 1) % count, last = count - radius; // indices entering and leaving the window
    for (size_t x = 0; x < count; ++x) {
        out[x] = std::max(0.0f, sum) / static_cast<float>(window);
        sum += in[next] - in[last % count];
        next = next + 1 < count ? next + 1 : 0;
        last = last + 1 < count ? last + 1 : 0;
    }
}

} // namespace

float clippedShare(int row, int height) {
    return std::clamp(static_cast<float>(sineOfRow(row + 0.5, height)) / kFullHeight, 0.0f, 1.0f);
}

double levelIrradiance(int row, int width, int height) {
    const double top = sineOfRow(row, height), bottom = sineOfRow(row + 1, height);
    return std::numbers::pi / width * std::abs(top * top - bottom * bottom);
}

float ClippedGain::at(float sine) const {
    const float trust = seen * (kMinTrust + (1 - kMinTrust) * std::clamp(sine, 0.0f, 1.0f));
    return std::pow(kUsualGain, 1 - trust) * std::pow(byGround, trust);
}

float ClippedGain::of(int row, int height) const {
    return at(static_cast<float>(sineOfRow(row + 0.5, height)));
}

void ClippedDensity::begin(int width, int height) {
    if (width != width_ || height != height_) {
        width_ = width, height_ = height;
        columns_ = static_cast<size_t>(std::min(width, kDensityColumns));
        rows_ = static_cast<size_t>(std::min(height, kDensityColumns / 2));
        starts_.clear();
        for (size_t x = 0; x <= columns_; ++x)
            starts_.push_back(static_cast<int>((x * static_cast<size_t>(width) + columns_ - 1) / columns_));
        sums_.assign(columns_ * rows_, 0), density_.resize(sums_.size()), across_.resize(sums_.size());
        counts_.resize(rows_), anything_.assign(rows_, false);
    }
    for (size_t y = 0; y < rows_; ++y)
        if (anything_[y]) std::fill_n(&sums_[y * columns_], columns_, 0.0f);
    std::ranges::fill(counts_, 0);
    std::ranges::fill(anything_, false);
}

void ClippedDensity::addRow(int y, const float* clipped) {
    const size_t row = cellRow(y);
    ++counts_[row];
    if (sumOf(clipped, width_) == 0) return; // the usual case
    anything_[row] = true;
    float* sums = &sums_[row * columns_];
    for (size_t x = 0; x < columns_; ++x)
        for (int i = starts_[x]; i < starts_[x + 1]; ++i) sums[x] += clipped[i];
}

void ClippedDensity::finish() {
    for (size_t y = 0; y < rows_; ++y) {
        if (!anything_[y]) continue;
        float* sums = &sums_[y * columns_];
        for (size_t x = 0; x < columns_; ++x)
            sums[x] /= static_cast<float>(counts_[y] * (starts_[x + 1] - starts_[x]));
        const double ring =
            std::sin(std::numbers::pi * (static_cast<double>(y) + 0.5) / static_cast<double>(rows_));
        const auto radius = static_cast<size_t>(std::lround(1 / ring));
        blurRow(sums, columns_, std::min(radius, (columns_ - 1) / 2), &across_[y * columns_]);
    }
    for (size_t y = 0; y < rows_; ++y) {
        if (!anything_[y]) continue; // without clipped pixels weigh() ignores the row
        float* density = &density_[y * columns_];
        std::fill_n(density, columns_, 0.0f);
        for (const size_t from : {y ? y - 1 : 0, y, std::min(y + 1, rows_ - 1)})
            for (size_t x = 0; anything_[from] && x < columns_; ++x)
                density[x] += across_[from * columns_ + x] / 3;
    }
}

float ClippedDensity::weigh(int y, float* clipped) const {
    const size_t row = cellRow(y);
    if (!anything_[row]) return 0;
    const float* density = &density_[row * columns_];
    for (size_t x = 0; x < columns_; ++x)
        for (int i = starts_[x]; i < starts_[x + 1]; ++i) clipped[i] *= density[x];
    return sumOf(clipped, width_);
}

ClippedGain clippedGainOf(const ImageRgbF& decoded, double clippedIrradiance) {
    const Ramps by = rampsOf(kLastBlack, kFirstSeen);
    const int above = (decoded.height + 1) / 2;
    const auto weightOf = [&](int y) { return levelIrradiance(y, decoded.width, decoded.height); };
    double fromAbove = 0; // irradiance of a level plane
    for (int y = 0; y < above; ++y)
        fromAbove += weightOf(y) * static_cast<double>(luminanceOf(decoded.at(0, y), decoded.width));
    const int step = rowStep(decoded.height);
    double seen = 0, radiance = 0;
    const auto measure = [&](float most) {
        double light = 0;
        seen = 0;
        for (int y = above; y < decoded.height; y += step) {
            const Ground row = groundOf(decoded.at(0, y), decoded.width, by, most);
            seen += step * weightOf(y) * static_cast<double>(row.seen);
            light += step * weightOf(y) * static_cast<double>(row.light);
        }
        radiance = seen > 0 ? light / seen : 0;
    };
    measure(1);
    measure(static_cast<float>(kMaxOfMean * radiance));
    constexpr double wholeHemisphere = std::numbers::pi; // the maximum of `seen`
    const double missing = std::numbers::pi * radiance / static_cast<double>(kGroundAlbedo) - fromAbove;
    const double times =
        std::clamp(missing / (clippedIrradiance + kFewClipped), 0.0, static_cast<double>(kMaxFromGround));
    return {1 + static_cast<float>(times),
            static_cast<float>(std::min(1.0, seen / (static_cast<double>(kGroundNeeded) * wholeHemisphere)))};
}

glm::vec3 clippedTintOf(const ImageRgbF& decoded) {
    constexpr int kBright = 230; // coded
    const Ramps by = rampsOf(kBright, kLastUnclipped);
    constexpr double kGrey = 1e-4; // steradians of white added, so that a few texels give no tint
    glm::dvec3 whole(kGrey), bright(kGrey);
    const int step = rowStep(decoded.height);
    for (int y = 0; y < decoded.height; y += step) {
        const RowColours row = coloursOf(decoded.at(0, y), decoded.width, by);
        const double weight = step * texelSolidAngle(y, decoded.width, decoded.height);
        const double above = weight * static_cast<double>(clippedShare(y, decoded.height));
        for (int c = 0; c < 3; ++c) {
            whole[c] += weight * static_cast<double>(row.unclipped[c]);
            bright[c] += above * static_cast<double>(row.bright[c]);
        }
    }
    const glm::dvec3 a = glm::log(ofLuminanceOne(whole)), b = glm::log(ofLuminanceOne(bright));
    glm::dvec3 common(0);
    for (int c = 0; c < 3; ++c)
        if (a[c] * b[c] > 0) common[c] = std::abs(a[c]) < std::abs(b[c]) ? a[c] : b[c];
    return glm::vec3(ofLuminanceOne(glm::exp(common)));
}

} // namespace shoal::light
