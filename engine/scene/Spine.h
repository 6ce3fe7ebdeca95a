// The chain of joints along a fish's body, found in any skinned model; its tail beat, measured in an
// animation; and bends added to a pose.
#pragma once

#include "engine/scene/Model.h"

#include <vector>

namespace shoal::scene {

struct Spine {
    struct Joint {
        int node = -1;
        Transform rest;                      // parentFromNode
        glm::quat nodeFromModel{1, 0, 0, 0}; // at rest
        float share = 0;                     // of the whole bend, with the sign of its children's side
    };
    std::vector<Joint> joints; // parents first; empty: the model has no spine
    size_t middle = 0;         // joint that keeps its place and heading when the body bends
    glm::vec3 tipInLast{0};    // tip of the tail in the frame of the joint nearest to it
    size_t last = 0;           // that joint
    float length_m = 1;        // of the rest pose along z
};

// Finds the longest line of a skin's joints, each the parent of the next, that runs along the model's z:
// three or more, each step within 45 degrees of it, all one way. length_m, low_m: extent of the rest pose
// along z and its hind end.
Spine findSpine(const Model&, float length_m, float low_m);

// A clip's body wave: its phase in the loop, and how far it swings the tail.
struct TailBeat {
    float perLoop = 1;   // beats (left and right) in one loop: the strongest whole number of them
    float offset = 0;    // of the loop: where the tail passes the middle, going left
    float amplitude = 0; // half the tail's sweep, in body lengths: root mean square times the root of two
};
TailBeat measureBeat(const Model&, const Spine&, int animation, Pose& scratch);

// Scales the bend that the clip gave the spine: 0 straightens it, 1 leaves it.
void scaleWave(const Spine&, float factor, Pose&);

// Adds a curve of even curvature. Both are angles between the ends of the body, radians: curvature times
// length. Left is the model's +x. The middle joint stays where it is.
void bend(const Spine&, float left, float up, Pose&);

} // namespace shoal::scene
