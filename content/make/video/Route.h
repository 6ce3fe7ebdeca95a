// The camera's way: a closed curve through given places, at an even pace.
#pragma once

#include "content/make/video/Scene.h"

namespace shoal::reef {

class Route {
  public:
    explicit Route(const std::vector<vec3>& places);
    vec3 at(float turn) const; // turn: any, whole numbers are the start
    float distanceTo(const vec3& p) const;
    float length() const { return length_; }

  private:
    std::vector<vec3> points_; // evenly spaced
    float length_ = 0;
};

} // namespace shoal::reef
