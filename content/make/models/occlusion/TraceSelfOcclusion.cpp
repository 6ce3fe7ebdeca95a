#include "content/make/models/occlusion/TraceSelfOcclusion.h"

#include "content/make/models/occlusion/Bvh.h"
#include "engine/core/ThreadPool.h"
#include "engine/occlusion/Directions.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

namespace shoal::occlusion {

namespace {

constexpr float kMeanBack = -2 / 3.0f; // minus the mean height of directions in a cosine-weighted hemisphere
constexpr float kGap = 1e-4f;    // distance of a ray's start from its surface, share of the body's extent
constexpr int kSweeps = 4;       // rounds of fitting corners to samples: more would fit the noise of few rays
constexpr int kSmoothings = 2;   // more would smooth away detail
constexpr float kSeen = 0.1f;    // share of the hemisphere that must be free for a sample to count in full
constexpr float kBuried = 0.03f; // its weight where nothing is free: such places are never seen
constexpr size_t kInTriangle = 3; // samples, each nearest to one corner

// Occlusion by a near surface varies over about its distance. Corners that are further apart cannot represent
// it: interpolation would show a gradient that no light makes. So surfaces nearer than a triangle's length,
// minus this share of the body's extent, do not count: smaller triangles are fine detail of the model.
constexpr float kFine = 0.05f;

struct Sample {
    std::array<uint32_t, 3> corners{};
    glm::vec3 shares{0}; // weights of the corners
    float weight = 0;    // area, as far as it is seen
    float nearest = 0;   // distance from a ray's start below which nothing counts
    glm::vec4 hidden{0}; // occlusionMoments()
};

class SelfOcclusionOf {
  public:
    SelfOcclusionOf(const SelfOccludingMesh& body, int rays, float extent)
        : body_(body), gap_(kGap * extent), pattern_(cosineDirections(rays)),
          bvh_(body.positions, body.indices) {
        std::vector<Sample> corners(body.positions.size());
        for (size_t i = 0; i < body.indices.size() / 3 * 3; i += 3) {
            const uint32_t* corner = &body.indices[i];
            const glm::vec3 &a = body.positions[corner[0]], &b = body.positions[corner[1]],
                            &c = body.positions[corner[2]];
            const float area = glm::length(glm::cross(b - a, c - a));
            const float longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
            const float nearest = std::max(0.0f, longest - kFine * extent);
            for (int near = 0; near < static_cast<int>(kInTriangle); ++near) {
                Sample sample{{corner[0], corner[1], corner[2]}, glm::vec3(1 / 6.0f), area, nearest, {}};
                sample.shares[near] = 4 / 6.0f;
                samples_.push_back(sample);
                Sample& there = corners[corner[near]];
                there = {sample.corners,
                         glm::vec3(0),
                         there.weight + area / kInTriangle,
                         std::max(there.nearest, nearest),
                         {}};
                there.shares[near] = 1;
            }
        }
        samples_.insert(samples_.end(), corners.begin(), corners.end());
    }

    size_t samples() const { return samples_.size(); }
    void lookFrom(size_t first, size_t end) {
        for (size_t k = first; k < end; ++k) look(k);
    }

    // Corrects corners by the errors at their samples, repeatedly (Gilbert 1972, "Iterative Methods for the
    // Three-dimensional Reconstruction of an Object from Projections").
    std::vector<glm::vec4> fit() const {
        std::vector<glm::vec4> selfOcclusion(body_.positions.size(), glm::vec4(0)),
            sums(selfOcclusion.size());
        std::vector<float> weights(selfOcclusion.size());
        for (int sweep = 0; sweep < kSweeps; ++sweep) {
            std::ranges::fill(sums, glm::vec4(0));
            std::ranges::fill(weights, 0.0f);
            for (const Sample& sample : samples_) {
                glm::vec4 amiss = sample.hidden;
                for (int i = 0; i < 3; ++i)
                    amiss -= sample.shares[i] * selfOcclusion[sample.corners[static_cast<size_t>(i)]];
                for (int i = 0; i < 3; ++i) {
                    const size_t corner = sample.corners[static_cast<size_t>(i)];
                    sums[corner] += sample.weight * sample.shares[i] * amiss;
                    weights[corner] += sample.weight * sample.shares[i];
                }
            }
            for (size_t v = 0; v < selfOcclusion.size(); ++v)
                if (weights[v] > 0) selfOcclusion[v] += sums[v] / weights[v];
        }
        return selfOcclusion;
    }

