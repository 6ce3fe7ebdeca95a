#include "tests/baselines/light/Taps.h"

#include "engine/core/Vectorise.h"
#include "engine/light/Lookup.h"
#include "engine/math/Brdf.h"
#include "engine/math/LatLong.h"
#include "tests/baselines/light/Ggx.h"

namespace shoal::light::baselines {

using std::numbers::pi;

namespace {

// Van der Corput's sequence in base 2: with i / n it makes Hammersley's points.
double bitsReversed(unsigned i) {
    double result = 0;
    for (double half = 0.5; i; i >>= 1, half *= 0.5)
        if (i & 1) result += half;
    return result;
}

} // namespace

std::vector<Tap> ggxTaps(float roughness, int samples, int baseWidth) {
    const double alpha = math::alphaFromRoughness(roughness), alpha2 = alpha * alpha;
    const double texel = 4 * pi / (static_cast<double>(baseWidth) * (baseWidth / 2)); // mean, steradians
    std::vector<Tap> taps;
    double sum = 0;
    for (int i = 0; i < samples; ++i) {
        const double share = (i + 0.5) / samples, turn = 2 * pi * bitsReversed(static_cast<unsigned>(i));
        const double nh = std::sqrt((1 - share) / (1 + (alpha2 - 1) * share));
        const double cosine = 2 * nh * nh - 1; // l = 2 (v.h) h - v, v = n
        if (cosine <= 0) continue;
        const double sine = std::sqrt(1 - cosine * cosine);
        const double density = math::ggxD(nh, alpha) / 4;
        const double lod = 0.5 * std::log2(1 / (samples * density * texel));
        taps.push_back({{static_cast<float>(sine * std::cos(turn)), static_cast<float>(sine * std::sin(turn)),
                         static_cast<float>(cosine)},
                        static_cast<float>(std::max(0.0, lod)),
                        static_cast<float>(cosine)});
        sum += cosine;
    }
    for (Tap& tap : taps) tap.weight /= static_cast<float>(sum);
    return taps;
}

glm::vec3 gather(const RadiancePyramid& pyramid, const std::vector<Tap>& taps, const glm::vec3& axis) {
    const glm::vec3 helper = std::abs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 side = glm::normalize(glm::cross(axis, helper));
    const glm::vec3 up = glm::cross(side, axis);
    glm::vec3 sum(0);
    for (const Tap& tap : taps)
        sum +=
            tap.weight * lookUp(pyramid, side * tap.local.x + up * tap.local.y + axis * tap.local.z, tap.lod);
    return sum;
}

TapFilter::TapFilter(const std::vector<Tap>& taps, int width, int baseWidth)
    : width_(width), placesPerRow_(2 * taps.size()) {
    const auto top = static_cast<float>(std::log2(static_cast<float>(baseWidth)) - 1);
    for (int row = 0; row < width / 2; ++row) {
        const glm::dvec3 axis =
            directionFromLatLong(glm::dvec2(0.5 + 0.5 / width, (row + 0.5) / (width / 2)));
        const glm::dvec3 east = glm::normalize(glm::cross(axis, glm::dvec3(0, 1, 0)));
        const glm::dvec3 north = glm::cross(east, axis);
        for (const Tap& tap : taps) {
            const glm::dvec3 local(tap.local);
            const glm::dvec2 uv = latLongFromDirection(east * local.x + north * local.y + axis * local.z);
            const float lod = std::clamp(tap.lod, 0.0f, top);
            const auto low = static_cast<int>(lod);
            const float part = lod - static_cast<float>(low);
            for (int k = 0; k < 2; ++k) {
                const float weight = tap.weight * (k ? part : 1 - part);
                if (weight == 0) {
                    places_.push_back({});
                    continue;
                }
                const int wide = baseWidth >> (low + k), high = wide / 2;
                const double y = uv.y * high - 0.5, floor = std::floor(y);
                const auto below = static_cast<float>(y - floor);
                // The texel that the row's taps were worked out for is column width / 2.
                double column = uv.x * wide - 0.5 - 0.5 * wide;
                column -= std::floor(column / wide) * wide;
                places_.push_back({low + k, std::max(0, static_cast<int>(floor)),
                                   std::min(high - 1, static_cast<int>(floor) + 1), weight * (1 - below),
                                   weight * below, static_cast<float>(column)});
            }
        }
    }
}

namespace {

// out = a x + b y; one texel more than there are, so that the last has a right neighbour.
SHOAL_VECTORISE
void blendRows(const float* __restrict x, float a, const float* __restrict y, float b, int width,
               float* __restrict out) {
    for (int i = 0; i < 3 * width; ++i) out[i] = a * x[i] + b * y[i];
    for (int c = 0; c < 3; ++c) out[3 * width + c] = out[c];
}

// sum += in, moved by `left` texels and a part of one. As wide as each other.
SHOAL_VECTORISE
void addMoved(const float* __restrict in, int left, float part, int width, float* __restrict sum) {
    const int before = 3 * (width - left), all = 3 * width, by = 3 * left;
    for (int i = 0; i < before; ++i) sum[i] += (1 - part) * in[i + by] + part * in[i + by + 3];
    for (int i = before; i < all; ++i) sum[i] += (1 - part) * in[i - before] + part * in[i - before + 3];
}

// sum += in, read at column, column + step ... in is a power of two wide.
void addSampled(const float* in, float column, float step, int inWidth, int width, float* sum) {
    for (int x = 0; x < width; ++x, sum += 3) {
        const float at = column + step * static_cast<float>(x);
        const auto left = static_cast<int>(at);
        const float part = at - static_cast<float>(left);
        const float* texel = in + 3 * (left & (inWidth - 1));
        for (int c = 0; c < 3; ++c) sum[c] += texel[c] * (1 - part) + texel[c + 3] * part;
    }
}

} // namespace

void TapFilter::apply(const RadiancePyramid& pyramid, ImageRgbF& out) {
    out.fit(width_, width_ / 2);
    std::fill(out.pixels.begin(), out.pixels.end(), 0.0f);
    blended_.resize(static_cast<size_t>(pyramid.levels[0].width + 1) * 3);
    for (int row = 0; row < out.height; ++row)
        for (size_t i = 0; i < placesPerRow_; ++i) {
            const Place& place = places_[static_cast<size_t>(row) * placesPerRow_ + i];
            if (place.topWeight + place.bottomWeight == 0) continue;
            const ImageRgbF& level = pyramid.levels[place.level];
            blendRows(level.at(0, place.top), place.topWeight, level.at(0, place.bottom), place.bottomWeight,
                      level.width, blended_.data());
            const auto left = static_cast<int>(place.column);
            if (level.width == width_)
                addMoved(blended_.data(), left & (width_ - 1), place.column - static_cast<float>(left),
                         width_, out.at(0, row));
            else
                addSampled(blended_.data(), place.column,
                           static_cast<float>(level.width) / static_cast<float>(width_), level.width, width_,
                           out.at(0, row));
        }
}

} // namespace shoal::light::baselines
