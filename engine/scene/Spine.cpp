#include "engine/scene/Spine.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace shoal::scene {

namespace {

constexpr float kCentreOfMass = 0.4f; // share of the length behind the snout, as in most fish
constexpr size_t kMinNodes = 3;

// Returns a joint's matrix in the frame of the first joint's parent; scale plays no part along a spine.
glm::mat4 upTo(const Spine& spine, size_t joint, const Pose& pose) {
    glm::mat4 all(1);
    for (size_t i = 0; i <= joint; ++i) {
        const Transform& local = pose.local[spine.joints[i].node];
        all = glm::translate(all, local.translation) * glm::mat4_cast(local.rotation);
    }
    return all;
}

glm::quat rotationOf(const glm::mat4& m) {
    return glm::quat_cast(glm::mat3(glm::normalize(glm::vec3(m[0])), glm::normalize(glm::vec3(m[1])),
                                    glm::normalize(glm::vec3(m[2]))));
}

glm::vec3 positionOf(const Pose& pose, int node) { return glm::vec3(pose.modelFromNode[node][3]); }

// Returns the longest chain of joints, each the parent of the next, along -z or along +z.
std::vector<int> longestLine(const Model& model, const Pose& pose) {
    std::vector<bool> isJoint(model.nodes.size(), false);
    for (const Skin& skin : model.skins)
        for (const int joint : skin.joints) isJoint[joint] = true;
    const auto along = [&](int node, int child, float direction) {
        const glm::vec3 step = positionOf(pose, child) - positionOf(pose, node);
        return direction * step.z > 0.7f * glm::length(step);
    };
    // Finds the longest chain that starts at each joint, from the leaves up: order has parents first.
    std::vector<int> best;
    for (const float direction : {-1.0f, 1.0f}) {
        std::vector<size_t> steps(model.nodes.size(), 0);
        std::vector<int> next(model.nodes.size(), -1);
        int first = -1;
        for (auto it = model.order.rbegin(); it != model.order.rend(); ++it) {
            const int node = *it;
            if (!isJoint[node]) continue;
            steps[node] = 1;
            for (const int child : model.nodes[node].children) {
                if (!isJoint[child] || !along(node, child, direction) || steps[child] + 1 <= steps[node])
                    continue;
                steps[node] = steps[child] + 1;
                next[node] = child;
            }
            if (first < 0 || steps[node] > steps[first]) first = node;
        }
        std::vector<int> line;
        for (int node = first; node >= 0; node = next[node]) line.push_back(node);
        if (line.size() > best.size()) best = std::move(line);
    }
    return best;
}

} // namespace

Spine findSpine(const Model& model, float length_m, float low_m) {
    Pose pose;
    restPose(model, pose);
    const auto place = [&](int node) { return positionOf(pose, node); };
    const std::vector<int> best = longestLine(model, pose);
    Spine spine;
    spine.length_m = length_m;
    if (best.size() < kMinNodes) return spine;

    const bool tailwards = place(best.back()).z < place(best.front()).z;
    const float high_m = low_m + length_m;
    const float centre_m = high_m - kCentreOfMass * length_m;
    float total = 0;
    for (size_t i = 0; i < best.size(); ++i) {
        Spine::Joint joint{.node = best[i],
                           .rest = model.nodes[best[i]].parentFromNode,
                           .nodeFromModel = glm::conjugate(rotationOf(pose.modelFromNode[best[i]]))};
        // A joint's share is half the length of its two segments; the first, which moves the body, has none.
        const float z = place(best[i]).z;
        const float after =
            i + 1 < best.size() ? std::abs(z - place(best[i + 1]).z) : (tailwards ? z - low_m : high_m - z);
        const float before = i > 0 ? std::abs(z - place(best[i - 1]).z) : 0;
        joint.share = i > 0 ? 0.5f * (before + std::max(after, 0.0f)) : 0;
        total += joint.share;
        spine.joints.push_back(joint);
        if (std::abs(z - centre_m) < std::abs(place(best[spine.middle]).z - centre_m)) spine.middle = i;
    }
    // Left is +x: a rotation about +y moves the part behind the joint to the right.
    for (Spine::Joint& joint : spine.joints) joint.share *= (tailwards ? -1.0f : 1.0f) / total;
    spine.last = tailwards ? best.size() - 1 : 0;
    const glm::mat4& tail = pose.modelFromNode[best[spine.last]];
    spine.tipInLast = glm::vec3(glm::inverse(tail) * glm::vec4(tail[3].x, tail[3].y, low_m, 1));
    return spine;
}

