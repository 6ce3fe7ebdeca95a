// Position, heading and body shape of a fish or the shark, and how they advance in one tick. World frame,
// metres, seconds, radians. No library trigonometry: the state must be the same on every machine.
#pragma once

#include "engine/physics/Contact.h"
#include "game/rules/DiveFile.h"
#include "game/rules/Snapshot.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace shoal::game {

struct Swimmer {
    glm::vec3 position{0};      // middle of the body
    glm::vec3 forward{0, 0, 1}; // unit
    glm::vec3 spin{0};          // angular velocity of forward, rad/s
    float bank = 0;             // tangent of the lean to the left
    float speed = 0;            // along forward
    glm::vec3 velocity{0};      // mean over the last tick, pushes included
    glm::quat worldFromBody{1, 0, 0, 0};
    Gait gait;
    BodyShape shape;
    float size = 1; // length over its species' length
};

inline float lengthOf(const Swimmer& s, const Species& kind) { return s.size * kind.length_m; }

// Returns the body's collision shape, no thicker than maxRadius_m.
inline physics::Capsule capsuleOf(const Swimmer& s, const Species& kind, float maxRadius_m = 1) {
    const glm::vec3 half = s.forward * (s.size * kind.bodyHalf_m);
    return {s.position - half, s.position + half, std::min(s.size * kind.bodyRadius_m, maxRadius_m)};
}

// Returns the swimmer as a body of the physics world, over the last tick.
inline physics::Body bodyOf(const Swimmer& s, size_t id, const Species& kind) {
    const physics::Capsule now = capsuleOf(s, kind);
    const glm::vec3 way = s.velocity * kDt;
    return {static_cast<uint32_t>(id), {now.a - way, now.b - way, now.radius}, now, s.velocity};
}

// Small fish can beat faster (Wardle 1975, "Limit of fish swimming speed"), but a display could not show it.
constexpr float kFastestBeat_Hz = 12;
constexpr float kFullBeat = 0.1f; // half the tail's sweep at speed, body lengths: Bainbridge 1958

// Returns the tail's beats a second. A fish moves on by the same part of its length, its stride, with every
// beat, however fast it swims: Bainbridge 1958, "The speed of swimming of fish as related to size and to the
// frequency and amplitude of the tail beat" (0.6 to 0.75 of the length in dace, trout and goldfish).
inline float tailBeat_Hz(float speed_mps, float length_m, float stride) {
    return std::min(kFastestBeat_Hz, speed_mps / (stride * length_m));
}

// Returns half the tail's sweep in body lengths; pace: speed divided by the cruising speed. It grows with
// speed and saturates at high speed (Bainbridge 1958).
inline float tailAmplitude(float pace) { return kFullBeat * pace / (pace + 0.3f); }

// Beats the tail for its speed and stride, but at least minBeat_Hz.
inline void beatTail(Swimmer& s, const Species& kind, float minBeat_Hz = 0) {
    s.shape.beats += std::max(tailBeat_Hz(s.speed, kind.length_m, kind.stride), minBeat_Hz) * kDt;
}

constexpr float kMaxBendLeft = 0.9f; // radians between head and tail, swimming
// Returns the angle between head and tail, radians, of a body bent along its path, for the desired turning
// rate about one axis. The body bends before its heading turns.
inline float bendFor(const Swimmer& s, float rate_radps, float length_m, float maximum) {
    // The path's curvature is the turning rate divided by the speed. The speed's lower bound, body lengths a
    // second, keeps a hovering body from curling up.
    constexpr float kMinSpeed_lps = 1.5f;
    return std::clamp(rate_radps * length_m / std::max(s.speed, kMinSpeed_lps * length_m), -maximum, maximum);
}

// Arithmetic of everything that swims: only roots, which IEEE 754 rounds exactly.

constexpr glm::vec3 kUp(0, 1, 0);

inline glm::vec3 normalizedOr(glm::vec3 v, glm::vec3 fallback) {
    const float squared = glm::dot(v, v);
    return squared > 1e-12f ? v / std::sqrt(squared) : fallback;
}

constexpr float kNever = std::numeric_limits<float>::max(); // cost of an item that is no candidate

// Returns the index of the item with the least cost below the limit, the first of equal ones; -1: none.
template <class Items, class CostOf> int leastCost(const Items& items, float limit, CostOf costOf) {
    int best = -1;
    for (size_t i = 0; i < items.size(); ++i)
        if (const float cost = costOf(items[i]); cost < limit) limit = cost, best = static_cast<int>(i);
    return best;
}

