#include "content/make/depth/SphereSweep.h"

#include "content/make/depth/GreyFilm.h"
#include "engine/math/LatLong.h"

#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace shoal::depth {

namespace {

constexpr int kPadding = 2;
constexpr int kPaddedWidth = kSweepWidth + 2 * kPadding;
constexpr int kNormalised = 9;         // width of the window of mean and deviation, pixels
constexpr float kNoise = 2.0f;         // added to the deviation, grey values: the noise of coded film
constexpr float kMaxDifference = 1.2f; // larger differences count as this: something else is seen there
constexpr int kDistances = 64;
constexpr int kWidth = kSweepWidth / 2, kHeight = kSweepHeight / 2; // size of the map
constexpr int kDetail = 3; // width of the window of a place's own detail, pixels
constexpr float kMinDetail = 0.15f, kEnoughDetail = 0.25f; // SweepImage::detail of no and of full confidence
constexpr int kAggregated = 5;                     // width of the window that costs are averaged in, pixels
constexpr float kCodes = 400;                      // code of a cost of 1
constexpr int kPenaltyOne = 10, kPenaltyMore = 45; // codes, if neighbours are one distance apart, or more

using Costs = std::vector<uint16_t>; // kDistances for each texel of the map

// Distances are denser far away, where a step of inverse distance is a larger share of it.
float inverseAt(float number, float maxInverse) {
    return maxInverse * std::pow(std::max(number, 0.0f) / (kDistances - 1), 1.7f);
}

// Finds the first of the four pixels of a padded image around a direction, which may have any length.
inline void pixelOf(const glm::vec3& dir, float& column, float& row) {
    const glm::vec2 uv = latLongRoughly(dir);
    column = kSweepWidth * uv.x - 0.5f + kPadding;
    row = std::min(std::max(kSweepHeight * uv.y - 0.5f, 0.0f), static_cast<float>(kSweepHeight - 1));
}

struct Directions {
    std::vector<float> x, y, z; // one for each pixel of an image
};

Directions makeDirections() {
    Directions result;
    for (int row = 0; row < kSweepHeight; ++row)
        for (int column = 0; column < kSweepWidth; ++column) {
            const glm::vec3 dir = texelDirection(column, row, kSweepWidth, kSweepHeight);
            result.x.push_back(dir.x), result.y.push_back(dir.y), result.z.push_back(dir.z);
        }
    return result;
}

// Adds the differences between a view and the reference if everything has that inverse distance.
void addDifferences(const SweepImage& reference, const SweepView& view, const Directions& all, float inverse,
                    float weight, cv::Mat& sum) {
    const glm::mat3& r = view.fromReference;
    const glm::vec3 shift = r * view.at * inverse;
    std::array<float, kSweepWidth> columns, rows;
    for (int row = 0; row < kSweepHeight; ++row) {
        const float* x = all.x.data() + static_cast<size_t>(row) * kSweepWidth;
        const float* y = all.y.data() + static_cast<size_t>(row) * kSweepWidth;
        const float* z = all.z.data() + static_cast<size_t>(row) * kSweepWidth;
        for (size_t i = 0; i < kSweepWidth; ++i)
            pixelOf({r[0][0] * x[i] + r[1][0] * y[i] + r[2][0] * z[i] - shift.x,
                     r[0][1] * x[i] + r[1][1] * y[i] + r[2][1] * z[i] - shift.y,
                     r[0][2] * x[i] + r[1][2] * y[i] + r[2][2] * z[i] - shift.z},
                    columns[i], rows[i]);
        const float* own = reference.values.data() + static_cast<size_t>(row) * kPaddedWidth + kPadding;
        float* out = sum.ptr<float>(row);
        for (size_t i = 0; i < kSweepWidth; ++i) {
            const int column = static_cast<int>(columns[i]), line = static_cast<int>(rows[i]);
            const float fx = columns[i] - static_cast<float>(column), fy = rows[i] - static_cast<float>(line);
            const float* p = view.image->values.data() + static_cast<size_t>(line) * kPaddedWidth + column;
            const float upper = p[0] + fx * (p[1] - p[0]);
            const float lower = p[kPaddedWidth] + fx * (p[kPaddedWidth + 1] - p[kPaddedWidth]);
            out[i] += weight * std::min(std::abs(upper + fy * (lower - upper) - own[i]), kMaxDifference);
        }
    }
}

// Adds the costs of semi-global matching along one line of texels to the sums.
void addPath(const Costs& costs, size_t first, ptrdiff_t stride, int length, Costs& sums) {
    std::array<uint16_t, kDistances + 2> before, now;
    before.fill(0x3fff), now.fill(0x3fff);
    int leastBefore = 0;
    for (int i = 0; i < length; ++i) {
        const size_t at = static_cast<size_t>(static_cast<ptrdiff_t>(first) + i * stride) * kDistances;
        int least = 0xffff;
        for (size_t k = 0; k < kDistances; ++k) {
            int add = 0;
            if (i > 0)
                add = std::min(std::min<int>(before[k + 1], leastBefore + kPenaltyMore),
                               std::min(before[k], before[k + 2]) + kPenaltyOne) -
                      leastBefore;
            const int value = costs[at + k] + add;
            now[k + 1] = static_cast<uint16_t>(value);
            sums[at + k] = static_cast<uint16_t>(sums[at + k] + value);
            least = std::min(least, value);
        }
        std::swap(before, now);
        leastBefore = least;
    }
}

void addPaths(const Costs& costs, Costs& sums) {
    for (int y = 0; y < kHeight; ++y) {
        const size_t row = static_cast<size_t>(y) * kWidth;
        addPath(costs, row, 1, kWidth, sums);
        addPath(costs, row + kWidth - 1, -1, kWidth, sums);
    }
    for (size_t x = 0; x < kWidth; ++x) {
        addPath(costs, x, kWidth, kHeight, sums);
        addPath(costs, x + size_t{kWidth} * (kHeight - 1), -kWidth, kHeight, sums);
    }
}

// Returns the place of the minimum of a parabola through three costs, relative to the middle one.
float parabola(float before, float at, float after) {
    const float curvature = before - 2 * at + after;
    return curvature > 0 ? std::clamp(0.5f * (before - after) / curvature, -0.5f, 0.5f) : 0;
}

// Returns about 1 if one distance is much better than all that are not beside it, 0 if another is as good.
float distinctness(const uint16_t* costs, int best) {
    float sum = 0;
    int other = 0xffff;
    for (int k = 0; k < kDistances; ++k) {
        sum += costs[k];
        if (std::abs(k - best) > 4) other = std::min<int>(other, costs[k]);
    }
    const float mean = sum / kDistances;
    return (static_cast<float>(other) - costs[best]) / std::max(mean, 1.0f);
}

// window: width of the square window, pixels.
void deviationOf(const cv::Mat1f& values, int window, cv::Mat1f& mean, cv::Mat1f& deviation) {
    cv::Mat1f square;
    cv::boxFilter(values, mean, CV_32F, {window, window});
    cv::boxFilter(values.mul(values), square, CV_32F, {window, window});
    cv::sqrt(cv::max(square - mean.mul(mean), 0), deviation);
}

// Returns how much detail a texel of the map has of its own, 0 to 1: the maximum of its four pixels.
float ownDetail(const SweepImage& image, size_t texel) {
    const float* at = image.detail.data() + 2 * (texel / kWidth) * kSweepWidth + 2 * (texel % kWidth);
    const float most = std::max({at[0], at[1], at[kSweepWidth], at[kSweepWidth + 1]});
    return std::clamp((most - kMinDetail) / (kEnoughDetail - kMinDetail), 0.0f, 1.0f);
}

} // namespace

