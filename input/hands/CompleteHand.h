// Estimation of all 26 joints of a hand from those that a tracker sends.
#pragma once

#include "input/hands/HandRig.h"

#include <array>
#include <optional>

namespace shoal::hands {

// Metres, device's frame; empty where nothing is known.
using JointPositions = std::array<std::optional<glm::vec3>, kJointCount>;

struct PartialHand {
    int64_t identity = 0;
    std::optional<Side> side;
    glm::vec3 palm{0};
    glm::vec3 normal{0, -1, 0};     // out of the palm; need not be of unit length, nor at a right angle to...
    glm::vec3 direction{0, 0, -1};  // ...the way to the fingers, but not parallel to it
    std::optional<glm::vec3> elbow; // as the joints
    std::optional<float> palmWidth_m;
    std::optional<float> grip, pinch, confidence;
    JointPositions joints; // but the palm
    // Fingertips of which the device does not say whose they are; no finger is then in `joints`.
    std::array<glm::vec3, kFingerCount> looseTips{};
    int looseTipCount = 0;
};

// Checks the hand's side and normal against its finger joints, where those are known: a service that takes
// one hand for the other, or the palm for the back, would bend the fingers backwards. Index to little finger
// run across the palm the way that side and normal say, and fingers bend towards the palm. Corrects what is
// wrong; false where something is wrong and fingers too straight to tell what. The hand has a side.
bool agreesWithJoints(PartialHand& hand);

class HandCompleter {
  public:
    explicit HandCompleter(const HandRig& rig);

    // The joints sent stay where they are; the others are placed by the rig in the hand's own size. Every
    // bone from the foot of a metacarpal to the tip keeps the length that was measured, or else the rig's. A
    // finger of which nothing is sent is as bent as the grip. Same frame as what comes in. side: if the hand
    // has none.
    HandPose complete(const PartialHand& hand, Side side) const;

    // The side that loose fingertips indicate, if they do.
    std::optional<Side> sideOfTips(const PartialHand& hand) const;

  private:
    struct Fit {
        std::array<int, kFingerCount> fingerOfTip{};
        float cost = 0;
    };
    struct Placement; // of the rig's hand where the palm is seen
    Fit fitTips(const PartialHand& hand, Side side) const;
    float sizeOf(const PartialHand& hand) const;
    void placeFinger(int finger, const Placement& placement, std::array<Joint, kJointCount>& joints) const;

    HandRig rig_;
    std::array<HandPose, 2> rest_; // flat, wrist at the origin
};

} // namespace shoal::hands
