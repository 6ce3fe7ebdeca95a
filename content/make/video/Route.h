// The camera's path: a closed curve near given places, at constant speed.
#pragma once

#include "content/make/video/Scene.h"

namespace shoal::reef {

class Route {
  public:
    explicit Route(const std::vector<vec3>& places);
    vec3 at(float turn) const; // turn: laps, of any value; whole numbers are the start
    float distanceTo(const vec3& p) const;
    float length() const { return length_; }

  private:
    std::vector<vec3> points_; // evenly spaced
    float length_ = 0;
};

} // namespace shoal::reef