struct SphereSweep::Impl {
    Directions directions = makeDirections();
    Costs costs, sums;
};

SphereSweep::SphereSweep() : impl_(makeHidden<Impl>()) {}

void makeSweepImage(const light::FrameView& film, SweepImage& out) {
    constexpr int kAround = kNormalised + kPadding;
    cv::Mat1b padded;
    greyOf(film, kSweepWidth, kAround, padded);
    cv::Mat1f values, mean, deviation, unused, small, normalised, detail;
    padded.convertTo(values, CV_32F);
    deviationOf(values, kNormalised, mean, deviation);
    deviationOf(values, kDetail, unused, small);
    cv::divide(values - mean, deviation + kNoise, normalised);
    cv::divide(small, deviation + kNoise, detail);
    out.values.assign(size_t{kPaddedWidth} * (kSweepHeight + 1), 0);
    cv::Mat1f keptValues(kSweepHeight, kPaddedWidth, out.values.data());
    normalised(cv::Rect(kNormalised, 0, kPaddedWidth, kSweepHeight)).copyTo(keptValues);
    out.detail.resize(size_t{kSweepWidth} * kSweepHeight);
    cv::Mat1f keptDetail(kSweepHeight, kSweepWidth, out.detail.data());
    detail(cv::Rect(kAround, 0, kSweepWidth, kSweepHeight)).copyTo(keptDetail);
}