    // Averages neighbours that differ by no more than the noise of few rays (Tomasi and Manduchi 1998,
    // "Bilateral Filtering for Gray and Color Images", with the noise for its range).
    void smooth(std::vector<glm::vec4>& selfOcclusion) const {
        std::vector<float> variance(selfOcclusion.size(), 0), samples(selfOcclusion.size(), 0);
        for (const Sample& sample : samples_)
            for (int i = 0; i < 3; ++i) samples[sample.corners[static_cast<size_t>(i)]] += sample.shares[i];
        for (size_t v = 0; v < selfOcclusion.size(); ++v) {
            const float share = glm::clamp(selfOcclusion[v].w, 0.0f, 1.0f);
            variance[v] =
                share * (1 - share) / (std::max(samples[v], 1.0f) * static_cast<float>(pattern_.size()));
        }
        std::vector<glm::vec4> sums(selfOcclusion.size());
        std::vector<float> weights(selfOcclusion.size());
        for (int sweep = 0; sweep < kSmoothings; ++sweep) {
            sums = selfOcclusion;
            std::ranges::fill(weights, 1.0f);
            for (size_t i = 0; i < body_.indices.size() / 3 * 3; ++i) {
                const uint32_t a = body_.indices[i], b = body_.indices[i % 3 == 2 ? i - 2 : i + 1];
                const glm::vec4 apart = selfOcclusion[b] - selfOcclusion[a];
                const float noise = variance[a] + variance[b];
                if (!(noise > 0)) continue;
                const float alike = std::exp(-glm::dot(apart, apart) / (2 * noise));
                sums[a] += alike * selfOcclusion[b], weights[a] += alike;
                sums[b] += alike * selfOcclusion[a], weights[b] += alike;
            }
            for (size_t v = 0; v < selfOcclusion.size(); ++v) selfOcclusion[v] = sums[v] / weights[v];
        }
    }

  private:
    void look(size_t k) {
        Sample& sample = samples_[k];
        const glm::vec3& shares = sample.shares;
        const auto placeOf = [&](int i) { return body_.positions[sample.corners[static_cast<size_t>(i)]]; };
        const auto normalOf = [&](int i) { return body_.normals[sample.corners[static_cast<size_t>(i)]]; };
        glm::vec3 flat(0), normal(0);
        for (int i = 0; i < 3; ++i) flat += shares[i] * placeOf(i), normal += shares[i] * normalOf(i);
        if (!(sample.weight > 0) || !(glm::dot(normal, normal) > 0)) {
            sample.weight = 0;
            return;
        }
        normal = glm::normalize(normal);
        // The ray starts where the smooth surface would be: Hanika 2021, "Hacking the Shadow Terminator".
        glm::vec3 origin = flat + gap_ * normal;
        for (int i = 0; i < 3; ++i)
            origin -= shares[i] * std::min(0.0f, glm::dot(flat - placeOf(i), normalOf(i))) * normalOf(i);
        // Each sample turns the pattern differently, so that few rays err differently in neighbours.
        const glm::mat3 frame = glm::transpose(lookingAlong(
            normal, static_cast<float>(std::fmod(static_cast<double>(k) * kGoldenAngle, 6.283))));
        glm::vec4 sum(0);
        for (const glm::vec3& each : pattern_) {
            const glm::vec3 direction = frame * each;
            if (bvh_.blocked(origin, direction, sample.nearest, INFINITY)) sum += glm::vec4(direction, 1);
        }
        const glm::vec4 hidden = sum / static_cast<float>(pattern_.size());
        sample.weight *= std::clamp((1 - hidden.w) / kSeen, kBuried, 1.0f);
        sample.hidden = hidden;
    }

