#include "engine/light/FindLights.h"

#include "engine/light/InverseToneMap.h"
#include "engine/math/LatLong.h"
#include "engine/math/Trigonometry.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

namespace shoal::light {

namespace {

constexpr int kCoarse = 64, kFine = 256; // texels around
constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kFirst = std::numbers::sqrt3_v<float>, kRamp = 0.4f; // standard deviations above the mean
constexpr float kMinReach = 0.21f, kMaxReach = 1.4f;                 // radius of the window, radians
constexpr float kNarrow = 0.6f, kWide = 0.7f; // radius around a sun with its glow; around half a scene
constexpr float kFineSlack = 0.04f;           // added to a window in the fine level: a texel and a half
// Ratio of the rms radius of (1 - r^2)^5 to that of 1 - r^2 on a disc: sqrt(3 / 7).
constexpr float kParaboloid = 0.65f;
constexpr float kMinShare = 1e-4f;

float luminanceAt(const ImageRgbF& level, int x, int y) {
    return thesisLuminance(glm::make_vec3(level.at(x, y)));
}

std::vector<glm::vec3> directionsOfTexels(int width) {
    std::vector<glm::vec3> directions;
    for (int y = 0; y < width / 2; ++y)
        for (int x = 0; x < width; ++x) directions.push_back(texelDirection(x, y, width, width / 2));
    return directions;
}

float solidAngle(const ImageRgbF& level, int y) {
    return static_cast<float>(texelSolidAngle(y, level.width, level.height));
}

// Returns a weight that falls from 1 at a window's centre to 0 at its edge, linear in the squared chord.
float kernel(float cosine, float cosReach) { return std::max(0.0f, (cosine - cosReach) / (1 - cosReach)); }

// Returns 1 within a window, falling to 0 at its edge.
float inside(float cosine, float cosReach) { return std::min(1.0f, 2 * kernel(cosine, cosReach)); }

float reachAround(float radius) { return std::clamp(1.5f * radius + 0.14f, kMinReach, kMaxReach); }

// Removes the texels' own width s from a measured radius r: a uniform disc has the variance r^2 / 2 about its
// centre, a square s^2 / 6. The result is at least half a texel.
float withoutTexels(float radius, int texelsAround) {
    const float side = 2 * kPi / static_cast<float>(texelsAround);
    return std::sqrt(std::max(radius * radius - side * side / 3, side * side / 4));
}

// Constants of LightOverTime.
constexpr float kFollow_s = 0.15f, kFade_s = 0.25f;      // time constants
constexpr float kFastest_radps = 0.38f;                  // 0.9 degrees for each frame of a film
constexpr float kSame = 0.26f;                           // radians: greatest step of the same light
constexpr float kStronger = 1.3f, kStrongerFor_s = 0.5f; // ratio and time for another light to take over
constexpr float kGone = 0.02f;                           // presence below which a light ends unnoticed
constexpr float kCut = 0.15f;                            // sceneDistance() above which there was a cut

float strength(const FoundLight& light) { return thesisLuminance(light.irradiance); }

struct Moments {
    float flux = 0;
    glm::vec3 sum{0};     // flux-weighted sum of directions
    glm::vec3 towards{0}; // the same, also weighted by kernel(): the window moves there

