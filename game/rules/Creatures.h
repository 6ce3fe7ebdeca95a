// States of fish, shark and what passes by. World frame, metres, seconds.
#pragma once

#include "engine/scene/HandPose.h"
#include "game/rules/Swimmer.h"

#include <array>
#include <cstdint>

namespace shoal::game {

struct Fish : Swimmer {
    // Cruise: swims its circle. Dart: flees. Held: in a hand. Mouth: in the shark's mouth.
    enum class State { Cruise, Dart, Held, Mouth };

    int species = 0; // index into the species table
    int school = 0;  // index into DiveFile::schools

    // Route; companions share their leader's.
    int leader = -1; // index of the fish whose route it follows: its own if alone
    float radius = 1, height = 0, cruise = 0.3f;
    float sense = 1; // +1 circles to the left of looking outward, -1 to the right
    glm::vec3 wander{0}, wanderGoal{0};
    int wanderTicks = 0; // until it takes up another way to wander
    int routeTicks = 0;  // until it takes up another radius and height
    float pace = 1;      // of cruising: those who live alone linger at times
    bool coasting = false;

    // Velocities that others gave it, m/s.
    glm::vec3 push{0};    // fades
    glm::vec3 parting{0}; // out of a hand that it overlaps; of this tick alone

    // Fright
    State state = State::Cruise;
    float dart_s = 0;        // time left of the flight
    float flight_s = 0;      // since it took flight; 0 when it does not flee
    float flightSide = 0;    // the side it turned to then: +1 left
    float frightRest_s = 0;  // not frightened anew for so long
    glm::vec3 flee{0, 0, 1}; // unit
    float nervous_s = 0;     // how long it has been touched gently

    // Tick to which a touch by that part of that hand still counts.
    std::array<std::array<uint32_t, hands::kHandParts>, 2> touchedUntil{};

    // In a hand
    float uncatchable_s = 0; // nobody takes hold of it for so long
    int heldBy = -1;         // 0 left, 1 right
    float held_s = 0;
    bool counted = false; // this hold has become a catch
    glm::quat palmFromBody{1, 0, 0, 0}, palmFromBodyGoal{1, 0, 0, 0};
    glm::vec3 palmOffset{0}; // from the grasp centre, palm's frame
    glm::vec3 slide{0};      // m/s, how it slips in the hand, palm's frame
    float slid_m = 0;        // how far it has slipped since the grip was last firm
    float struggle = 0;      // of the last tick, 0 to 1: how hard the hand feels it wriggle
    int unopposed = 0;       // ticks for which nothing has held it from both sides
    float loose_s = 0;       // just let go: it slides out between the fingers, which do not push it
    float struggle_s = 0;    // left of this bout of struggling, or of the rest after it
    bool struggling = false;

    // Of a hand that rests
    int visits = -1;       // the hand that it has come to look at, -1 none
    float visit_s = 0;     // left of the visit...
    float linger_s = 0;    // ...of so long before the palm
    float visitRest_s = 0; // until it may be curious anew

    // 0 to 1, eased: a hand that closes now takes it; and which, -1 none.
    float catchable = 0;
    int catchableBy = -1;

    bool free() const { return state != State::Held && state != State::Mouth; }

    auto fields() const {
        return std::tie(static_cast<const Swimmer&>(*this), species, school, leader, radius, height, cruise,
                        sense, wander, wanderGoal, wanderTicks, routeTicks, pace, coasting, push, parting,
                        state, dart_s, flight_s, flightSide, frightRest_s, flee, nervous_s, touchedUntil,
                        uncatchable_s, heldBy, held_s, counted, palmFromBody, palmFromBodyGoal, palmOffset,
                        slide, slid_m, struggle, unopposed, loose_s, struggle_s, struggling, visits, visit_s,
                        linger_s, visitRest_s, catchable, catchableBy);
    }
};

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

// Of the dive's encounter.
struct Passer : Swimmer {
    enum class State { ToCome, Passing, Gone };

    State state = State::ToCome;

    auto fields() const { return std::tie(static_cast<const Swimmer&>(*this), state); }
};

} // namespace shoal::game
