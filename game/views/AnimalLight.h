// What light the animals have beyond that of the camera's place, from the rock near them: followed for each
// animal over time. The rendering thread.
#pragma once

#include "engine/depth/LightBeside.h"
#include "game/rules/Snapshot.h"

#include <glm/mat3x3.hpp>

#include <vector>

namespace shoal::app {

class AnimalLight {
  public:
    // Once for each picture; null: a film whose distances are not known. A few animals are looked at anew
    // each time, by turns, and all follow what was found with a time constant of 0.25 s. Allocates nothing
    // once it has grown.
    void follow(const game::Snapshot& snapshot, const depth::LightBeside* light,
                const glm::mat3& envFromWorld);

    // By place in Snapshot::creatures. Null: the camera's light alone.
    const depth::LightHarmonics* of(size_t creature) const {
        return creature < animals_.size() ? &animals_[creature].now : nullptr;
    }

  private:
    struct Animal {
        glm::vec3 position{0};
        depth::LightHarmonics found{}, now{};
    };
    std::vector<Animal> animals_;
    size_t next_ = 0; // whose turn it is
    double time_s_ = 0;
};

} // namespace shoal::app
