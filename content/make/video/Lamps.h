// Spotlights under water: the light that arrives from them at a place, and the meshes of their housings.
#pragma once

#include "content/make/video/Mesh.h"

#include <array>
#include <functional>

namespace shoal::reef {

class Lamps {
  public:
    static constexpr float kReach = 14; // metres; the water absorbs all light beyond
    struct Arriving {
        vec3 irradiance{0}; // on a plane that faces the lamp
        vec3 toLamp{0};     // unit
    };
    // Light of the few lamps that reach one place.
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
    // distance: returns the distance from a place to the first surface in a direction, at most kReach. Lamps
    // that the camera carries cast no shadows: objects would hide these from the camera.
    Lamps(const std::vector<Lamp>& lamps, const Water& water,
          const std::function<float(const vec3& origin, const vec3& dir)>& distance);
    void carry(const vec3& camera);
    List at(const vec3& p) const;

  private:
    struct Set {
        Lamp lamp;
        vec3 place{0};
        glm::mat3 lampFromWorld{1}; // z along the lamp's axis
        float halfWidth = 1;        // of the shadow map at z = 1
        std::vector<float> reach;   // shadow map: distances to the first surface; empty: no shadows
    };
    float lit(const Set& set, const vec3& inLamp, float distance) const;

    Water water_;
    std::vector<Set> sets_;
};

// Returns the lamp's housing and glass.
Mesh makeLamp(const Lamp& lamp);

} // namespace shoal::reef
