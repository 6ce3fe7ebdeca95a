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

namespace shoal::game {

constexpr float kDt = sim::kTick_s;

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
};

// The body's collision shape, no thicker than maxRadius_m.
physics::Capsule capsuleOf(const Swimmer&, const Species&, float maxRadius_m = 1);

// Puts a swimmer on a circle around the vertical axis through the player, swimming along it; outward is unit
// and level; sense: +1 to the left as seen by a player who looks outward, -1 to the right.
void startCircling(Swimmer&, glm::vec3 position, glm::vec3 outward, float sense, float speed_mps);

// Banks a swimmer into its turn: towards `gain` times the yaw rate, at most maxBank, at `rate` 1/s.
void bankIntoTurn(Swimmer&, float gain, float maxBank, float rate);

// Returns the value moved towards the goal by the share `rate` times the tick.
float eased(float value, float goal, float rate);

// Returns the angle between head and tail, radians, of a body bent along its path, for the desired turning
// rate about one axis. The body bends before its heading turns.
float bendFor(const Swimmer&, float rate_radps, float length_m, float maximum);
constexpr float kMaxBendLeft = 0.9f; // radians between head and tail, swimming

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
void beatTail(Swimmer&, const Species&, float minBeat_Hz = 0);

} // namespace shoal::game