    // Returns the radius r of a uniform cap whose mean direction is as long: its length is (1 + cos r) / 2.
    float radius() const {
        return flux > 0 ? std::acos(std::clamp(2 * glm::length(sum) / flux - 1, -1.0f, 1.0f)) : 0;
    }
};

Moments momentsWithin(const std::vector<BrightTexel>& texels, const glm::vec3& middle, float cosReach) {
    Moments moments;
    for (const BrightTexel& texel : texels) {
        const float k = kernel(glm::dot(texel.direction, middle), cosReach) * texel.weight;
        if (k <= 0) continue;
        const float whole = std::min(texel.weight, 2 * k);
        moments.flux += whole;
        moments.sum += whole * texel.direction;
        moments.towards += k * texel.direction;
    }
    return moments;
}

} // namespace

LightFinder::LightFinder()
    : directions_(directionsOfTexels(kCoarse)), fineDirections_(directionsOfTexels(kFine)) {
    luminance_.resize(directions_.size());
    bright_.reserve(directions_.size());
    near_.reserve(fineDirections_.size());
}

// Appends a texel if it counts as light; its weight is multiplied by the share to which it does.
void LightFinder::addIfBright(const glm::vec3& direction, float luminance, float solidAngle_sr,
                              std::vector<BrightTexel>& texels) const {
    const float above = luminance - mean_;
    const float part = std::clamp((above / deviation_ - kFirst) / kRamp, 0.0f, 1.0f);
    if (part > 0) texels.push_back({direction, part * above * solidAngle_sr, above});
}

void LightFinder::gatherNear(const glm::vec3& middle, float reach, const ImageRgbF& level) {
    near_.clear();
    const CellRange cap = cellsOfCap({level.width, level.height}, middle, reach);
    const float cosReach = std::cos(reach);
    for (int y = cap.first.y; y <= cap.last.y; ++y) {
        const float solid = solidAngle(level, y);
        for (int x = 0; x < level.width; ++x) {
            const glm::vec3& direction = fineDirections_[y * kFine + x];
            if (glm::dot(direction, middle) > cosReach)
                addIfBright(direction, luminanceAt(level, x, y), solid, near_);
        }
    }
}

// Moves a light and its window to the centre of the bright texels near it, and fits the window to them.
void LightFinder::settle(FoundLight& light, float window) const {
    for (int i = 0; i < 8; ++i) {
        const Moments moments = momentsWithin(near_, light.direction, std::cos(window));
        if (glm::length(moments.towards) <= 0) break;
        const glm::vec3 next = glm::normalize(moments.towards);
        const float radius = moments.radius(), narrower = std::min(window, 1.5f * radius + kFineSlack);
        const bool still = glm::dot(next, light.direction) > 1 - 1e-6f && window - narrower < 0.002f;
        light.direction = next;
        light.radius = withoutTexels(radius, kFine);
        window = narrower;
        if (still) break;
    }
}

// Moves a light towards its brightest texels, where a clipped source must be.
void LightFinder::sharpen(float reach, FoundLight& light) {
    float maximum = 0;
    for (const BrightTexel& texel : near_) maximum = std::max(maximum, texel.above);
    for (BrightTexel& texel : near_) {
        const float height = texel.above / maximum, square = height * height;
        texel.weight *= square * square;
    }
    FoundLight peak = light;
    settle(peak, reach);
    const float narrow = std::clamp((kWide - reach) / (kWide - kNarrow), 0.0f, 1.0f),
                peaked = std::clamp((1 - peak.radius / light.radius) / (1 - kParaboloid), 0.0f, 1.0f);
    light.direction = glm::normalize(glm::mix(light.direction, peak.direction, narrow * peaked));
    light.radius += (peak.radius - light.radius) * narrow * peaked;
}

// Moves a window from a bright texel to the light that it belongs to; reach: the window's radius at the end.
FoundLight LightFinder::seek(const glm::vec3& seed, const ImageRgbF& fine, float& reach) {
    FoundLight light;
    light.direction = seed;
    reach = kMinReach;
    float rough = 0;
    for (int i = 0; i < 16; ++i) {
        const Moments moments = momentsWithin(bright_, light.direction, std::cos(reach));
        if (glm::length(moments.towards) <= 0) return light;
        const glm::vec3 next = glm::normalize(moments.towards);
        rough = moments.radius();
        const float nextReach = reachAround(rough);
        const bool still =
            glm::dot(next, light.direction) > 1 - 1e-7f && std::abs(nextReach - reach) < 0.002f;
        light.direction = next;
        reach = nextReach;
        if (still) break;
    }
    light.radius = withoutTexels(rough, kCoarse);
    if (reach > kWide) return light;
    gatherNear(light.direction, reach, fine);
    settle(light, reach);
    sharpen(reach, light);
    return light;
}

// Computes the light's irradiance on a plane that faces it, beyond what the mean radiance of all other texels
// would give. A texel counts less near the window's edge, and if it exceeds the sphere's mean by little.
void LightFinder::weigh(const ImageRgbF& coarse, float reach, FoundLight& light) const {
    const float cosReach = std::cos(reach);
    glm::vec3 bright(0), rest(0);
    float brightWeight = 0, restWeight = 0;
    for (int y = 0; y < coarse.height; ++y) {
        const float solid = solidAngle(coarse, y);
        for (int x = 0; x < coarse.width; ++x) {
            const auto i = static_cast<size_t>(y * coarse.width + x);
            const float cosine = glm::dot(directions_[i], light.direction);
            if (cosine <= 0) continue;
            const float part = std::clamp((luminance_[i] - mean_) / (kFirst * deviation_), 0.0f, 1.0f) *
                               inside(cosine, cosReach);
            const float weight = solid * cosine;
            const glm::vec3 radiance = glm::make_vec3(coarse.at(x, y));
            bright += part * weight * radiance;
            brightWeight += part * weight;
            rest += (1 - part) * weight * radiance;
            restWeight += (1 - part) * weight;
        }
    }
    light.irradiance = glm::max(bright - rest * (brightWeight / restWeight), 0.0f);
    light.share = thesisLuminance(light.irradiance) / thesisLuminance(bright + rest);
}

void LightFinder::find(const RadiancePyramid& radiance, FoundLights& out) {
    const ImageRgbF& coarse = radiance.ofWidth(kCoarse);
    out.count = 0;
    out.groundIrradiance = glm::vec3(0);
    double sum = 0, squares = 0;
    for (int y = 0; y < coarse.height; ++y) {
        const float solid = solidAngle(coarse, y);
        glm::vec3 upward(0);
        for (int x = 0; x < coarse.width; ++x) {
            const auto i = static_cast<size_t>(y * coarse.width + x);
            const float luminance = luminanceAt(coarse, x, y);
            luminance_[i] = luminance;
            sum += static_cast<double>(solid * luminance);
            squares += double{solid} * double{luminance} * double{luminance};
            upward += glm::make_vec3(coarse.at(x, y));
        }
        out.groundIrradiance += solid * std::max(directions_[y * coarse.width].y, 0.0f) * upward;
    }
    const ImageRgbF& thumb = radiance.ofWidth(kThumbWidth);
    for (size_t i = 0; i < out.thumb.size(); ++i)
        out.thumb[i] = thesisLuminance(glm::make_vec3(&thumb.pixels[3 * i]));

    const double mean = sum / (4 * std::numbers::pi);
    mean_ = static_cast<float>(mean);
    deviation_ = static_cast<float>(std::sqrt(std::max(0.0, squares / (4 * std::numbers::pi) - mean * mean)));
    if (!(deviation_ > 1e-4f * mean_)) return; // uniform apart from rounding errors

    bright_.clear();
    for (size_t y = 0, i = 0; i < luminance_.size(); ++y) {
        const float solid = solidAngle(coarse, static_cast<int>(y));
        for (const size_t end = i + kCoarse; i < end; ++i)
            addIfBright(directions_[i], luminance_[i], solid, bright_);
    }
    const ImageRgbF& fine = radiance.ofWidth(kFine);
    while (out.count < kMaxLights && !bright_.empty()) {
        const auto seed = std::ranges::max_element(bright_, {}, &BrightTexel::weight);
        float reach = 0;
        FoundLight light = seek(seed->direction, fine, reach);
        weigh(coarse, reach, light);
        // Texels in this window are not used again.
        const glm::vec3 from = seed->direction;
        std::erase_if(bright_, [&](const BrightTexel& texel) {
            return glm::dot(texel.direction, light.direction) > std::cos(reach) || texel.direction == from;
        });
        if (light.share < kMinShare) break;
        out.lights[out.count++] = light;
    }
    std::ranges::sort(std::span(out.lights).first(out.count), std::ranges::greater(), strength);
}

// Returns the difference between two scenes, 0 to 1: the mean over the sphere of |a - b| / (a + b) of their
// luminances (Lance and Williams 1967), in which bright parts do not outweigh the rest.
static float sceneDistance(const FoundLights& a, const FoundLights& b) {
    double sum = 0;
    for (size_t i = 0; i < a.thumb.size(); ++i) {
        const double weight = texelSolidAngle(static_cast<int>(i / kThumbWidth), kThumbWidth, kThumbHeight);
        const auto both = static_cast<double>(a.thumb[i] + b.thumb[i]);
        if (both > 0) sum += weight * std::abs(static_cast<double>(a.thumb[i] - b.thumb[i])) / both;
    }
    return static_cast<float>(sum / (4 * std::numbers::pi));
}

const ShadowLight& LightOverTime::take(const FoundLights& found, float presence) {
    now_.presence = found.count ? presence : 0;
    if (found.count) now_.light = found.lights[0];
    now_.groundIrradiance = found.groundIrradiance;
    strongerFor_s_ = 0;
    return now_;
}

const ShadowLight& LightOverTime::follow(const FoundLights& found, float dt_s) {
    const bool cut = !begun_ || sceneDistance(found, last_) > kCut;
    begun_ = true;
    last_ = found;
    if (cut) return take(found, 1);
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
    if (leaving && now_.presence < kGone) return take(found, kGone);
    const float part = math::followShare(dt_s, kFollow_s);
    now_.groundIrradiance += (found.groundIrradiance - now_.groundIrradiance) * part;
    if (!same) return now_;
    FoundLight& light = now_.light;
    const float away = std::acos(std::clamp(nearest, -1.0f, 1.0f));
    const float turn = std::clamp(kFastest_radps * dt_s / std::max(away, 1e-6f), 0.0f, part);
    light.direction = glm::normalize(glm::mix(light.direction, same->direction, turn));
    light.radius += (same->radius - light.radius) * part;
    light.irradiance += (same->irradiance - light.irradiance) * part;
    light.share += (same->share - light.share) * part;
    return now_;
}

} // namespace shoal::light
