// The one-euro filter: a low-pass whose cut-off grows with speed, so that a still hand does not tremble and a
// moving one does not lag. Casiez, Roussel, Vogel 2012, "1 Euro Filter: A Simple Speed-based Low-pass Filter
// for Noisy Input in Interactive Systems", algorithm 1.
#pragma once

#include "input/hands/HandTuning.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace shoal::hands {

// Share of the way to a new value that a first-order low-pass goes in dt_s. Equations 3 to 5 there.
float smoothing(float cutoff_Hz, float dt_s);

// Of a point. Departs from the paper in one thing: the three coordinates share the cut-off that follows from
// the length of their speed, so that a motion's direction is kept.
class OneEuroPoint {
  public:
    explicit OneEuroPoint(const OneEuroTuning& tuning) : tuning_(tuning) {}
    void reset(glm::vec3 value);
    glm::vec3 step(glm::vec3 value, float dt_s); // dt_s <= 0: nothing new
    glm::vec3 value() const { return value_; }

  private:
    OneEuroTuning tuning_;
    glm::vec3 value_{0}, raw_{0}, speed_{0}; // speed in m/s, itself low-passed
};

// The same of a unit quaternion: the way is the great arc, the speed an angular one.
class OneEuroTurn {
  public:
    explicit OneEuroTurn(const OneEuroTuning& tuning) : tuning_(tuning) {}
    void reset(glm::quat value);
    glm::quat step(glm::quat value, float dt_s);
    glm::quat value() const { return value_; }

  private:
    OneEuroTuning tuning_;
    glm::quat value_{1, 0, 0, 0}, raw_{1, 0, 0, 0};
    glm::vec3 speed_{0}; // rad/s, in the turning frame
};

} // namespace shoal::hands
