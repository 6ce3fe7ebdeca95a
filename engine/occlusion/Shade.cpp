#include "engine/occlusion/Shade.h"

#include <algorithm>

namespace shoal::occlusion {

namespace {

// What is taken, by the powers of its direction.
struct Moments {
    float sum = 0;
    glm::vec3 first{0};
    float second[5] = {};

    void add(float share, const glm::vec3& mean) {
        sum += share;
        first += share * mean;
        // A cap whose mean direction is (1 + c) / 2 long has a second band of c (1 + c) / 2.
        const float length2 = std::max(glm::dot(mean, mean), 1e-6f), length = std::sqrt(length2);
        const float f = share * std::max(2 * length - 1, 0.0f) * length;
        const glm::vec3 q = f / length2 * mean;
        second[0] += q.x * mean.y, second[1] += q.y * mean.z, second[2] += q.x * mean.z;
        second[3] += q.y * mean.y - f / 3, second[4] += q.x * mean.x - q.z * mean.z;
    }

    glm::vec3 of(const std::array<glm::vec3, 9>& around) const {
        glm::vec3 light = around[0] * sum + around[1] * first.x + around[2] * first.y + around[3] * first.z;
        for (size_t k = 0; k < 5; ++k) light += around[4 + k] * second[k];
        return light;
    }
};

// On the side of a white body that is seen in this direction: it faces this way, and its diffuse light has
// two thirds of the first band.
glm::vec3 lightOnBody(const SmoothLight& light, const glm::vec3& towards) {
    const glm::vec3 back = -2 / 3.0f * towards;
    return glm::max(light.around[0] + light.around[1] * back.x + light.around[2] * back.y +
                        light.around[3] * back.z,
                    0.0f) +
           light.lampShare * std::max(-glm::dot(towards, light.lampTowards), 0.0f) * light.lampRadiance;
}

// Of a lamp, by a cap of this mean direction, as dense as its share of the hemisphere says.
float foldCoverage(const glm::vec4& fold, const glm::vec3& normal, const glm::vec3& lamp, float lampSine) {
    const glm::vec3 first(fold);
    const float length = glm::length(first) / fold.w, edge = std::max(2 * length - 1, 0.0f),
                soft = 0.2f + lampSine;
    const glm::vec3 towards = first / (length * fold.w);
    const float density =
        std::min(1.0f, fold.w / std::max(clippedShare(1 - edge * edge, glm::dot(towards, normal)), 1e-3f));
    return density * glm::smoothstep(edge - soft, edge + soft, glm::dot(towards, lamp));
}

} // namespace

Taken take(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> occluders,
           const SmoothLight& light, const Fold& fold) {
    const float lampSine = std::sqrt(light.lampShare);
    float open = 1, lampOpen = 1;
    Moments moments;
    glm::vec3 bounced(0);
    if (const glm::vec4& hidden = fold.hidden; hidden.w > 0.004f) {
        moments.add(hidden.w, glm::vec3(hidden) / hidden.w);
        open = 1 - hidden.w;
        lampOpen = 1 - foldCoverage(hidden, normal, light.lampTowards, lampSine);
        bounced = hidden.w * fold.albedo * lightOnBody(light, glm::normalize(glm::vec3(hidden)));
    }
    for (const Occluder& occluder : occluders) {
        const Cap<float> cap = capOf(occluder.shape, p);
        const float cosine = glm::dot(cap.towards, normal);
        const float share = clippedShare(cap.share, cosine) * occluder.strength;
        open *= 1 - share;
        lampOpen *=
            1 - occluder.strength * coverage(occluder.shape, p, light.lampTowards, lampSine, cap.share);
        moments.add(share, meanDirection(cap, normal, cosine));
        bounced += share * occluder.albedo * lightOnBody(light, cap.towards);
    }
    Taken taken;
    taken.share = 1 - open;
    // What stands in their shade shades them likewise.
    taken.radiance =
        (moments.of(light.around) - open * bounced) * (taken.share / std::max(moments.sum, 1e-6f)) +
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
