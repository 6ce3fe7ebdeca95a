#include "engine/occlusion/Shade.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::occlusion {

namespace {

// Sine of the angle in which a cap has an end's share of the sphere.
const float kCellSine = std::sqrt(1 - (1 - 1.0f / kAxisCount) * (1 - 1.0f / kAxisCount));
constexpr float kMeanBack = -2 / 3.0f; // of directions in a cosine-weighted hemisphere, along its normal

// An ellipsoid from a point. m: the point from its centre; Q: the symmetric matrix that makes it a ball,
// squared. A ray along d meets it where -Qm.d > sqrt(m.Qm - 1) |d|_Q. That difference grows across the
// silhouette by one over the distance of the tangent plane there from the centre, which is taken to be the
// same all around: right at the skin and for balls, and far away that of a disc as large as its shadow.
class Seen {
  public:
    Seen(const Ellipsoid& shape, const glm::vec3& p) {
        glm::mat3 scaled = shape.worldFromAxes;
        for (int k = 0; k < 3; ++k) scaled[k] /= shape.semiAxes[k];
        matrix_ = scaled * glm::transpose(scaled);
        const glm::vec3 m = p - shape.centre;
        slope_ = matrix_ * m;
        const float square = std::max(glm::dot(m, slope_), 1e-6f), far2 = std::max(glm::dot(m, m), 1e-12f),
                    outside = std::max(square, 1.0f); // who is within stands on its skin
        edge_ = std::sqrt(outside - 1);
        const glm::vec3& a = shape.semiAxes;
        const float disc2 = a.x * a.y * a.z * std::sqrt(square / far2);
        width_ =
            std::sqrt(1 / (outside * std::max(glm::dot(slope_, slope_), 1e-12f)) + (1 - 1 / outside) * disc2);
        const float near2 = 1 / (outside * outside); // it is no disc from near
        cap_ = 0.5f - 0.5f * std::sqrt(1 - std::min(std::max(disc2 / far2, near2 * near2), 1.0f));
    }

    // Of a round patch around a direction, 0 to 1. sine, share: of its half angle, and of the sphere.
    float hides(const glm::vec3& direction, float sine, float share) const {
        const float extent = std::sqrt(glm::dot(direction, matrix_ * direction));
        const float past = glm::dot(slope_, direction) + edge_ * extent;
        return glm::clamp(0.5f - 0.5f / sine * width_ * past, 0.0f, 1.0f) * std::min(cap_ / share, 1.0f);
    }
    float cap() const { return cap_; } // of the sphere

  private:
    glm::mat3 matrix_{1};
    glm::vec3 slope_{0};
    float edge_ = 0, width_ = 0, cap_ = 0;
};

float sideOf(const glm::vec3& normal, size_t axis) {
    return glm::dot(normal, kAxes[axis]) < 0 ? -1.0f : 1.0f;
}

// Of what others have left of the ends above a surface.
void hide(const Seen& seen, float strength, const glm::vec3& normal, Hidden& hidden) {
    for (size_t k = 0; k < kAxisCount; ++k)
        hidden[k] += (1 - hidden[k]) * strength *
                     seen.hides(sideOf(normal, k) * kAxes[k], kCellSine, 0.5f / kAxisCount);
}

float ofFold(const glm::vec4& fold, const glm::vec3& direction) {
    return fold.w + glm::dot(glm::vec3(fold), direction);
}

} // namespace

Hidden hiddenBy(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> occluders) {
    Hidden hidden{};
    for (const Occluder& occluder : occluders)
        hide(Seen(occluder.shape, p), occluder.strength, normal, hidden);
    return hidden;
}

Hidden folded(Hidden hidden, const glm::vec3& normal, const glm::vec4& fold) {
    for (size_t k = 0; k < kAxisCount; ++k)
        hidden[k] = glm::clamp(hidden[k] + ofFold(fold, sideOf(normal, k) * kAxes[k]), 0.0f, 1.0f);
    return hidden;
}

