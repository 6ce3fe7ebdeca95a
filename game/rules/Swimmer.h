// Position, heading and body shape of something that swims, and how they advance in one tick; fish and shark
// share it. World frame, metres, seconds, radians. No library trigonometry: the state must be the same on
// every machine.
#pragma once

#include "engine/physics/Capsule.h"
#include "engine/sim/FixedStep.h"
#include "game/rules/DiveFile.h"
#include "game/rules/Snapshot.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <tuple>

namespace shoal::game {

constexpr float kDt = sim::kTick_s;

struct Swimmer {
    glm::vec3 position{0};      // middle of the body
    glm::vec3 forward{0, 0, 1}; // unit
    glm::vec3 spin{0};          // angular velocity of forward, rad/s
    float bank = 0;             // tangent of the lean to the left
    float speed = 0;            // along forward
    glm::vec3 velocity{0};      // over the last tick, in all
    glm::quat worldFromBody{1, 0, 0, 0};
    Gait gait;
    BodyShape shape;

    auto fields() const {
        return std::tie(position, forward, spin, bank, speed, velocity, worldFromBody, gait, shape);
    }
};

// The body's collision shape, no thicker than maxRadius_m.
physics::Capsule capsuleOf(const Swimmer&, const Species&, float maxRadius_m = 1);

// Puts it on a circle around the vertical axis through the player, swimming along it; outward is unit and
// level; sense +1 circles to the left of looking outward, -1 to the right.
void startCircling(Swimmer&, glm::vec3 position, glm::vec3 outward, float sense, float speed_mps);

// Banks into the turn under way: towards `gain` times the yaw rate, at most maxBank, at `rate` 1/s.
void bankIntoTurn(Swimmer&, float gain, float maxBank, float rate);

// Moves a value towards a goal by the share `rate` times the tick.
float eased(float value, float goal, float rate);

// Curvature times length of a body that lies along its path: turning to the left, and lifting the head, for
// the spin that it strives for; it bends before its heading turns.
float bendLeftFor(const Swimmer&, glm::vec3 desiredSpin, float length_m, float maximum);
float bendUpFor(const Swimmer&, glm::vec3 desiredSpin, float length_m, float maximum);
constexpr float kMaxBendLeft = 0.9f; // radians between head and tail, swimming

// Muscles of small fish twitch faster (Wardle 1975, "Limit of fish swimming speed"); displays show no more.
constexpr float kFastestBeat_Hz = 12;
constexpr float kFullBeat = 0.1f; // half the tail's sweep at speed, body lengths: Bainbridge 1958

// Beats a second. A fish moves on by the same part of its length, its stride, with every beat, however fast
// it swims: Bainbridge 1958, "The speed of swimming of fish as related to size and to the frequency and
// amplitude of the tail beat" (0.6 to 0.75 of the length in dace, trout and goldfish).
inline float tailBeat_Hz(float speed_mps, float length_m, float stride) {
    return std::min(kFastestBeat_Hz, speed_mps / (stride * length_m));
}

// Half the tail's sweep in body lengths; pace: speed against the cruising speed. It grows with speed while
// that is low and hardly at all when it is high (Bainbridge 1958): a saturating curve.
inline float tailAmplitude(float pace) { return kFullBeat * pace / (pace + 0.3f); }

// Beats the tail at least minBeat_Hz, for its speed and stride.
void beatTail(Swimmer&, const Species&, float minBeat_Hz = 0);

} // namespace shoal::game
