#include "game/rules/Holding.h"

#include "engine/math/Trigonometry.h"
#include "engine/physics/ContactModel.h"
#include "game/rules/Steering.h"

#include <algorithm>

namespace shoal::game {

float tired(float held_s) { return std::max(physics::kTiredOut, 1 - physics::kTires_Hz * held_s); }

float tailBeat(const Fish& f) { return math::sine(f.hold.time_s * physics::kBeat_radps); }

void easeFingers(Hand& hand) {
    const glm::quat palm = hand.palm().orientation, palmFromWorld = glm::conjugate(palm);
    for (int j = 0; j < hands::kJointCount; ++j) {
        const hands::Joint& seen = hand.joints[j];
        hands::Joint& shown = hand.fingers.shown[j];
        FingerWrap::Lift& lift = hand.fingers.lifts[j];
        const glm::vec3 move = palmFromWorld * (shown.position - seen.position);
        const glm::quat turn = palmFromWorld * shown.orientation * glm::conjugate(seen.orientation) * palm;
        lift.move += (move - lift.move) * physics::kEase;
        lift.turn = blended(lift.turn, turn, physics::kEase);
        shown.position = seen.position + palm * lift.move;
        shown.orientation = palm * lift.turn * palmFromWorld * seen.orientation;
    }
}

void followHands(const Hands& hands, std::span<Fish> fish) {
    for (const Hand& hand : hands) {
        if (hand.grasp.holds < 0) continue;
        Fish& f = fish[hand.grasp.holds];
        const glm::quat palm = hand.palm().orientation;
        const glm::vec3 was = f.position;
        // The tail beats at 4 Hz, strongest at first.
        const float beat = tailBeat(f) * (0.3f * tired(f.hold.time_s));
        const glm::quat wriggle(1, 0, 0.5f * beat, 0.2f * beat);
        const float settle = std::min(1.0f, f.hold.time_s / physics::kSettle_s);
        f.worldFromBody =
            glm::normalize(palm * blended(f.hold.palmFromBody, f.hold.palmFromBodyGoal, settle) * wriggle);
        f.position =
            hand.graspCentre + palm * (f.hold.palmOffset + glm::vec3(0.012f * beat, 0, 0.02f * beat));
        f.forward = f.worldFromBody * glm::vec3(0, 0, 1);
        f.velocity = (f.position - was) / kDt;
    }
}

void struggle(Fish& f, const Hand& hand, Random& random) {
    if (f.hold.time_s == 0) {
        f.hold.struggles = true;
        f.hold.bout_s = 0.45f;
    } else if ((f.hold.bout_s -= kDt) <= 0) {
        f.hold.struggles = !f.hold.struggles;
        f.hold.bout_s = f.hold.struggles ? random.between(0.25f, 0.45f) : random.between(0.15f, 0.35f);
    }
    const float fresh = std::max(0.4f, 1 - 0.35f * f.hold.time_s);
    f.shape.beats += (f.hold.struggles ? 6.0f : 2.0f) * kDt;
    f.shape.amplitude = eased(f.shape.amplitude, f.hold.struggles ? 0.17f * fresh : 0.03f, 25);
    const glm::vec3 left = f.worldFromBody * glm::vec3(1, 0, 0), up = f.worldFromBody * kUp;
    const float curl = f.hold.struggles ? 0.9f * fresh : 0.5f;
    f.shape.bendLeft = eased(f.shape.bendLeft, curl * glm::dot(left, hand.outOfPalm()), 12);
    f.shape.bendUp = eased(f.shape.bendUp, 0.4f * curl * glm::dot(up, hand.outOfPalm()), 12);
    f.shape.finsDown = eased(f.shape.finsDown, 0, 6);
    f.route.gliding = false;
    f.flight.spent_s = f.flight.side = 0;
    f.spin = glm::vec3(0);
}

} // namespace shoal::game
