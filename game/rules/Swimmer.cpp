#include "game/rules/Swimmer.h"

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

float bendFor(const Swimmer& s, float rate_radps, float length_m, float maximum) {
    // The path's curvature is the turning rate divided by the speed. The speed's lower bound, body lengths a
    // second, keeps a hovering body from curling up.
    constexpr float kMinSpeed_lps = 1.5f;
    return std::clamp(rate_radps * length_m / std::max(s.speed, kMinSpeed_lps * length_m), -maximum, maximum);
}

void beatTail(Swimmer& s, const Species& kind, float minBeat_Hz) {
    s.shape.beats += std::max(tailBeat_Hz(s.speed, kind.length_m, kind.stride), minBeat_Hz) * kDt;
}

} // namespace shoal::game
