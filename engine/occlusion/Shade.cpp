#include "engine/occlusion/Shade.h"

#include <algorithm>

namespace shoal::occlusion {

Taken take(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> occluders,
           const SmoothLight& light) {
    const auto& around = light.around;
    float sum = 0, open = 1, lampOpen = 1;
    glm::vec3 first(0), bounced(0); // moments of what is taken, by the powers of the direction
    float second[5] = {};
    const float lampSine = std::sqrt(light.lampShare);
    for (const Occluder& occluder : occluders) {
        const Cap<float> cap = capOf(occluder.shape, p);
        const float cosine = glm::dot(cap.towards, normal);
        const float share = clippedShare(cap.share, cosine) * occluder.strength;
        sum += share;
        open *= 1 - share;
        lampOpen *=
            1 - occluder.strength * coverage(occluder.shape, p, light.lampTowards, lampSine, cap.share);
        const glm::vec3 mean = meanDirection(cap, normal, cosine);
        first += share * mean;
        // A cap whose mean direction is (1 + c) / 2 long has a second band of c (1 + c) / 2.
        const float length2 = std::max(glm::dot(mean, mean), 1e-6f), length = std::sqrt(length2);
        const float f = share * std::max(2 * length - 1, 0.0f) * length;
        const glm::vec3 q = f / length2 * mean;
        second[0] += q.x * mean.y, second[1] += q.y * mean.z, second[2] += q.x * mean.z;
        second[3] += q.y * mean.y - f / 3, second[4] += q.x * mean.x - q.z * mean.z;
        // The side that is seen faces this way, and its diffuse light has two thirds of the first band.
        const glm::vec3 back = -2 / 3.0f * cap.towards;
        const float lit = light.lampShare * std::max(-glm::dot(cap.towards, light.lampTowards), 0.0f);
        bounced += share * occluder.albedo *
                   (glm::max(around[0] + around[1] * back.x + around[2] * back.y + around[3] * back.z, 0.0f) +
                    lit * light.lampRadiance);
    }
    Taken taken;
    taken.share = 1 - open;
    const glm::vec3 lost = around[0] * sum + around[1] * first.x + around[2] * first.y + around[3] * first.z +
                           around[4] * second[0] + around[5] * second[1] + around[6] * second[2] +
                           around[7] * second[3] + around[8] * second[4];
    // What stands in their shade shades them likewise.
    taken.radiance =
        (lost - open * bounced) * (taken.share / std::max(sum, 1e-6f)) +
        light.lampRadiance *
            (clippedShare(light.lampShare, glm::dot(normal, light.lampTowards)) * (1 - lampOpen));
    return taken;
}

float openLobe(const glm::vec3& p, const glm::vec3& direction, float roughness,
               std::span<const Occluder> occluders) {
    const float sine = lobeSine(roughness);
    float open = 1;
    for (const Occluder& occluder : occluders)
        open *= 1 - occluder.strength *
                        coverage(occluder.shape, p, direction, sine, capOf(occluder.shape, p).share);
    return open;
}

} // namespace shoal::occlusion
