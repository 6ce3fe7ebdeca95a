#include "game/rules/Swimmer.h"

#include "game/rules/Steering.h"

#include <algorithm>

namespace shoal::game {

void Gait::set(Motion next) {
    if (next == motion) return;
    before = motion;
    motion = next;
    blend = 0;
}

void Gait::advance(float rate) {
    constexpr float kBlend_s = 0.2f;
    phase_s += kDt * rate;
    blend = std::min(1.0f, blend + kDt / kBlend_s);
}

physics::Capsule capsuleOf(const Swimmer& s, const Species& kind, float maxRadius_m) {
    const glm::vec3 half = s.forward * kind.bodyHalf_m;
    return {s.position - half, s.position + half, std::min(kind.bodyRadius_m, maxRadius_m)};
}

void startCircling(Swimmer& s, glm::vec3 position, glm::vec3 outward, float sense, float speed_mps) {
    s.position = position;
    s.forward = glm::cross(kUp, outward) * sense;
    s.speed = speed_mps;
    s.velocity = s.forward * s.speed;
    s.worldFromBody = bodyTurn(s.forward, 0);
}

void bankIntoTurn(Swimmer& s, float gain, float maxBank, float rate) {
    const float goal = std::clamp(gain * glm::dot(s.spin, kUp), -maxBank, maxBank);
    s.bank += (goal - s.bank) * (rate * kDt);
}

float eased(float value, float goal, float rate) {
    return value + (goal - value) * std::min(1.0f, rate * kDt);
}

namespace {

// The curvature is the desired turning rate over the speed, for which at least this many lengths a second are
// taken: a hovering body would curl up.
constexpr float kMinSpeed_lps = 1.5f;

float bendFor(float rate_radps, float speed_mps, float length_m, float maximum) {
    return std::clamp(rate_radps * length_m / std::max(speed_mps, kMinSpeed_lps * length_m), -maximum,
                      maximum);
}

} // namespace

float bendLeftFor(const Swimmer& s, glm::vec3 desiredSpin, float length_m, float maximum) {
    return bendFor(glm::dot(desiredSpin, kUp), s.speed, length_m, maximum);
}

float bendUpFor(const Swimmer& s, glm::vec3 desiredSpin, float length_m, float maximum) {
    return bendFor(-glm::dot(desiredSpin, leftOf(s.forward)), s.speed, length_m, maximum);
}

void beatTail(Swimmer& s, const Species& kind, float minBeat_Hz) {
    s.shape.beats += std::max(tailBeat_Hz(s.speed, kind.length_m, kind.stride), minBeat_Hz) * kDt;
}

} // namespace shoal::game
