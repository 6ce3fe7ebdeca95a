#include "content/make/depth/PairScale.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::depth {

namespace {

using Values = std::vector<double>;

double dot(const Values& a, const Values& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

// Equation between two values: log[to] - log[from] = difference.
struct Link {
    size_t from, to;
    double difference, weight;
};

// Returns the matrix of the normal equations times x, plus a little of x itself, because the values' sum is
// not determined.
Values normalTimes(const std::vector<Link>& links, const Values& x) {
    Values result(x.size());
    for (size_t i = 0; i < x.size(); ++i) result[i] = 1e-7 * x[i];
    for (const Link& link : links) {
        const double off = link.weight * (x[link.to] - x[link.from]);
        result[link.to] += off, result[link.from] -= off;
    }
    return result;
}

// Solves by conjugate gradients, starting from x.
void solve(const std::vector<Link>& links, Values& x) {
    Values residual = normalTimes(links, x);
    for (double& each : residual) each = -each;
    for (const Link& link : links) {
        residual[link.to] += link.weight * link.difference;
        residual[link.from] -= link.weight * link.difference;
    }
    Values direction = residual;
    double square = dot(residual, residual);
    const double enough = 1e-18 * static_cast<double>(x.size());
    for (size_t round = 0; round < 4 * x.size() && square > enough; ++round) {
        const Values along = normalTimes(links, direction);
        const double far = square / dot(direction, along);
        for (size_t i = 0; i < x.size(); ++i) x[i] += far * direction[i], residual[i] -= far * along[i];
        const double next = dot(residual, residual);
        for (size_t i = 0; i < x.size(); ++i) direction[i] = residual[i] + next / square * direction[i];
        square = next;
    }
}

glm::dvec3 meanDirection(const std::vector<PairMotion>& motions, int t, int reach) {
    glm::dvec3 sum(0);
    for (int k = std::max(t - reach, 0); k <= std::min<int>(t + reach, static_cast<int>(motions.size()) - 1);
         ++k)
        if (const PairMotion& m = motions[static_cast<size_t>(k)]; k != t && m.parallax_rad > 0)
            sum += m.towards;
    return sum;
}

} // namespace

void repairMotion(std::vector<PairMotion>& motions) {
    constexpr int kReach = 4;
    constexpr double kMinCosine = 0.85; // cosine of 32 degrees
    const std::vector<PairMotion> found = motions;
    for (int t = 0; t < static_cast<int>(motions.size()); ++t) {
        const glm::dvec3 mean = meanDirection(found, t, kReach);
        if (const double length = glm::length(mean);
            length > 1.5 && glm::dot(mean, found[static_cast<size_t>(t)].towards) < kMinCosine * length)
            motions[static_cast<size_t>(t)].parallax_rad = 0;
    }
    const std::vector<PairMotion> kept = motions;
    for (int t = 0; t < static_cast<int>(motions.size()); ++t) {
        PairMotion& gap = motions[static_cast<size_t>(t)];
        for (int away = 1; away <= kReach && gap.parallax_rad <= 0; ++away)
            for (const int other : {t - away, t + away})
                if (other >= 0 && other < static_cast<int>(kept.size()) && gap.parallax_rad <= 0 &&
                    kept[static_cast<size_t>(other)].parallax_rad > 0) {
                    gap.parallax_rad = kept[static_cast<size_t>(other)].parallax_rad;
                    gap.towards = kept[static_cast<size_t>(other)].towards;
                    gap.secondFromFirst = kept[static_cast<size_t>(other)].secondFromFirst;
                }
    }
}

std::vector<double> linkBaselines(const std::vector<PairMotion>& motions, int step) {
    constexpr double kSmooth = 4;     // weight of the equality of neighbours against one ratio
    constexpr double kRatioOff = 0.1; // scale of the Cauchy weights
    const size_t count = motions.size(), by = static_cast<size_t>(step);
    Values logs(count, 0);
    for (int round = 0; round < 6; ++round) {
        std::vector<Link> links;
        for (size_t t = 0; t < count; ++t) {
            if (t > 0) links.push_back({t - 1, t, 0, kSmooth});
            if (t < by || motions[t].ratioWeight <= 0) continue;
            const double off = (logs[t] - logs[t - by] - motions[t].logRatio) / kRatioOff;
            links.push_back(
                {t - by, t, motions[t].logRatio, motions[t].ratioWeight / (round == 0 ? 1 : 1 + off * off)});
        }
        solve(links, logs);
    }
    for (double& each : logs) each = std::exp(each);
    return logs;
}

std::optional<FramePose> poseAlongChain(const std::vector<PairMotion>& motions,
                                        const std::vector<double>& baselines, int t, int pairs, int step) {
    FramePose pose;
    const int count = static_cast<int>(motions.size());
    for (int k = 0; k < std::abs(pairs); ++k) {
        const int from = pairs > 0 ? t + k * step : t - (k + 1) * step;
        if (from < 0 || from + step >= count) return std::nullopt;
        const PairMotion& m = motions[static_cast<size_t>(from)];
        if (m.parallax_rad <= 0) return std::nullopt;
        const glm::dvec3 by = baselines[static_cast<size_t>(from)] * m.towards;
        if (pairs > 0) {
            pose.at += glm::transpose(pose.fromReference) * by;
            pose.fromReference = m.secondFromFirst * pose.fromReference;
        } else {
            pose.fromReference = glm::transpose(m.secondFromFirst) * pose.fromReference;
            pose.at -= glm::transpose(pose.fromReference) * by;
        }
    }
    return pose;
}

} // namespace shoal::depth
