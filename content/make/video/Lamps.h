// Spotlights under water: how much of their light arrives at a place, and the things that are seen of them.
#pragma once

#include "content/make/video/Mesh.h"

#include <array>
#include <functional>

namespace shoal::reef {

class Lamps {
  public:
    static constexpr float kReach = 14; // metres: beyond it the water leaves nothing
    struct Arriving {
        vec3 irradiance{0}; // on a plane that faces the lamp
        vec3 toLamp{0};     // unit
    };
    // The few that light one place.
    class List {
      public:
        void add(const Arriving& light) {
            if (count_ < all_.size()) all_[count_++] = light;
        }
        const Arriving* begin() const { return all_.data(); }
        const Arriving* end() const { return all_.data() + count_; }

      private:
        std::array<Arriving, 6> all_;
        size_t count_ = 0;
    };

    Lamps() = default;
    // distance: to the first thing from a place in a direction, at most kReach. Lamps that the camera carries
    // cast no shadows: they would lie behind what casts them.
    Lamps(const std::vector<Lamp>& lamps, const Water& water,
          const std::function<float(const vec3& origin, const vec3& dir)>& distance);
    void carry(const vec3& camera);
    List at(const vec3& p) const;

  private:
    struct Set {
        Lamp lamp;
        vec3 place{0};
        glm::mat3 lampFromWorld{1}; // z along its axis
        float halfWidth = 1;        // of its picture at z = 1
        std::vector<float> reach;   // distances to what it lights first; empty: no shadows
    };
    float lit(const Set& set, const vec3& inLamp, float distance) const;

    Water water_;
    std::vector<Set> sets_;
};

// Housing and glass.
Mesh makeLamp(const Lamp& lamp);

} // namespace shoal::reef