    const SelfOccludingMesh& body_;
    float gap_;
    std::vector<glm::vec3> pattern_;
    Bvh bvh_;
    std::vector<Sample> samples_;
};

} // namespace

std::vector<glm::vec3> cosineDirections(int count) {
    std::vector<glm::vec3> out;
    for (int i = 0; i < count; ++i) {
        const float square =
            (static_cast<float>(i) + 0.5f) / static_cast<float>(count); // squared radius in the disc
        const float ring = std::sqrt(square);
        out.emplace_back(ring * static_cast<float>(std::cos(i * kGoldenAngle)),
                         ring * static_cast<float>(std::sin(i * kGoldenAngle)), std::sqrt(1 - square));
    }
    return out;
}

AxisOcclusion withSelfOcclusion(AxisOcclusion hidden, const glm::vec3& normal,
                                const glm::vec4& selfOcclusion) {
    for (size_t k = 0; k < kAxisCount; ++k)
        hidden[k] =
            glm::clamp(hidden[k] + selfOcclusionAlong(selfOcclusion, axisAbove(normal, k)), 0.0f, 1.0f);
    return hidden;
}

glm::vec4 occlusionMoments(const AxisOcclusion& hidden, const glm::vec3& normal) {
    glm::vec4 sum(0);
    float all = 0;
    for (size_t k = 0; k < kAxisCount; ++k) {
        const float along = glm::dot(normal, kAxes[k]);
        all += std::abs(along);
        sum += hidden[k] * glm::vec4(along * kAxes[k], std::abs(along));
    }
    return sum / all;
}

// Adds the remaining error repeatedly, as if nothing were clamped. Across the normal the variance of a
// cosine-weighted hemisphere is a quarter.
glm::vec4 fitSelfOcclusion(const AxisOcclusion& hidden, const glm::vec3& normal, const glm::vec4& moments) {
    constexpr int kSteps = 8;
    constexpr float kMin = 0.05f; // share of the hemisphere that counts as nothing
    const float byOthers = std::min(occlusionMoments(hidden, normal).w / std::max(moments.w, kMin), 1.0f);
    const glm::vec3 middle = -kMeanBack * normal;
    glm::vec4 selfOcclusion(0);
    for (int step = 0; step < kSteps; ++step) {
        const glm::vec4 amiss =
            moments - occlusionMoments(withSelfOcclusion(hidden, normal, selfOcclusion), normal);
        glm::vec3 slope = 4.0f * (glm::vec3(amiss) - amiss.w * middle);
        slope -= byOthers * byOthers * glm::dot(slope, normal) * normal;
        selfOcclusion += glm::vec4(slope, amiss.w - glm::dot(slope, middle));
    }
    return selfOcclusion;
}

std::vector<glm::vec4> traceSelfOcclusion(const SelfOccludingMesh& body, int rays) {
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (const glm::vec3& p : body.positions) low = glm::min(low, p), high = glm::max(high, p);
    const float extent = glm::distance(low, high);
    if (!(extent > 0) || !std::isfinite(extent) || rays < 1)
        return std::vector<glm::vec4>(body.positions.size(), glm::vec4(0));
    SelfOcclusionOf folding(body, rays, extent);
    const size_t samples = folding.samples();
    const int threads = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 8);
    ThreadPool(threads - 1).parallelFor(threads, [&](int t) {
        folding.lookFrom(samples * t / threads, samples * (t + 1) / threads);
    });
    std::vector<glm::vec4> selfOcclusion = folding.fit();
    folding.smooth(selfOcclusion);
    std::vector<bool> used(selfOcclusion.size(), false);
    for (const uint32_t corner : body.indices) used[corner] = true;
    for (size_t v = 0; v < selfOcclusion.size(); ++v)
        if (used[v]) selfOcclusion[v] = fitSelfOcclusion({}, body.normals[v], selfOcclusion[v]);
    return selfOcclusion;
}

} // namespace shoal::occlusion
