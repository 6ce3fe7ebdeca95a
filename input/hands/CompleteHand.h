// Estimation of all 26 joints of a hand from those that a tracker sends.
#pragma once

#include "input/hands/HandRig.h"

#include <array>
#include <optional>

namespace shoal::hands {

// Positions of a hand's joints, metres, device's frame; empty where unknown.
using JointPositions = std::array<std::optional<glm::vec3>, kJointCount>;

struct PartialHand {
    int64_t identity = 0;
    std::optional<Side> side;
    glm::vec3 palm{0};
    glm::vec3 normal{0, -1, 0};     // out of the palm, of any length
    glm::vec3 direction{0, 0, -1};  // to the fingers, of any length, not parallel to the normal
    std::optional<glm::vec3> elbow; // metres, device's frame
    std::optional<float> palmWidth_m;
    std::optional<float> grip, pinch, confidence;
    JointPositions joints; // all but the palm
    // Fingertips whose finger the device does not tell; no finger is then in `joints`.
    std::array<glm::vec3, kFingerCount> looseTips{};
    int looseTipCount = 0;
};

// Corrects a hand's side and normal by its finger joints, where those are known: if a service takes one hand
// for the other, or the palm for the back, the fingers would bend backwards. Returns false if they disagree
// and the fingers are too straight to tell which is wrong. hand.side must be set.
bool agreesWithJoints(PartialHand& hand);

class HandCompleter {
  public:
    explicit HandCompleter(const HandRig& rig)
        : rig_(rig), rest_{rig.pose(Side::Left, {}, {}), rig.pose(Side::Right, {}, {})} {}

    // Returns the whole hand, in the same frame. Joints that were sent stay where they are; the others are
    // placed by the rig in the hand's own size. A finger of which nothing was sent is as bent as the grip.
    // side: used if the hand has none.
    HandPose complete(const PartialHand& hand, Side side) const;

    // Returns the side that a hand's loose fingertips indicate; empty if they do not tell.
    std::optional<Side> sideOfTips(const PartialHand& hand) const;

  private:
    struct Fit {
        std::array<int, kFingerCount> fingerOfTip{};
        float cost = 0;
    };
    struct Placement; // the rig's hand placed at the palm that is seen
    Fit fitTips(const PartialHand& hand, Side side) const;
    float sizeOf(const PartialHand& hand) const;
    void placeFinger(int finger, const Placement& placement, std::array<Joint, kJointCount>& joints) const;

    HandRig rig_;
    std::array<HandPose, 2> rest_; // flat, wrist at the origin
};

} // namespace shoal::hands
