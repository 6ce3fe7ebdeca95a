#include "input/hands/OneEuro.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace shoal::hands {

namespace {

// The shorter turn from a to b as axis times angle, in a's frame.
glm::vec3 turnBetween(const glm::quat& a, const glm::quat& b) {
    glm::quat d = glm::conjugate(a) * b;
    if (d.w < 0) d = -d;
    const glm::vec3 v(d.x, d.y, d.z);
    const float sine = glm::length(v);
    if (sine < 1e-7f) return 2.0f * v;
    return v * (2 * std::atan2(sine, d.w) / sine);
}

glm::quat turned(const glm::quat& from, const glm::vec3& turn) {
    const float angle = glm::length(turn);
    if (angle < 1e-7f) return from;
    return glm::normalize(from * glm::angleAxis(angle, turn / angle));
}

} // namespace

float smoothing(float cutoff_Hz, float dt_s) {
    const float r = 2 * std::numbers::pi_v<float> * cutoff_Hz * dt_s;
    return r / (r + 1);
}

void OneEuroPoint::reset(glm::vec3 value) {
    value_ = raw_ = value;
    speed_ = glm::vec3(0);
}

glm::vec3 OneEuroPoint::step(glm::vec3 value, float dt_s) {
    if (!(dt_s > 0)) return value_;
    speed_ += ((value - raw_) / dt_s - speed_) * smoothing(tuning_.speedCutoff_Hz, dt_s);
    raw_ = value;
    const float cutoff_Hz = tuning_.minCutoff_Hz + tuning_.slope * glm::length(speed_);
    return value_ += (value - value_) * smoothing(cutoff_Hz, dt_s);
}

void OneEuroTurn::reset(glm::quat value) {
    value_ = raw_ = value;
    speed_ = glm::vec3(0);
}

glm::quat OneEuroTurn::step(glm::quat value, float dt_s) {
    if (!(dt_s > 0)) return value_;
    speed_ += (turnBetween(raw_, value) / dt_s - speed_) * smoothing(tuning_.speedCutoff_Hz, dt_s);
    raw_ = value;
    const float cutoff_Hz = tuning_.minCutoff_Hz + tuning_.slope * glm::length(speed_);
    return value_ = turned(value_, turnBetween(value_, value) * smoothing(cutoff_Hz, dt_s));
}

} // namespace shoal::hands