glm::vec4 momentsOf(const Hidden& hidden, const glm::vec3& normal) {
    glm::vec4 sum(0);
    float all = 0;
    for (size_t k = 0; k < kAxisCount; ++k) {
        const float along = glm::dot(normal, kAxes[k]);
        all += std::abs(along);
        sum += hidden[k] * glm::vec4(along * kAxes[k], std::abs(along));
    }
    return sum / all;
}

// What is amiss is added as if nothing were clamped, again and again. Across the normal the variance of a
// cosine-weighted hemisphere is a quarter.
glm::vec4 completing(const Hidden& hidden, const glm::vec3& normal, const glm::vec4& moments) {
    constexpr int kSteps = 8;
    constexpr float kLeast = 0.05f; // of the hemisphere: less is as good as none
    const float byOthers = std::min(momentsOf(hidden, normal).w / std::max(moments.w, kLeast), 1.0f);
    const glm::vec3 middle = -kMeanBack * normal;
    glm::vec4 fold(0);
    for (int step = 0; step < kSteps; ++step) {
        const glm::vec4 amiss = moments - momentsOf(folded(hidden, normal, fold), normal);
        glm::vec3 slope = 4.0f * (glm::vec3(amiss) - amiss.w * middle);
        slope -= byOthers * byOthers * glm::dot(slope, normal) * normal;
        fold += glm::vec4(slope, amiss.w - glm::dot(slope, middle));
    }
    return fold;
}

Taken take(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> own, const Fold& fold,
           std::span<const Occluder> others, const SmoothLight& light) {
    const glm::mat4x3 lamp = lampDirections(light);
    const float lampSine = std::sqrt(light.lampShare) / 2, lampCap = light.lampShare / 16;
    Hidden hidden{};
    glm::vec4 lampHidden(0), albedo(1e-4f * fold.albedo, 1e-4f);
    const auto add = [&](const Occluder& occluder) {
        const Seen seen(occluder.shape, p);
        hide(seen, occluder.strength, normal, hidden);
        for (int k = 0; k < 4; ++k)
            lampHidden[k] += (1 - lampHidden[k]) * occluder.strength * seen.hides(lamp[k], lampSine, lampCap);
        albedo += occluder.strength * seen.cap() * glm::vec4(occluder.albedo, 1);
    };
    for (const Occluder& occluder : own) add(occluder);
    hidden = folded(hidden, normal, fold.hidden);
    for (int k = 0; k < 4; ++k)
        lampHidden[k] = glm::clamp(lampHidden[k] + ofFold(fold.hidden, lamp[k]), 0.0f, 1.0f);
    for (const Occluder& occluder : others) add(occluder);
    Taken taken;
    const glm::vec4 moments = momentsOf(hidden, normal);
    taken.share = moments.w;
    for (size_t k = 0; k < kAxisCount; ++k) {
        const float along = glm::dot(normal, kAxes[k]);
        taken.radiance +=
            std::abs(along) * hidden[k] * 2.0f / kAxisCount * (along < 0 ? light.behind[k] : light.ahead[k]);
    }
    for (int k = 0; k < 4; ++k)
        taken.radiance += light.lampRadiance *
                          (light.lampShare / 4 * std::max(glm::dot(normal, lamp[k]), 0.0f) * lampHidden[k]);
    // What stands in their shade shades them likewise.
    glm::vec3 sent = light.even[0] * moments.w;
    for (int k = 0; k < 3; ++k) sent += kMeanBack * moments[k] * light.even[static_cast<size_t>(k + 1)];
    taken.radiance -= (1 - taken.share) * glm::max(sent, 0.0f) * glm::vec3(albedo) / albedo.w;
    return taken;
}

float openLobe(const glm::vec3& p, const glm::vec3& direction, float roughness,
               std::span<const Occluder> occluders) {
    const float alpha = std::max(roughness * roughness, 0.02f), sine = 2 * alpha / (1 + alpha * alpha);
    float open = 1;
    for (const Occluder& occluder : occluders)
        open *= 1 - occluder.strength * Seen(occluder.shape, p).hides(direction, sine, sine * sine / 4);
    return open;
}

} // namespace shoal::occlusion
