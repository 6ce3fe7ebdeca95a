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
    bool close = false;      // button held: the active hand closes
    float closeTo = 1;       // how far, 0 to 1: a gamepad's trigger closes it by degrees
    bool swapHands = false;  // true on the frame the key goes down
    float aspect = 16.f / 9; // width / height
    float fovY = 1.2f;       // radians
    // Distance from the eye of what the cursor points at, metres, where the game offers help with depth: the
    // hand goes there smoothly until it has closed, and the wheel's word counts from there. Empty: only the
    // wheel decides.
    std::optional<float> reach_m;
    float reachHelp = 1; // 0 to 1: share of the way there
};

// Unit ray from the eye through the cursor, viewer's frame.
glm::vec3 rayThroughCursor(const MouseInput&);

class MouseHands {
  public:
    explicit MouseHands(HandRig rig) : rig_(std::move(rig)) {}

    // dt_s: time since the last call, clamped to 0 .. 0.1. Result: left, right; viewer's frame, both tracked.
    // The grasp centre of the active hand lies on the ray through the cursor, kReachMin_m to kReachMax_m
    // away; the other hand rests at the lower edge of the view.
    const std::array<HandPose, 2>& update(const MouseInput&, float dt_s);

    Side active() const { return active_; }
    void setActive(Side side) { active_ = side; }
    float distance_m() const; // of the active hand from the eye

  private:
    struct Hand {
        glm::vec3 grasp{0}; // viewer's frame
        float closed = 0;   // 0 open to 1
        bool placed = false;
    };
    void followReach(const MouseInput&, float dt_s);

    HandRig rig_;
    Side active_ = Side::Right;
    float distance_m_ = 0.7f;
    float reachSpeed_mps_ = 0; // with which the help changes the distance
    float wheel_ = 1;          // factor on the distance
    float wheelRests_s_ = 0;   // the wheel was just used: its word stands for so long
    std::array<Hand, 2> hands_{};
    std::array<HandPose, 2> poses_{};
};

// Wrist pose and shape that put a hand's grasp centre at a point (viewer's frame): the forearm comes from the
// shoulder of its side, the palm faces forwards and inwards. closed: 0 to 1. Also used by scripted hands.
HandPose reachingHand(const HandRig&, Side, glm::vec3 grasp, float closed);

} // namespace shoal::hands
