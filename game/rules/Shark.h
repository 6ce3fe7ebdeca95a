// State of the shark. World frame, metres, seconds.
#pragma once

#include "game/rules/Swimmer.h"

#include <cstdint>

namespace shoal::game {

struct Shark : Swimmer {
    // Circle: far out. Prowl: visits the player. Threaten: points at a hand. Strike: dashes for the fish in
    // it. Leave: swims out again.
    enum class State { Circle, Prowl, Threaten, Strike, Leave };

    bool present = false;
    int species = -1;
    float sense = 1; // +1 circles to the left of looking outward, -1 to the right
    State state = State::Circle;
    float state_s = 0;      // since it changed
    float visit_s = 0;      // left of the present visit
    float interest = 0;     // grows while a fish struggles
    uint32_t nextVisit = 0; // index into SharkPlan::visits_s
    int prey = -1;          // fish that it strikes at
    int mouth = -1;         // fish that it carries
    float bumpRest_s = 0;   // bumps no hand anew for so long
    int watched = -1;       // hand that it threatens
    float aimed_s = 0;      // how long it has pointed at that hand
    float threatRest_s = 0; // until it may threaten anew

    auto fields() const {
        return std::tie(static_cast<const Swimmer&>(*this), present, species, sense, state, state_s, visit_s,
                        interest, nextVisit, prey, mouth, bumpRest_s, watched, aimed_s, threatRest_s);
    }

    void set(State next) {
        state = next;
        state_s = 0;
    }
    glm::vec3 mouthPosition(float length_m) const { return position + forward * (0.46f * length_m); }
};

} // namespace shoal::game
