// Poses of two hands, of which the mouse moves one.
#pragma once

#include "input/hands/HandRig.h"

#include <glm/vec2.hpp>

#include <array>
#include <optional>

namespace shoal::hands {

struct MouseInput {
    glm::vec2 cursor{0};     // -1 to 1 across the window, +x right, +y up
    float wheel = 0;         // notches since the last call; positive reaches farther
    float close = 0;         // how far the active hand closes, 0 to 1: a gamepad's trigger does so by degrees
    bool swapHands = false;  // true on the frame the key goes down
    float aspect = 16.f / 9; // width / height
    float fovY = 1.2f;       // radians
    // Distance from the eye to the target under the cursor, metres, if the game helps with depth: the hand
    // moves there smoothly until it has closed, and the wheel changes the distance from there. Empty: only
    // the wheel decides.
    std::optional<float> reach_m;
    float reachHelp = 1; // 0 to 1: share of the way there
};

// Returns the unit ray from the eye through the cursor, viewer's frame.
glm::vec3 rayThroughCursor(const MouseInput&);

class MouseHands {
  public:
    explicit MouseHands(HandRig rig) : rig_(std::move(rig)) {}

    // Returns the left and the right hand; viewer's frame, both tracked. The grasp centre of the active hand
    // lies on the ray through the cursor, kReachMin_m to kReachMax_m away; the other hand rests at the lower
    // edge of the view. dt_s: time since the last call, clamped to 0 .. 0.1.
    const std::array<HandPose, 2>& update(const MouseInput&, float dt_s);

    Side active() const { return active_; }
    void setActive(Side side) { active_ = side; }
    float distance_m() const; // of the active hand from the eye

  private:
    struct Hand {
        std::optional<glm::vec3> grasp; // viewer's frame; empty before the first update
        float closed = 0;               // 0 open to 1
    };
    void followReach(const MouseInput&, float dt_s);

    HandRig rig_;
    Side active_ = Side::Right;
    float distance_m_ = 0.7f;
    float reachSpeed_mps_ = 0; // speed at which the help changes the distance
    float wheel_ = 1;          // factor on the distance
    float wheelRests_s_ = 0;   // time left for which the help leaves the wheel's choice alone
    std::array<Hand, 2> hands_{};
    std::array<HandPose, 2> poses_{};
};

// Returns a hand with its grasp centre at a point (viewer's frame): the forearm comes from the shoulder of
// its side, the palm faces forwards and inwards. closed: 0 to 1. Scripted hands use it too.
HandPose reachingHand(const HandRig&, Side, glm::vec3 grasp, float closed);

} // namespace shoal::hands
