// Counts how often the shark takes a fish and bumps a hand in dives, and where it is meanwhile.
#pragma once

#include "engine/math/Quantile.h"
#include "game/rules/Dive.h"
#include "game/rules/SharkBehaviour.h"
#include "game/rules/Swimmer.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace shoal::player {

struct SharkWatch {
    int dives = 0, divesWithLoss = 0, steals = 0, bumps = 0, grabs = 0, threats = 0, strikes = 0;
    double ticks = 0, farther = 0; // farther: from the vertical axis than the median of the free fish
    double roomTicks = 0, fartherWithRoom = 0; // ticks in which the film leaves room farther out
    double near = 0;                 // within kNear_m of the eyes, after it has come there for no strike
    double middleNear = 0;           // of its middle, in no strike
    std::array<double, 5> inState{}; // ticks by Shark::State
    static constexpr float kNear_m = 1;

    void begin() {
        ++dives;
        stole_ = false;
        struck_ = false;
        before_ = game::Shark::State::Circle;
    }

    void see(const game::DiveState& s, const game::Events& events, const game::DiveFile& dive,
             const game::SpeciesTable& species) {
        using game::EventKind;
        using State = game::Shark::State;
        for (const game::Event& event : events) {
            const bool steal = event.kind == EventKind::SharkSteal;
            steals += steal;
            divesWithLoss += steal && !stole_;
            stole_ = stole_ || steal;
            bumps += event.kind == EventKind::SharkBump;
            grabs += event.kind == EventKind::Grab;
        }
        const game::Shark& shark = s.shark;
        threats += shark.state == State::Threaten && before_ != State::Threaten;
        strikes += shark.state == State::Strike && before_ != State::Strike;
        before_ = shark.state;
        ++ticks;
        ++inState[static_cast<size_t>(shark.state)];
        radii_.clear();
        for (const game::Fish& f : s.fish)
            if (f.free()) radii_.push_back(game::placeOf(f.position).radius);
        const float middle = math::median(radii_);
        const bool isFarther = game::placeOf(shark.position).radius > middle;
        farther += isFarther;
        const game::FilmMoment film(dive.space.get(), static_cast<double>(s.tick) / sim::kTickRate_Hz);
        const bool room = game::openRadius(shark.position, {dive, species, s, film}) > middle + 0.3f;
        roomTicks += room;
        fartherWithRoom += room && isFarther;
        const physics::Capsule body = game::capsuleOf(shark, species[shark.species]);
        const glm::vec3 axis = body.b - body.a;
        const float t = std::clamp(-glm::dot(body.a, axis) / glm::dot(axis, axis), 0.0f, 1.0f);
        const bool isNear = glm::length(body.a + axis * t) < kNear_m;
        struck_ = isNear && (struck_ || shark.state == State::Strike);
        near += isNear && !struck_;
        middleNear += shark.state != State::Strike && glm::length(shark.position) < kNear_m;
    }

  private:
    std::vector<float> radii_;
    bool stole_ = false;
    bool struck_ = false; // true from a strike within kNear_m until it is farther away again
    game::Shark::State before_ = game::Shark::State::Circle;
};

} // namespace shoal::player
