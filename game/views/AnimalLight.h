// Difference between the light at each animal and the light at the camera, caused by rock near the animal,
// smoothed over time. Only on the rendering thread.
#pragma once

#include "engine/depth/LightDifference.h"
#include "game/rules/Snapshot.h"

#include <glm/mat3x3.hpp>

#include <vector>

namespace shoal::app {

class AnimalLight {
  public:
    // Updates the light of all animals, once for each picture. Each call looks up the light of a few animals
    // in turn; the light of all eases towards their last look-up with a time constant of 0.25 s. light: null
    // for a film without distances. Allocates nothing once it has grown.
    void follow(const game::Snapshot& snapshot, const depth::LightDifference* light,
                const glm::mat3& envFromWorld);

    // Returns the light by index in Snapshot::creatures; null: only the camera's light.
    const depth::LightHarmonics* of(size_t creature) const {
        return creature < animals_.size() ? &animals_[creature].now : nullptr;
    }

  private:
    struct Animal {
        glm::vec3 position{0};
        depth::LightHarmonics found{}, now{};
    };
    std::vector<Animal> animals_;
    size_t next_ = 0; // index of the next animal to look up
    double time_s_ = 0;
};

} // namespace shoal::app
