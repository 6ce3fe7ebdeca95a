#include "content/make/depth/TrackFilter.h"

#include "content/make/depth/DepthTrackWriter.h"
#include "engine/math/LatLong.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::depth {

namespace {

constexpr float kUnknown = 0.2f; // texels of less confidence are ignored
// A texel's confidence is at most this much above the least confidence beside it.
constexpr float kMoreThanBeside = 0.5f;

size_t texelOf(const glm::vec3& dir) {
    const glm::vec2 uv = latLongFromDirection(dir);
    const int x = static_cast<int>(uv.x * kEstimateWidth) % kEstimateWidth;
    const int y = std::min(static_cast<int>(uv.y * kEstimateHeight), kEstimateHeight - 1);
    return static_cast<size_t>(y) * kEstimateWidth + static_cast<size_t>(x);
}

} // namespace

void requireAgreement(DepthEstimate& depth, std::span<const OtherFrame> others) {
    if (others.empty()) return;
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        const float inverse = depth.inverse[i];
        if (depth.confidence[i] <= 0.05f || inverse <= 0) continue;
        float agree = 0, contradict = 0, sum = depth.confidence[i] * inverse, weights = depth.confidence[i];
        const glm::vec3 dir = estimateDirection(i);
        for (const OtherFrame& other : others) {
            // The direction from the other camera, scaled by the inverse distance.
            const glm::vec3 there =
                glm::mat3(other.pose.fromReference) * (dir - inverse * glm::vec3(other.pose.at));
            const float length = glm::length(there);
            const size_t texel = texelOf(there / length);
            const float sure = other.depth.confidence[texel];
            if (sure < kUnknown) continue;
            const float ratio = other.depth.inverse[texel] / (inverse / length);
            const float near = std::clamp(2 - 12 * std::abs(ratio - 1), 0.0f, 1.0f); // 1 to 8 %, 0 from 17 %
            agree += sure * near;
            // Something nearer may hide the point from the other camera, so its contradiction counts half.
            contradict += sure * (1 - near) * (ratio > 1 ? 0.5f : 1.0f);
            sum += sure * near * ratio * inverse, weights += sure * near;
        }
        depth.inverse[i] = sum / weights;
        const float share = agree / (agree + contradict + 0.3f);
        depth.confidence[i] = std::clamp(
            (depth.confidence[i] + 0.25f * agree) * std::clamp(2 * share - 0.4f, 0.0f, 1.0f), 0.0f, 1.0f);
    }
}

void doubtOutlines(DepthEstimate& depth) {
    const std::vector<float> before = depth.confidence;
    for (int y = 0; y < kEstimateHeight; ++y)
        for (int x = 0; x < kEstimateWidth; ++x) {
            float least = 1;
            for (int row = std::max(y - 1, 0); row <= std::min(y + 1, kEstimateHeight - 1); ++row)
                for (const int column : {x + kEstimateWidth - 1, x, x + 1})
                    least = std::min(
                        least, before[static_cast<size_t>(row * kEstimateWidth + column % kEstimateWidth)]);
            float& own = depth.confidence[static_cast<size_t>(y * kEstimateWidth + x)];
            own = std::min(own, least + kMoreThanBeside);
        }
}

void medianOverTime(const DepthEstimate& before, const DepthEstimate& now, const DepthEstimate& after,
                    media::DepthFrame& out) {
    out.width = kEstimateWidth, out.height = kEstimateHeight;
    out.inverse.assign(kEstimateTexels, 0);
    out.confidence.assign(kEstimateTexels / 4, 0);
    std::vector<float> confidence(kEstimateTexels);
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        const float a = before.inverse[i], b = now.inverse[i], c = after.inverse[i];
        float value = b, sure = now.confidence[i];
        if (std::min(before.confidence[i], after.confidence[i]) > 0.4f) {
            value = std::max(std::min(a, b), std::min(std::max(a, b), c));
            const float off = std::abs(b - value) / std::max(value, 1e-3f);
            sure *= std::clamp(1.3f - 4 * off, 0.0f, 1.0f);
        }
        out.inverse[i] = media::depthCode(value);
        confidence[i] = sure;
    }
    for (int y = 0; y < kEstimateHeight / 2; ++y)
        for (int x = 0; x < kEstimateWidth / 2; ++x) {
            float mean = 0;
            for (int k = 0; k < 4; ++k)
                mean += 0.25f * confidence[static_cast<size_t>(2 * y + k / 2) * kEstimateWidth +
                                           static_cast<size_t>(2 * x + k % 2)];
            out.confidence[static_cast<size_t>(y) * kEstimateWidth / 2 + static_cast<size_t>(x)] =
                static_cast<uint16_t>(mean * media::kMaxDepthCode);
        }
}

double believedShare(const media::DepthFrame& frame) {
    constexpr int kRows = kEstimateHeight / 2, kColumns = kEstimateWidth / 2;
    constexpr int kBelieved = media::kMaxDepthCode * 6 / 10;
    double believed = 0, all = 0;
    for (int y = 0; y < kRows; ++y) {
        const double weight = std::sin((y + 0.5) / kRows * std::numbers::pi);
        const auto row = frame.confidence.begin() + static_cast<ptrdiff_t>(y) * kColumns;
        all += weight * kColumns;
        believed += weight * static_cast<double>(std::count_if(
                                 row, row + kColumns, [](uint16_t sure) { return sure > kBelieved; }));
    }
    return believed / all;
}

} // namespace shoal::depth
