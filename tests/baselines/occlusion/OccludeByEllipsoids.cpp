#include "tests/baselines/occlusion/OccludeByEllipsoids.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::occlusion {

constexpr float kMeanBack = -2 / 3.0f; // of directions in a cosine-weighted hemisphere, along its normal

OcclusionResult occlude(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> own,
                        const SelfOcclusion& selfOcclusion, std::span<const Occluder> others,
                        const SmoothLight& light) {
    const glm::mat4x3 dominant = dominantDirections(light);
    const float dominantSine = std::sqrt(light.dominantShare) / 2, dominantCap = light.dominantShare / 16;
    AxisOcclusion hidden{};
    glm::vec4 dominantHidden(0), albedo(1e-4f * selfOcclusion.albedo, 1e-4f);
    const auto add = [&](const Occluder& occluder) {
        const EllipsoidSilhouette seen(occluder.shape, p);
        addOcclusion(seen, occluder.strength, normal, hidden);
        for (int k = 0; k < 4; ++k)
            dominantHidden[k] += (1 - dominantHidden[k]) * occluder.strength *
                                 seen.hides(dominant[k], dominantSine, dominantCap);
        albedo += occluder.strength * seen.cap() * glm::vec4(occluder.albedo, 1);
    };
    for (const Occluder& occluder : own) add(occluder);
    hidden = withSelfOcclusion(hidden, normal, selfOcclusion.hidden);
    for (int k = 0; k < 4; ++k)
        dominantHidden[k] =
            glm::clamp(dominantHidden[k] + selfOcclusionAlong(selfOcclusion.hidden, dominant[k]), 0.0f, 1.0f);
    for (const Occluder& occluder : others) add(occluder);
    OcclusionResult result;
    const glm::vec4 moments = occlusionMoments(hidden, normal);
    result.share = moments.w;
    for (size_t k = 0; k < kAxisCount; ++k) {
        const float along = glm::dot(normal, kAxes[k]);
        result.radiance +=
            std::abs(along) * hidden[k] * 2.0f / kAxisCount * (along < 0 ? light.behind[k] : light.ahead[k]);
    }
    for (int k = 0; k < 4; ++k)
        result.radiance +=
            light.dominantRadiance *
            (light.dominantShare / 4 * std::max(glm::dot(normal, dominant[k]), 0.0f) * dominantHidden[k]);
    // An occluder in the shade of another shades it likewise.
    glm::vec3 sent = light.even[0] * moments.w;
    for (int k = 0; k < 3; ++k) sent += kMeanBack * moments[k] * light.even[k + 1];
    result.radiance -= (1 - result.share) * glm::max(sent, 0.0f) * glm::vec3(albedo) / albedo.w;
    return result;
}

float lobeVisibility(const glm::vec3& p, const glm::vec3& direction, float roughness,
                     std::span<const Occluder> occluders) {
    const float alpha = std::max(roughness * roughness, 0.02f), sine = 2 * alpha / (1 + alpha * alpha);
    float open = 1;
    for (const Occluder& occluder : occluders)
        open *= 1 - occluder.strength *
                        EllipsoidSilhouette(occluder.shape, p).hides(direction, sine, sine * sine / 4);
    return open;
}

} // namespace shoal::occlusion