void SphereSweep::estimate(const SweepImage& reference, std::span<const SweepView> views, float maxInverse,
                           DepthEstimate& out) {
    constexpr size_t kTexels = size_t{kWidth} * kHeight;
    Impl& own = *impl_;
    out.inverse.assign(kTexels, 0), out.confidence.assign(kTexels, 0);
    const auto later =
        std::count_if(views.begin(), views.end(), [](const SweepView& v) { return v.isLater; });
    const auto earlier = static_cast<std::ptrdiff_t>(views.size()) - later;
    if (views.empty()) return;
    own.costs.resize(kTexels * kDistances), own.sums.assign(kTexels * kDistances, 0);
    cv::parallel_for_(cv::Range(0, kDistances), [&](const cv::Range& range) {
        cv::Mat1f averaged;
        cv::Mat sums[2], least, most, cost;
        for (int k = range.start; k < range.end; ++k) {
            for (cv::Mat& sum : sums) sum.create(kSweepHeight, kSweepWidth, CV_32F), sum.setTo(0);
            for (const SweepView& view : views)
                addDifferences(reference, view, own.directions, inverseAt(static_cast<float>(k), maxInverse),
                               1.0f / static_cast<float>(view.isLater ? later : earlier), sums[view.isLater]);
            // A point that is hidden in earlier frames is often seen in later ones, or the other way around.
            if (later > 0 && earlier > 0) {
                cv::min(sums[0], sums[1], least), cv::max(sums[0], sums[1], most);
                cv::addWeighted(least, 0.7, most, 0.3, 0, cost);
            } else
                cost = sums[later > 0];
            cv::boxFilter(cost, averaged, CV_32F, {kAggregated, kAggregated});
            for (int y = 0; y < kHeight; ++y)
                for (int x = 0; x < kWidth; ++x)
                    own.costs[(static_cast<size_t>(y) * kWidth + static_cast<size_t>(x)) * kDistances +
                              static_cast<size_t>(k)] =
                        static_cast<uint16_t>(kCodes * 0.25f *
                                              (averaged(2 * y, 2 * x) + averaged(2 * y, 2 * x + 1) +
                                               averaged(2 * y + 1, 2 * x) + averaged(2 * y + 1, 2 * x + 1)));
        }
    });
    addPaths(own.costs, own.sums);
    for (size_t i = 0; i < kTexels; ++i) {
        const uint16_t* sums = own.sums.data() + i * kDistances;
        const int best = static_cast<int>(std::min_element(sums, sums + kDistances) - sums);
        const float off =
            best > 0 && best + 1 < kDistances ? parabola(sums[best - 1], sums[best], sums[best + 1]) : 0;
        out.inverse[i] = inverseAt(static_cast<float>(best) + off, maxInverse);
        out.confidence[i] =
            std::clamp(3.5f * distinctness(sums, best) - 0.1f, 0.0f, 1.0f) * ownDetail(reference, i);
    }
}

} // namespace shoal::depth