TailBeat measureBeat(const Model& model, const Spine& spine, int animation, Pose& scratch) {
    constexpr int kSamples = 64, kMaxBeats = 8;
    constexpr float kTurn = 2 * std::numbers::pi_v<float>;
    TailBeat beat;
    if (spine.joints.empty()) return beat;
    std::array<float, kSamples> left{};
    const float duration_s = model.animations[animation].duration_s;
    float mean = 0;
    for (int i = 0; i < kSamples; ++i) {
        restPose(model, scratch);
        animate(model, animation, duration_s * static_cast<float>(i) / kSamples, scratch);
        updateGlobals(model, scratch);
        const int tail = spine.joints[spine.last].node;
        left[i] = (scratch.modelFromNode[tail] * glm::vec4(spine.tipInLast, 1)).x;
        mean += left[i] / kSamples;
    }
    float power = 0;
    for (float& x : left) {
        x -= mean;
        power += x * x / kSamples;
    }
    beat.amplitude = std::sqrt(2 * power) / spine.length_m;

    // left(t) = c cos(2 pi n t) + s sin(2 pi n t) for the strongest n: it passes 0, rising, at atan2(-c, s).
    float strongest = 0;
    for (int n = 1; n <= kMaxBeats; ++n) {
        float c = 0, s = 0;
        for (int i = 0; i < kSamples; ++i) {
            const float angle = kTurn * static_cast<float>(n * i) / kSamples;
            c += left[i] * glm::cos(angle);
            s += left[i] * glm::sin(angle);
        }
        if (c * c + s * s <= strongest) continue;
        strongest = c * c + s * s;
        beat.perLoop = static_cast<float>(n);
        beat.offset = std::atan2(-c, s) / (kTurn * static_cast<float>(n));
    }
    return beat;
}

void scaleWave(const Spine& spine, float factor, Pose& pose) {
    for (const Spine::Joint& joint : spine.joints) {
        Transform& local = pose.local[joint.node];
        local.rotation = glm::normalize(glm::slerp(joint.rest.rotation, local.rotation, factor));
        local.translation = glm::mix(joint.rest.translation, local.translation, factor);
    }
}

void bend(const Spine& spine, float left, float up, Pose& pose) {
    if (spine.joints.empty() || (left == 0 && up == 0)) return;
    const glm::mat4 before = upTo(spine, spine.middle, pose);
    // A rotation about +x lifts the part behind the joint, one about +y moves it to the right.
    const glm::vec3 turn(-up, left, 0);
    const float angle = glm::length(turn);
    for (const Spine::Joint& joint : spine.joints) {
        if (joint.share == 0) continue;
        glm::quat& local = pose.local[joint.node].rotation;
        local =
            glm::normalize(local * glm::angleAxis(angle * joint.share, joint.nodeFromModel * (turn / angle)));
    }
    const glm::mat4 after = upTo(spine, spine.middle, pose);
    Transform& root = pose.local[spine.joints[0].node];
    const glm::mat4 corrected = before * glm::inverse(after);
    root.rotation = glm::normalize(glm::quat_cast(corrected) * root.rotation);
    root.translation = glm::vec3(corrected * glm::vec4(root.translation, 1));
}

} // namespace shoal::scene
