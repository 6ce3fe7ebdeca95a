#include "engine/physics/Grip.h"

#include "engine/physics/ContactModel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::physics {

namespace {

const glm::quat kStill(1, 0, 0, 0);

// Returns the smallest rotation from one direction to another; both unit.
glm::quat arc(glm::vec3 from, glm::vec3 to) {
    const glm::vec3 axis = glm::cross(from, to);
    const glm::quat q(1 + glm::dot(from, to), axis.x, axis.y, axis.z);
    const float squared = glm::dot(q, q);
    return squared > 1e-8f ? q / std::sqrt(squared) : kStill; // opposite directions, which bones never have
}

glm::quat share(const glm::quat& turn, float t) { return glm::normalize(kStill * (1 - t) + turn * t); }

// Returns the corners and edge middles of an icosahedron: 42 directions.
const std::array<glm::vec3, 42>& directions() {
    static const std::array<glm::vec3, 42> all = [] {
        std::array<glm::vec3, 42> d{};
        const float g = std::numbers::phi_v<float>;
        size_t n = 0;
        for (float x : {-1.0f, 1.0f})
            for (float y : {-g, g}) {
                d[n++] = {0, x, y};
                d[n++] = {x, y, 0};
                d[n++] = {y, 0, x};
            }
        for (size_t i = 0; i < 12; ++i)
            for (size_t j = 0; j < i; ++j)
                if (glm::distance(d[i], d[j]) < 2.1f) d[n++] = 0.5f * (d[i] + d[j]); // edges have length 2
        for (glm::vec3& v : d) v = glm::normalize(v);
        return d;
    }();
    return all;
}

// Returns the force along the unit vector d that the presses can exert beyond the need: the support function
// of all forces that they can exert, minus the need's component. A friction cone's edge reaches farthest.
float beyond(std::span<const Press> presses, glm::vec3 need_N, glm::vec3 d) {
    float sum = -glm::dot(need_N, d);
    for (const Press& press : presses) {
        const float along = glm::dot(press.normal, d);
        const float across = std::sqrt(std::max(0.0f, 1 - along * along));
        sum += press.force_N * std::max(0.0f, along + kFriction * across);
    }
    return sum;
}

} // namespace

Finger wrapped(const Finger& given, const Capsule& body) {
    Finger out = given;
    out.turned.fill(kStill);
    out.touches.fill(false);
    std::array<glm::vec3, hands::kMaxFingerJoints> along{}; // unit direction of the bone that ends there
    std::array<float, hands::kMaxFingerJoints> length{};
    for (int i = 1; i < given.count; ++i) {
        const glm::vec3 bone = given.joints[i] - given.joints[i - 1];
        length[i] = glm::length(bone);
        along[i] = length[i] > 1e-6f ? bone / length[i] : (i > 1 ? along[i - 1] : glm::vec3(0, 0, -1));
    }
    glm::quat before = kStill; // rotation of the previous bone
    for (int i = 2; i < given.count; ++i) {
        const glm::quat bend = arc(along[i - 1], along[i]);
        // Turns the straight rest of the finger about this knuckle, by conservative advancement: a step is at
        // most the gap over the rest's length. d(angle)/dt of share() is at most 4 tan(angle / 4).
        float reach = 0;
        for (int j = i; j < given.count; ++j) reach += length[j];
        const float fastest = 4 * std::sqrt(std::max(0.0f, 1 - bend.w) / (1 + std::max(0.0f, bend.w)));
        float t = 0;
        for (int step = 0; step < kAdvances; ++step) {
            const glm::vec3 direction = before * (share(bend, t) * along[i - 1]);
            const glm::vec3 root = out.joints[i - 1];
            float gap = 1, from = 0;
            for (int j = i; j < given.count; ++j) {
                gap = std::min(gap, separation({root + direction * from,
                                                root + direction * (from + length[j]), given.radii[j]},
                                               body));
                from += length[j];
            }
            if (gap <= kTouchGap_m || fastest * reach < 1e-6f) break;
            t += gap / (fastest * reach);
            if (t >= 1) {
                t = 1;
                break;
            }
        }
        const glm::quat here = before * share(bend, t);
        out.joints[i] = out.joints[i - 1] + here * along[i - 1] * length[i];
        before = glm::normalize(here * glm::conjugate(bend));
        out.turned[i] = before;
    }
    for (int i = 2; i < given.count; ++i)
        out.touches[i] = separation({out.joints[i - 1], out.joints[i], given.radii[i]}, body) < kLift_m;
    return out;
}

Hold hold(std::span<const Press> presses, glm::vec3 asked_N) {
    Hold result;
    const glm::vec3 need = -asked_N;
    glm::vec3 worst(0, 1, 0);
    result.margin_N = beyond(presses, need, worst);
    const auto consider = [&](glm::vec3 d) {
        const float value = beyond(presses, need, d);
        if (value >= result.margin_N) return;
        result.margin_N = value;
        worst = d;
    };
    for (const glm::vec3& d : directions()) consider(d);
    // Refines the worst direction by a pattern search with ever smaller steps.
    for (float step = 0.17f; step > 0.01f; step *= 0.5f) {
        const glm::vec3 middle = worst;
        const glm::vec3 pick = std::fabs(middle.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        const glm::vec3 u = glm::normalize(glm::cross(middle, pick)), v = glm::cross(middle, u);
        for (const glm::vec3& side : {u, -u, v, -v}) consider(glm::normalize(middle + side * step));
    }
    result.gives = -worst;
    return result;
}

float pressForce_N(float depth_m) { return std::min(kStiffness_Npm * std::max(0.0f, depth_m), kForceMax_N); }

float mass_kg(float radius_m, float halfLength_m) {
    const float pi = std::numbers::pi_v<float>;
    return kDensity_kgpm3 * pi * radius_m * radius_m * (2 * halfLength_m + 4.0f / 3 * radius_m);
}

} // namespace shoal::physics
