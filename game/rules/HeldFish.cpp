#include "game/rules/HeldFish.h"

#include "engine/math/Sine.h"
#include "engine/physics/ContactModel.h"
#include "game/rules/Bones.h"
#include "game/rules/FingerWrap.h"
#include "game/rules/Steering.h"

#include <algorithm>

namespace shoal::game {

namespace {

// How hard it struggles, having been held for so long; 1 at first.
float tired(float held_s) { return std::max(physics::kTiredOut, 1 - physics::kTires_Hz * held_s); }

// The beat of its tail, -1 to 1.
float tailBeat(const Fish& f) { return math::sine(f.held_s * physics::kBeat_radps); }

// The force that a held fish asks of the grip.
glm::vec3 askedForce_N(Fish& f, const Species& kind, const Hand& hand) {
    const float mass = physics::mass_kg(kind.bodyRadius_m, kind.bodyHalf_m);
    const float beat = tailBeat(f);
    f.struggle = tired(f.held_s) * (0.6f + 0.4f * beat);
    const glm::vec3 thrust =
        (f.forward + 0.5f * beat * leftOf(f.forward)) * (mass * physics::kStruggle_mps2 * f.struggle);
    const float side = 2 * kind.bodyRadius_m * 2 * (kind.bodyHalf_m + kind.bodyRadius_m);
    const glm::vec3 drag = hand.calmVelocity * (0.5f * physics::kWater_kgpm3 * physics::kDragShape * side *
                                                glm::length(hand.calmVelocity));
    return thrust - drag - mass * hand.calmAcceleration;
}

} // namespace

void followHands(const Hands& hands, std::span<Fish> fish) {
    for (const Hand& hand : hands) {
        if (hand.grasp.holds < 0) continue;
        Fish& f = fish[hand.grasp.holds];
        const glm::quat palm = hand.palm().orientation;
        const glm::vec3 was = f.position;
        // A beat of 4 Hz, strongest at first.
        const float beat = tailBeat(f) * (0.3f * tired(f.held_s));
        const glm::quat wriggle(1, 0, 0.5f * beat, 0.2f * beat);
        const float settle = std::min(1.0f, f.held_s / physics::kSettle_s);
        f.worldFromBody =
            glm::normalize(palm * blended(f.palmFromBody, f.palmFromBodyGoal, settle) * wriggle);
        f.position = hand.graspCentre + palm * (f.palmOffset + glm::vec3(0.012f * beat, 0, 0.02f * beat));
        f.forward = f.worldFromBody * glm::vec3(0, 0, 1);
        f.velocity = (f.position - was) / kDt;
    }
}

void struggle(Fish& f, const Hand& hand, Random& random) {
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
    const glm::vec3 left = f.worldFromBody * glm::vec3(1, 0, 0), up = f.worldFromBody * kUp;
    const float curl = f.struggling ? 0.9f * fresh : 0.5f;
    f.shape.bendLeft = eased(f.shape.bendLeft, curl * glm::dot(left, hand.outOfPalm()), 12);
    f.shape.bendUp = eased(f.shape.bendUp, 0.4f * curl * glm::dot(up, hand.outOfPalm()), 12);
    f.shape.finsDown = eased(f.shape.finsDown, 0, 6);
    f.coasting = false;
    f.flight_s = f.flightSide = 0;
    f.spin = glm::vec3(0);
}

bool keepsHold(Fish& f, int id, const Species& kind, const Hands& hands, int h,
               std::span<const physics::Contact> contacts) {
    const Hand& hand = hands[h];
    const glm::quat palmFromWorld = glm::conjugate(hand.palm().orientation);

    // Into the hollow of the hand at first; then friction keeps it where it lies.
    if (f.held_s < physics::kSettle_s)
        f.palmOffset +=
            (palmFromWorld * (hollowOf(hand.palm(), std::min(kind.bodyRadius_m, physics::kEnclosed_m)) -
                              hand.graspCentre) -
             f.palmOffset) *
            (20 * kDt);

    const physics::Hold hold = holdOn(id, hands, contacts, askedForce_N(f, kind, hand));
    if (hold.margin_N < 0) {
        const float mass = physics::mass_kg(kind.bodyRadius_m, kind.bodyHalf_m);
        f.slide += palmFromWorld * hold.gives * (-hold.margin_N / mass * kDt);
        f.slide = limited(f.slide, physics::kSlideMax_mps);
    } else {
        f.slide *= physics::kSlideGrip;
        if (glm::dot(f.slide, f.slide) < 1e-6f) f.slid_m = 0;
    }
    f.palmOffset += f.slide * kDt;
    f.slid_m += glm::length(f.slide) * kDt;
    const bool opposed = holdOn(id, hands, contacts, glm::vec3(0)).margin_N > 0;
    f.unopposed = opposed ? 0 : f.unopposed + 1;
    return f.slid_m < physics::kSlideOut_m && f.unopposed < physics::kUnopposed;
}

} // namespace shoal::game
