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
        float share = 0;                     // share of the whole bend; negative if children lie tailwards
    };
    std::vector<Joint> joints; // parents first; empty: the model has no spine
    size_t middle = 0;         // index of the joint that stays in place when the body bends
    glm::vec3 tipInLast{0};    // tip of the tail in the frame of the joint nearest to it
    size_t last = 0;           // index of that joint
    float length_m = 1;        // of the rest pose along z
};

// Finds the longest chain of skin joints, each the parent of the next, along the model's z: at least three
// joints, each step within 45 degrees of the same direction. length_m: extent of the rest pose along z;
// low_m: z of its hind end.
Spine findSpine(const Model&, float length_m, float low_m);

// The tail beat of an animation clip: its frequency, phase and amplitude.
struct TailBeat {
    float perLoop = 1;   // beats (left and right) in one loop: the strongest whole number of them
    float offset = 0;    // share of the loop at which the tail passes the middle, going left
    float amplitude = 0; // half the tail's sweep, in body lengths: the root mean square times sqrt(2)
};
TailBeat measureBeat(const Model&, const Spine&, int animation, Pose& scratch);

// Scales the bend that the clip gave the spine: 0 straightens it, 1 leaves it.
void scaleWave(const Spine&, float factor, Pose&);

// Adds a bend of constant curvature. left, up: angles between the ends of the body, radians (curvature times
// length). Left is the model's +x. The middle joint stays where it is.
void bend(const Spine&, float left, float up, Pose&);

} // namespace shoal::scene
