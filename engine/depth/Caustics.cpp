#include "engine/depth/Caustics.h"

#include "engine/light/InverseToneMap.h"
#include "engine/math/Trigonometry.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>

namespace shoal::depth {

constexpr float kMean_s = 0.5f;     // time constant of the mean
constexpr float kDeepest_m = 3;     // furthest ground along a ray
constexpr float kMostChange = 1.5f; // limits what the edge of a rock that passes can do

void Caustics::follow(const ImageRgbF& radianceLin, float passed_s) {
    const bool anew = mean_.width != radianceLin.width || passed_s < 0 || passed_s > kMean_s;
    mean_.fit(radianceLin.width, radianceLin.height);
    change_.fit(radianceLin.width, radianceLin.height);
    const float share = anew ? 1 : math::followShare(passed_s, kMean_s);
    for (size_t i = 0; i < mean_.pixels.size(); ++i) {
        const float luminance = light::linearLuminance(glm::make_vec3(radianceLin.pixels.data() + 3 * i));
        mean_.pixels[i] += share * (luminance - mean_.pixels[i]);
        change_.pixels[i] =
            std::clamp(luminance / std::max(mean_.pixels[i], 1e-4f) - 1, -kMostChange, kMostChange);
    }
}

float Caustics::changeAt(const glm::vec3& placeEnv, const glm::vec3& towardsEnv, float length_m,
                         const DepthMap& map) const {
    const auto isBelow = [&](float along) {
        const glm::vec3 there = placeEnv - towardsEnv * along;
        const float distance = glm::length(there);
        return distance > 0 && distance * map.inverse_perM(there / distance) >= 1;
    };
    if (change_.empty() || isBelow(0)) return 0;
    float low = 0, high = 0.1f;
    for (; high < kDeepest_m && !isBelow(high); low = high) high = 1.15f * high + 0.05f;
    if (high >= kDeepest_m) return 0;
    const glm::vec3 ground = placeEnv - towardsEnv * (0.5f * (low + high));
    const float aside = 0.3f * length_m;
    constexpr std::array<glm::vec3, 5> kAround = {{{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}}};
    float sum = 0;
    for (const glm::vec3& around : kAround) {
        const glm::vec2 uv = latLongFromDirection(glm::normalize(ground + aside * around));
        const glm::ivec2 size(change_.width, change_.height);
        const glm::ivec2 texel = glm::clamp(glm::ivec2(uv * glm::vec2(size)), glm::ivec2(0), size - 1);
        sum += *change_.at(texel.x, texel.y);
    }
    return sum / static_cast<float>(kAround.size());
}

} // namespace shoal::depth
