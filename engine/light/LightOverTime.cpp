#include "engine/light/LightOverTime.h"

#include "engine/light/InverseToneMap.h"
#include "engine/math/LatLong.h"
#include "engine/math/Trigonometry.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::light {

namespace {

constexpr float kFollow_s = 0.15f, kFade_s = 0.25f;      // time constants
constexpr float kFastest_radps = 0.38f;                  // 0.9 degrees for each frame of a film
constexpr float kSame = 0.26f;                           // radians: greatest step of the same light
constexpr float kStronger = 1.3f, kStrongerFor_s = 0.5f; // ratio and time for another light to take over
constexpr float kGone = 0.02f;                           // presence below which a light ends unnoticed
constexpr float kCut = 0.15f;                            // sceneDistance() above which there was a cut

float strength(const FoundLight& light) { return thesisLuminance(light.irradiance); }

} // namespace

float sceneDistance(const FoundLights& a, const FoundLights& b) {
    double sum = 0, weights = 0;
    for (size_t i = 0; i < a.thumb.size(); ++i) {
        const double weight = texelSolidAngle(static_cast<int>(i / kThumbWidth), kThumbWidth, kThumbHeight);
        const auto both = static_cast<double>(a.thumb[i] + b.thumb[i]);
        if (both > 0) sum += weight * std::abs(static_cast<double>(a.thumb[i] - b.thumb[i])) / both;
        weights += weight;
    }
    return static_cast<float>(sum / weights);
}

void LightOverTime::take(const FoundLights& found, float presence) {
    now_.presence = found.count ? presence : 0;
    if (found.count) now_.light = found.lights[0];
    now_.groundIrradiance = found.groundIrradiance;
    strongerFor_s_ = 0;
}

const ShadowLight& LightOverTime::follow(const FoundLights& found, float dt_s) {
    const bool cut = !begun_ || sceneDistance(found, last_) > kCut;
    begun_ = true;
    last_ = found;
    if (cut) {
        take(found, 1);
        return now_;
    }
    const FoundLight* same = nullptr;
    float nearest = std::cos(std::max(kSame, 0.7f * now_.light.radius));
    for (size_t i = 0; i < found.count; ++i) {
        const float cosine = glm::dot(found.lights[i].direction, now_.light.direction);
        if (cosine < nearest) continue;
        nearest = cosine;
        same = &found.lights[i];
    }
    const bool otherIsStronger =
        found.count > 0 && (!same || strength(found.lights[0]) > kStronger * strength(*same));
    strongerFor_s_ = otherIsStronger ? strongerFor_s_ + dt_s : 0;
    const bool leaving = !same || strongerFor_s_ > kStrongerFor_s;
    now_.presence += ((leaving ? 0.0f : 1.0f) - now_.presence) * math::followShare(dt_s, kFade_s);
    if (leaving && now_.presence < kGone) {
        take(found, kGone);
        return now_;
    }
    const float part = math::followShare(dt_s, kFollow_s);
    now_.groundIrradiance += (found.groundIrradiance - now_.groundIrradiance) * part;
    if (!same) return now_;
    FoundLight& light = now_.light;
    const float away = std::acos(std::clamp(nearest, -1.0f, 1.0f));
    const float turn = std::min(part, kFastest_radps * dt_s / std::max(away, 1e-6f));
    light.direction = glm::normalize(glm::mix(light.direction, same->direction, turn));
    light.radius += (same->radius - light.radius) * part;
    light.irradiance += (same->irradiance - light.irradiance) * part;
    light.share += (same->share - light.share) * part;
    return now_;
}

} // namespace shoal::light
