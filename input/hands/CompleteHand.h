// The 26 joints of a hand, with wrist and metacarpals if a tracker sends only its fingers.
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
    std::optional<float> grip, pinch, confidence;
    JointPositions joints; // fingers from their roots to their tips; perhaps wrist and metacarpals, no palm
};

// Corrects a hand's side and normal by its finger joints: if a service takes one hand for the other, or the
// palm for the back, the fingers would bend backwards. Returns false if they disagree and the fingers are too
// straight to tell which is wrong. hand.side must be set.
bool agreesWithJoints(PartialHand& hand);

class HandCompleter {
  public:
    explicit HandCompleter(const HandRig& rig)
        : rig_(rig), rest_{rig.pose(Side::Left, {}, {}), rig.pose(Side::Right, {}, {})} {}

    // Returns the whole hand, in the same frame. Joints that were sent stay where they are; wrist and
    // metacarpals that were not are placed by the rig in the hand's own size. side: used if the hand has
    // none.
    HandPose complete(const PartialHand& hand, Side side) const;

  private:
    float sizeOf(const PartialHand& hand) const;

    HandRig rig_;
    std::array<HandPose, 2> rest_; // flat, wrist at the origin
};

} // namespace shoal::hands
