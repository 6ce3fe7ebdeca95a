#include "content/make/depth/PairDepth.h"

#include "engine/math/Quantile.h"

#include <algorithm>
#include <cmath>

namespace shoal::depth {

namespace {

void triangulateAll(const RelativePose& pose, const std::vector<FlowPoint>& flow, DepthEstimate& out) {
    out.inverse.assign(kEstimateTexels, 0);
    out.confidence.assign(kEstimateTexels, 0);
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        if (flow[i].error_rad >= 1 || !isUsable(pose)) continue;
        const Triangulated t =
            triangulate(pose, {glm::dvec3(estimateDirection(i)), glm::dvec3(flow[i].second)});
        if (t.parallax_rad <= 0) continue;
        out.inverse[i] = static_cast<float>(std::clamp(t.inverse, 0.0, 3.9));
        const double error_rad = 4e-4 + std::abs(t.offPlane_rad) + static_cast<double>(flow[i].error_rad);
        const double atEnds =
            std::clamp((t.sinToMovement - 0.12) / 0.15, 0.0, 1.0); // points along the movement do not shift
        out.confidence[i] =
            static_cast<float>(atEnds * std::clamp(1.2 - 3 * error_rad / t.parallax_rad, 0.0, 1.0));
    }
}

double heightBelow(const DepthEstimate& depth) {
    std::vector<double> heights;
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        const glm::vec3 dir = estimateDirection(i);
        if (dir.y < -0.5f && depth.confidence[i] > 0.5f && depth.inverse[i] > 1e-4f)
            heights.push_back(static_cast<double>(-dir.y / depth.inverse[i]));
    }
    return heights.size() < 100 ? 0 : math::median(heights);
}

} // namespace

PairDepth estimatePair(CubeFlow& flow, const CubeFaces& first, const CubeFaces& second) {
    constexpr size_t kEvery = 23; // at the equator, one texel of this many is used to find the pose
    PairDepth result;
    std::vector<FlowPoint> there, back;
    flow.match(first, second, kEstimateWidth, there, back);
    std::vector<Correspondence> points;
    size_t next = 0;
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        // Points are spread evenly over the sphere.
        const double ring =
            std::cos((0.5 - (static_cast<double>(i / kEstimateWidth) + 0.5) / kEstimateHeight) * 3.14159265);
        const auto stride = static_cast<size_t>(static_cast<double>(kEvery) / std::max(ring, 0.05));
        if (i < next || there[i].error_rad > 0.004f) continue;
        next = i + stride;
        points.push_back(
            {glm::normalize(glm::dvec3(estimateDirection(i))), glm::normalize(glm::dvec3(there[i].second))});
    }
    result.pose = relativePose(points);
    triangulateAll(result.pose, there, result.first);
    triangulateAll(inverted(result.pose), back, result.second);
    return result;
}

FrameRecord joined(const PairDepth* begins, const PairDepth* ends) {
    FrameRecord record;
    const bool hasFirst = begins && isUsable(begins->pose), hasLast = ends && isUsable(ends->pose);
    DepthEstimate depth{std::vector<float>(kEstimateTexels), std::vector<float>(kEstimateTexels)};
    double ratio = 1;
    if (hasFirst && hasLast) {
        std::vector<double> ratios;
        for (size_t i = 0; i < kEstimateTexels; ++i)
            if (std::min(begins->first.confidence[i], ends->second.confidence[i]) > 0.6f &&
                ends->second.inverse[i] > 0)
                ratios.push_back(
                    std::log(static_cast<double>(begins->first.inverse[i] / ends->second.inverse[i])));
        if (ratios.size() > 200) {
            record.motion.ratioWeight = 1;
            record.motion.logRatio = math::median(ratios);
        }
        ratio = std::exp(record.motion.logRatio);
    }
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        const float a = hasFirst ? begins->first.confidence[i] : 0,
                    b = hasLast ? ends->second.confidence[i] : 0;
        if (a + b <= 0) continue;
        const float u = hasFirst ? begins->first.inverse[i] : 0;
        const float v = hasLast ? ends->second.inverse[i] * static_cast<float>(ratio) : 0;
        depth.inverse[i] = (a * u + b * v) / (a + b);
        if (hasFirst && hasLast) { // where both know a distance, the two have to agree
            const float off = std::abs(u - v) / std::max(depth.inverse[i], 1e-4f);
            const float agree = std::clamp(1.5f - 5 * off, 0.0f, 1.0f);
            depth.confidence[i] = a > 0.2f && b > 0.2f ? std::max(a, b) * agree : 0.7f * std::max(a, b);
        } else
            depth.confidence[i] = 0.8f * std::max(a, b);
    }
    if (hasFirst) {
        record.motion.parallax_rad = begins->pose.parallax_rad;
        record.motion.towards = begins->pose.towards;
        record.motion.secondFromFirst = begins->pose.secondFromFirst;
    }
    if (hasFirst || hasLast) {
        record.motion.height = heightBelow(depth);
        // Distances are in baselines of the pair that ends here, so this frame takes that baseline: ratio 1.
        if (!hasFirst) record.motion.ratioWeight = 100;
    }
    record.set(depth);
    return record;
}

} // namespace shoal::depth
