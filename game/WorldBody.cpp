// How bodies bend and beat, for those who show them. What swims decides; nothing here moves it.
#include "game/BodyWave.h"
#include "game/Steering.h"
#include "game/World.h"

namespace shoal::game {

namespace {

// A body lies along its own path, and bends before its heading turns: curvature = wished rate of turning over
// speed, times its length. At least so many lengths a second are assumed, or one that hovers would curl up.
constexpr float kSlowest_lps = 1.5f;
constexpr float kMostBend = 0.9f; // radians between head and tail, swimming

float bendFor(float rate_radps, float speed_mps, float length_m, float most) {
    return std::clamp(rate_radps * length_m / std::max(speed_mps, kSlowest_lps * length_m), -most, most);
}

float eased(float value, float goal, float rate) {
    return value + (goal - value) * std::min(1.0f, rate * kDt);
}

// Of a spin: turning to the left, and lifting the head.
float yawOf(glm::vec3 spin) { return glm::dot(spin, kUp); }
float pitchOf(glm::vec3 spin, glm::vec3 forward) { return -glm::dot(spin, leftOf(forward)); }

} // namespace

void World::bendAndBeat(Fish& f, glm::vec3 wishedSpin) {
    const Species& kind = species[f.species];
    BodyShape& shape = f.shape;
    const float beat_Hz = tailBeat_Hz(f.speed, kind.length_m, kind.stride);
    shape.beats += beat_Hz * kDt;
    const float amplitude = f.coasting ? 0.0f : tailAmplitude(f.speed / kind.cruise_mps);
    shape.amplitude = eased(shape.amplitude, amplitude, 8);
    shape.bendUp =
        eased(shape.bendUp, bendFor(pitchOf(wishedSpin, f.forward), f.speed, kind.length_m, 0.35f), 6);
    shape.finsDown = eased(shape.finsDown, 0, 6);

    // The C of a fast start, the tail's stroke back, then as its way bends.
    constexpr float kC_s = 0.07f, kStroke_s = 0.17f, kC = 1.9f, kStroke = -0.7f;
    if (f.flight_s > 0 && f.flight_s < kStroke_s) {
        const float goal = f.flight_s < kC_s ? kC : kStroke;
        shape.bendLeft = towards(shape.bendLeft, goal * f.flightSide, 34 * kDt);
    } else {
        const float goal = bendFor(yawOf(wishedSpin), f.speed, kind.length_m, kMostBend);
        shape.bendLeft = eased(shape.bendLeft, goal, f.mind == Fish::Mind::Dart ? 14.0f : 5.0f);
    }
}

// In a hand: it curls away from the palm, thrashes, gathers strength, thrashes again, each time less.
void World::struggle(Fish& f, const Hand& hand) {
    if (f.held_s == 0) {
        f.struggling = true;
        f.struggle_s = 0.45f;
    } else if ((f.struggle_s -= kDt) <= 0) {
        f.struggling = !f.struggling;
        f.struggle_s = f.struggling ? random.between(0.25f, 0.45f) : random.between(0.15f, 0.35f);
    }
    const float fresh = std::max(0.4f, 1 - 0.35f * f.held_s);
    f.shape.beats += (f.struggling ? 6.0f : 2.0f) * kDt;
    f.shape.amplitude = eased(f.shape.amplitude, f.struggling ? 0.17f * fresh : 0.03f, 25);
    const glm::vec3 outOfPalm = hand.joints[0].orientation * glm::vec3(0, -1, 0);
    const glm::vec3 left = f.worldFromBody * glm::vec3(1, 0, 0), up = f.worldFromBody * kUp;
    const float curl = f.struggling ? 0.9f * fresh : 0.5f;
    f.shape.bendLeft = eased(f.shape.bendLeft, curl * glm::dot(left, outOfPalm), 12);
    f.shape.bendUp = eased(f.shape.bendUp, 0.4f * curl * glm::dot(up, outOfPalm), 12);
    f.shape.finsDown = eased(f.shape.finsDown, 0, 6);
    f.coasting = false;
    f.flight_s = f.flightSide = 0;
    f.spin = glm::vec3(0);
}

// A shark that threatens: back arched, snout raised, pectoral fins lowered, the whole body swinging slowly
// and wide. Johnson & Nelson 1973, "Agonistic display in the gray reef shark".
void World::sharkBendAndBeat(glm::vec3 wishedSpin) {
    const Species& kind = species[shark.species];
    const bool threatens = shark.mind == Shark::Mind::Threaten;
    BodyShape& shape = shark.shape;
    const float beat_Hz = tailBeat_Hz(shark.speed, kind.length_m, kind.stride);
    shape.beats += std::max(beat_Hz, threatens ? 0.5f : 0.0f) * kDt;
    const float amplitude = threatens ? 1.5f * kFullBeat : tailAmplitude(shark.speed / kind.cruise_mps);
    shape.amplitude = eased(shape.amplitude, amplitude, 4);
    shape.bendLeft =
        eased(shape.bendLeft, bendFor(yawOf(wishedSpin), shark.speed, kind.length_m, kMostBend), 3);
    const float pitch = bendFor(pitchOf(wishedSpin, shark.forward), shark.speed, kind.length_m, 0.2f);
    shape.bendUp = eased(shape.bendUp, threatens ? 0.4f : pitch, 5);
    shape.finsDown = eased(shape.finsDown, threatens ? 0.65f : 0.0f, 5);
}

} // namespace shoal::game