// Position relative to the vertical axis through the player.
struct Place {
    float radius;
    glm::vec3 outward; // unit, level
};
inline Place placeOf(glm::vec3 position) {
    const glm::vec3 flat(position.x, 0, position.z);
    const float radius = glm::length(flat);
    return {radius, radius > 1e-4f ? flat / radius : glm::vec3(0, 0, -1)};
}

inline glm::vec3 limited(glm::vec3 v, float length) {
    const float squared = glm::dot(v, v);
    return squared > length * length ? v * (length / std::sqrt(squared)) : v;
}

// Returns the unit vector to the left of a body that looks along forward with +Y up.
inline glm::vec3 leftOf(glm::vec3 forward) {
    return normalizedOr(glm::cross(kUp, forward), glm::vec3(1, 0, 0));
}

// Turns the heading for a tick towards the unit goal as a body with inertia does, by a critically damped
// spring of rate `eager`, 1/s: the angular velocity (spin, never along forward) does not jump, and at rates
// below the limit the heading does not overshoot. Returns the desired spin.
inline glm::vec3 turnSmoothly(Swimmer& s, glm::vec3 goal, float eager, float max_radps, float max_radps2) {
    const float along = glm::dot(s.forward, goal);
    glm::vec3 axis = glm::cross(s.forward, goal);
    const float sine = glm::length(axis);
    if (sine > 1e-4f)
        axis /= sine;
    else
        axis = along > 0 ? glm::vec3(0) : kUp;
    float angle = sine; // approximated by its sine
    if (along < 0) {
        // Turns about the vertical; if the goal is well behind, a turn already under way keeps its side.
        const glm::vec3 left = leftOf(s.forward);
        const float side = along < -0.5f && std::fabs(s.spin.y) > 0.05f ? s.spin.y : glm::dot(goal, left);
        axis = glm::cross(s.forward, side < 0 ? -left : left);
        angle = 2 - sine;
    }
    const glm::vec3 request = axis * std::min(max_radps, eager * angle);
    s.spin += limited((request - s.spin) * std::min(1.0f, 4 * eager * kDt), max_radps2 * kDt);
    s.spin -= s.forward * glm::dot(s.spin, s.forward);
    s.forward = glm::normalize(s.forward + glm::cross(s.spin, s.forward) * kDt);
    return request;
}

// Limits the pitch of a unit heading: |y| <= maximum, unit length.
inline glm::vec3 levelled(glm::vec3 forward, float maximum) {
    if (std::fabs(forward.y) <= maximum) return forward;
    const glm::vec3 flat = normalizedOr({forward.x, 0, forward.z}, {0, 0, 1});
    const float y = forward.y > 0 ? maximum : -maximum;
    return glm::vec3(flat.x, 0, flat.z) * std::sqrt(1 - maximum * maximum) + glm::vec3(0, y, 0);
}

// Returns worldFromBody: +Z along forward, +Y as upright as bank, the tangent of the left lean, allows.
inline glm::quat bodyTurn(glm::vec3 forward, float bank) {
    const glm::vec3 left = leftOf(forward);
    const glm::vec3 up = glm::normalize(glm::cross(forward, left) + left * bank);
    const glm::vec3 x = glm::normalize(glm::cross(up, forward));
    return glm::normalize(glm::quat_cast(glm::mat3(x, glm::cross(forward, x), forward)));
}

// Interpolates between two rotations the shorter way; good enough for small blends.
inline glm::quat blended(glm::quat from, glm::quat to, float t) {
    if (glm::dot(from, to) < 0) to = -to;
    return glm::normalize(from * (1 - t) + to * t);
}

inline float towards(float value, float goal, float step) {
    return value + std::clamp(goal - value, -step, step);
}

// Returns the value moved towards the goal by the share `rate` times the tick.
inline float eased(float value, float goal, float rate) {
    return value + (goal - value) * std::min(1.0f, rate * kDt);
}

// Puts a swimmer on a circle around the vertical axis through the player, swimming along it; outward is unit
// and level; sense: +1 to the left as seen by a player who looks outward, -1 to the right.
inline void startCircling(Swimmer& s, glm::vec3 position, glm::vec3 outward, float sense, float speed_mps) {
    s.position = position;
    s.forward = glm::cross(kUp, outward) * sense;
    s.speed = speed_mps;
    s.velocity = s.forward * s.speed;
    s.worldFromBody = bodyTurn(s.forward, 0);
}

// Banks a swimmer into its turn: towards `gain` times the yaw rate, at most maxBank, at `rate` 1/s.
inline void bankIntoTurn(Swimmer& s, float gain, float maxBank, float rate) {
    s.bank = eased(s.bank, std::clamp(gain * glm::dot(s.spin, kUp), -maxBank, maxBank), rate);
}

} // namespace shoal::game
