#include "engine/occlusion/Shade.h"

#include <algorithm>

namespace shoal::occlusion {

namespace {

constexpr float kMeanHeight = 2 / 3.0f; // of directions in a cosine-weighted hemisphere, along its normal

// An occluder from a point of a surface, as if it were alone.
struct Seen {
    Cap<float> cap;
    float share = 0;
    glm::vec3 mean{0};

    Seen(const Occluder& occluder, const glm::vec3& p, const glm::vec3& normal)
        : cap(capOf(occluder.shape, p)) {
        const float cosine = glm::dot(cap.towards, normal);
        share = clippedShare(cap.share, cosine) * occluder.strength;
        mean = meanDirection(cap, normal, cosine);
    }
};

// What is taken, by the powers of its direction.
struct Moments {
    float sum = 0;
    glm::vec3 first{0};
    float second[5] = {};

    // Of a share in this mean direction, what is not taken yet.
    float left(float share, const glm::vec3& mean, const glm::vec3& normal) const {
        const glm::vec3 middle = kMeanHeight * normal;
        const float density = sum + 4 * glm::dot(first - sum * middle, mean - middle);
        return std::min(share * (1 - glm::clamp(density, 0.0f, 1.0f)), 1 - sum);
    }
    // Returns the share that it takes.
    float add(const Seen& seen, const glm::vec3& normal) {
        const float share = left(seen.share, seen.mean, normal);
        sum += share;
        first += share * seen.mean;
        addSecond(share, seen.mean);
        return share;
    }
    void addSecond(float share, const glm::vec3& mean) {
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

// A fold as a cap: some of it may be negative, where own ellipsoids take more than the body does.
struct FoldCap {
    float share = 0; // 0 to 1
    glm::vec3 mean{0};

    explicit FoldCap(const glm::vec4& fold) : share(std::max(fold.w, 0.0f)) {
        const glm::vec3 first(fold);
        mean = first / std::max({share, glm::length(first), 1e-6f});
    }
};

// Of a lamp, by a cap of this mean direction, as dense as its share of the hemisphere says.
float foldCoverage(const FoldCap& fold, const glm::vec3& normal, const glm::vec3& lamp, float lampSine) {
    const float length = std::max(glm::length(fold.mean), 1e-6f), edge = std::max(2 * length - 1, 0.0f),
                soft = 0.2f + lampSine;
    const glm::vec3 towards = fold.mean / length;
    const float density = std::min(
        1.0f, fold.share / std::max(clippedShare(1 - edge * edge, glm::dot(towards, normal)), 1e-3f));
    return density * glm::smoothstep(edge - soft, edge + soft, glm::dot(towards, lamp));
}

} // namespace

glm::vec4 hiddenBy(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> occluders) {
    Moments moments;
    for (const Occluder& occluder : occluders) moments.add(Seen(occluder, p, normal), normal);
    return {moments.first, moments.sum};
}

Taken take(const glm::vec3& p, const glm::vec3& normal, std::span<const Occluder> own, const Fold& fold,
           std::span<const Occluder> others, const SmoothLight& light) {
    const float lampSine = std::sqrt(light.lampShare);
    float lampOpen = 1;
    Moments moments;
    glm::vec3 bounced(0);
    const auto add = [&](const Occluder& occluder) {
        const Seen seen(occluder, p, normal);
        const float share = moments.add(seen, normal);
        lampOpen *=
            1 - occluder.strength * coverage(occluder.shape, p, light.lampTowards, lampSine, seen.cap.share);
        bounced += share * occluder.albedo * lightOnBody(light, seen.cap.towards);
    };
    for (const Occluder& occluder : own) add(occluder);
    if (const FoldCap cap(fold.hidden); glm::dot(fold.hidden, fold.hidden) > 0) {
        const float before = moments.sum;
        moments.sum = glm::clamp(before + fold.hidden.w, 0.0f, 1.0f);
        // Where own parts stand out of the skin, what they take too much is given back of all that they took.
        const float kept = std::min(moments.sum / std::max(before, 1e-6f), 1.0f);
        for (float& each : moments.second) each *= kept;
        lampOpen = 1 - kept * (1 - lampOpen);
        bounced *= kept;
        moments.first += glm::vec3(fold.hidden);
        moments.addSecond(cap.share, cap.mean);
        lampOpen *= 1 - foldCoverage(cap, normal, light.lampTowards, lampSine);
        bounced +=
            cap.share * fold.albedo * lightOnBody(light, cap.mean / std::max(glm::length(cap.mean), 1e-6f));
    }
    for (const Occluder& occluder : others) add(occluder);
    Taken taken;
    taken.share = moments.sum;
    // What stands in their shade shades them likewise.
    taken.radiance =
        moments.of(light.around) - (1 - taken.share) * bounced +
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
