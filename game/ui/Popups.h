// Points that rise where a fish was caught: "+25 snapper".
#pragma once

#include "game/rules/DiveFile.h"
#include "game/rules/Snapshot.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

namespace shoal::app {

struct Popup {
    int points = 0, combo = 0;
    const game::Species* species = nullptr;
    glm::vec3 position{0}; // world
    float age_s = 0;
};

class Popups {
  public:
    static constexpr float kStay_s = 1.6f;

    Popups() { shown_.reserve(8); }
    // Adds a Catch. species: must outlive the popup.
    void add(const game::Event& event, const game::SpeciesTable& species) {
        if (event.species < 0 || !event.position || shown_.size() == shown_.capacity()) return;
        shown_.push_back(
            {event.points, event.combo, &species[static_cast<size_t>(event.species)], *event.position, 0});
    }
    void advance(float dt_s) {
        for (Popup& popup : shown_) popup.age_s += dt_s;
        std::erase_if(shown_, [](const Popup& popup) { return popup.age_s > kStay_s; });
    }
    std::span<const Popup> shown() const { return shown_; }

  private:
    std::vector<Popup> shown_;
};

} // namespace shoal::app
