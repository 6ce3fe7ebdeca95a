// Pose of a tracker relative to the viewer, which maps the hands it sees into the viewer's frame.
#pragma once

#include "engine/scene/HandPose.h"

namespace shoal::hands {

// All device frames here are right-handed, in metres.
//
//   desk    Leap on the desk: x to the right, y up, z towards the player: the viewer's own axes. The hands
//           move in a box around 0.2 m above the device, but fish swim farther off than the desk is wide:
//           the middle of that box is put before the eyes, and distances from it are scaled by kReach. The
//           hands themselves keep their size.
//   head    Leap on a headset, looking ahead: its y points where the viewer looks, its x to the viewer's
//           left and its z down. 0.08 m before the eyes. Nothing is scaled: hands are where they are.
//   camera  A webcam on the screen that looks back at the player: x to the right of its own picture (the
//           player's left), y up, z towards the screen behind it. Distances are scaled as on the desk.
struct Mount {
    glm::quat viewerFromDevice{1, 0, 0, 0};
    glm::vec3 centreDevice_m{0}; // this point of the device's frame...
    glm::vec3 centreViewer_m{0}; // ...is put here
    float reach = 1;             // scale of distances from there

    // In place: from the device's frame to the viewer's. The palm is moved, the hand keeps its size.
    void apply(HandPose& hand) const {
        const glm::vec3 palm = hand.joints[0].position;
        const glm::vec3 placed = centreViewer_m + viewerFromDevice * (palm - centreDevice_m) * reach;
        for (Joint& joint : hand.joints) {
            joint.position = placed + viewerFromDevice * (joint.position - palm);
            joint.orientation = viewerFromDevice * joint.orientation;
        }
    }
};

constexpr float kReach = 1.6f;
const inline Mount kDeskMount{{1, 0, 0, 0}, {0, 0.20f, 0}, {0, -0.12f, -0.75f}, kReach};
// (x, y, z) to (-x, -z, -y): half a turn about the axis between -y and z.
const inline Mount kHeadMount{{0, 0, 0.70710678f, -0.70710678f}, glm::vec3(0), {0, 0, -0.08f}, 1};
// (x, y, z) to (-x, y, -z): half a turn about y. The middle is half a metre before the camera.
const inline Mount kCameraMount{{0, 0, 1, 0}, {0, -0.05f, -0.50f}, {0, -0.12f, -0.75f}, kReach};

} // namespace shoal::hands
