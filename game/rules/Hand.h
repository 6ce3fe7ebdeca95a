// State of one of the player's hands: its tracked joints, what it touches, what it grasps, and the fingers as
// they rest on a fish. World frame unless a comment says otherwise; metres, seconds.
#pragma once

#include "engine/physics/Capsule.h"
#include "engine/physics/ContactModel.h"
#include "engine/physics/Grip.h"
#include "engine/scene/HandPose.h"
#include "engine/sim/FixedStep.h"
#include "game/rules/Snapshot.h"
#include "game/rules/TickInput.h"

#include <algorithm>
#include <array>

namespace shoal::game {

using Joints = std::array<hands::Joint, hands::kJointCount>;

// Whether the hand is closing, and what it holds.
struct Grasp {
    float firmest = 0;   // strongest grip since the hand was last open
    bool closed = false; // with hysteresis
    int window = 0;      // ticks left to take hold of what is between the fingers
    int holds = -1;      // index of the held fish, -1 none
    int encloses = -1;   // index of the fish its fingers close around: held, or about to be
};

// The fish that the hand reaches for, and the help for the hand to take it; see game/rules/Intent.h.
struct Intent {
    int fish = -1;          // -1: none
    bool inRange = false;   // that fish is taken if the hand closes now
    float unseen_s = 0;     // seconds since the fish was last in range
    bool helps = false;     // the hand has been helped to that fish since the hand began to close
    glm::vec3 movedView{0}; // how far the help has moved the hand, viewer's frame
    float closing_Hz = 0;   // growth of the grip a second, smoothed over about 30 ms
    float fastest_mps = 0;  // greatest speed of the hand since it began to close
    Miss miss = Miss::None; // reason if it takes nothing, decided when the grip closed
};

// Fingers that rest on the fish they close around instead of entering it.
struct FingerWrap {
    Joints shown{}; // the hand's joints, with fingers resting on that fish
    // Offset of each joint, as it rests on the fish, from the joint that the device sees, palm's frame. It is
    // eased, so that no finger jumps when the fist opens.
    struct Lift {
        glm::vec3 move{0};
        glm::quat turn{1, 0, 0, 0};
    };
    std::array<Lift, hands::kJointCount> lifts{};
    // Forces of the fingers on that fish in this tick; the first pressCount count.
    std::array<physics::Press, hands::kJointCount> presses{};
    int pressCount = 0;
};

struct Hand {
    bool visible = false;
    bool known = false;       // lastGood has been set
    hands::HandPose lastGood; // viewer's frame
    int untrackedTicks = 0;
    bool solid = false; // touches and pushes fish
    Joints joints{}, before{};
    std::array<glm::vec3, hands::kJointCount> velocities{}; // joints', smoothed over about 25 ms
    glm::vec3 graspCentre{0};
    glm::vec3 velocity{0};         // velocity of the palm, over the last tick
    glm::vec3 calmVelocity{0};     // the same, smoothed over about 50 ms
    glm::vec3 ownVelocity{0};      // the same relative to the head, without the help's part
    glm::vec3 calmAcceleration{0}; // derivative of calmVelocity, smoothed, m/s2
    float grip = 0;                // 0 open to 1 fist
    std::array<TouchView, hands::kHandParts> touching{}; // felt by each finger and the palm
    Grasp grasp;
    Intent intent;
    FingerWrap fingers;
    Miss lastMiss = Miss::None; // None: it has taken hold since
    float sinceMiss_s = 0;
    float stung_s = 0;     // seconds left in which a stung hand cannot hold
    float rested_s = 0;    // seconds for which it has rested, open and in view
    float nextVisit_s = 0; // seconds before the next fish may come to look at it

    const hands::Joint& palm() const { return joints[hands::kPalmJoint]; }
    glm::vec3 outOfPalm() const { return palm().orientation * glm::vec3(0, -1, 0); }
    // Returns the position in the hand of a fish of that radius, which is capped at physics::kEnclosed_m.
    glm::vec3 hollow(float radius_m) const {
        const float radius = std::min(radius_m, physics::kEnclosed_m);
        return palm().position + palm().orientation * glm::vec3(0, -0.008f - radius, -0.030f);
    }
};
using Hands = std::array<Hand, 2>; // left, right

using hands::kGripCloses, hands::kGripOpens;
// A hand untracked for longer lets go of its fish.
constexpr auto kHandDropTicks = static_cast<int>(hands::kHandLost_s * sim::kTickRate_Hz + 0.5f);

// Returns the finger, or hands::kPalmPart, of the bone from kJointParent[joint] to the joint. The bones of
// the back of the hand belong to the palm.
inline int partOfBone(int joint) {
    const int finger = hands::fingerOfJoint(joint);
    if (finger < 0) return hands::kPalmPart;
    const hands::FingerJoints& joints = hands::kFingerJoints[finger];
    const bool thumb = finger == 0; // the thumb's proximal bone moves on its own
    return joint <= (thumb ? joints.metacarpal : joints.proximal) ? hands::kPalmPart : finger;
}

inline physics::Capsule bone(const std::array<hands::Joint, hands::kJointCount>& joints, int joint) {
    const hands::Joint& from = joints[hands::kJointParent[joint]];
    const hands::Joint& to = joints[joint];
    return {from.position, to.position, std::min(from.radius, to.radius)};
}

// Position and direction of the player's head.
struct Viewpoint {
    glm::quat worldFromView{1, 0, 0, 0};
    glm::vec3 headWorld{0}; // between the eyes

    glm::vec3 ahead() const { return worldFromView * glm::vec3(0, 0, -1); }
};

} // namespace shoal::game
