// Simulation state of the fish, the shark and the passing giant (a whale). World frame, metres, seconds.
#pragma once

#include "engine/scene/HandPose.h"
#include "game/rules/Swimmer.h"

#include <array>
#include <cstdint>
#include <tuple>

namespace shoal::game {

// The circle around the player that a fish swims; companions share their leader's.
struct Route {
    int leader = -1; // index of the fish whose route it follows; its own index if it leads
    float radius = 1, height = 0;
    float cruise_mps = 0.3f;
    float direction = 1; // +1 circles to the left of looking outward, -1 to the right
    glm::vec3 wander{0}, wanderGoal{0};
    int wanderTicks = 0;   // ticks until it chooses another direction to wander
    int changeTicks = 0;   // ticks until it chooses another radius and height
    float speedFactor = 1; // factor on the cruising speed: solitary fish linger at times
    bool gliding = false;  // between two bursts of its tail

    void follow(const Route& other) {
        radius = other.radius;
        height = other.height;
        direction = other.direction;
    }
};

// The flight of a frightened fish, and its readiness to be frightened.
struct Flight {
    float left_s = 0;
    float spent_s = 0;          // 0: it does not flee
    float side = 0;             // first turn: +1 left, -1 right
    float rest_s = 0;           // seconds before it can be frightened again
    glm::vec3 heading{0, 0, 1}; // unit
    float touchedGently_s = 0;  // seconds for which it has been touched gently; too long frightens it
};

// How a fish lies and struggles in the hand that holds it.
struct FishHold {
    float time_s = 0;
    bool counted = false; // it has become a catch
    glm::quat palmFromBody{1, 0, 0, 0}, palmFromBodyGoal{1, 0, 0, 0};
    glm::vec3 palmOffset{0}; // offset from the grasp centre, palm's frame
    glm::vec3 slide{0};      // velocity of its slipping, m/s, palm's frame
    float slid_m = 0;        // how far it has slipped since the grip was last firm
    float struggle = 0;      // strength of its wriggling as the hand feels it, 0 to 1
    int unopposed = 0;       // ticks without contacts that hold it from opposing sides
    float noPush_s = 0;      // seconds after the release in which the fingers do not push it
    float bout_s = 0;        // seconds left of the present bout of struggling, or of the rest between two
    bool struggles = false;  // true in a bout, false in a rest
};

// A fish's visit to a resting hand (game/rules/Curiosity.h).
struct Visit {
    int hand = -1; // 0 left, 1 right, -1 none
    float left_s = 0;
    float linger_s = 0; // seconds that it stays in front of the palm
    float rest_s = 0;   // seconds before its next visit
};

struct Fish : Swimmer {
    // Cruise: swims its circle. Dart: flees. Held: in a hand. Mouth: in the shark's mouth.
    enum class State { Cruise, Dart, Held, Mouth };

    int species = 0; // index into the species table
    int school = 0;  // index into DiveFile::schools
    Route route;

    // Velocities added to its own swimming, m/s.
    glm::vec3 push{0};       // caused by hands and neighbours; fades within a second
    glm::vec3 separation{0}; // moves it out of a hand that it overlaps; lasts one tick

    State state = State::Cruise;
    Flight flight;
    // Tick until which a touch is remembered, by hand and by its part (a finger or hands::kPalmPart).
    std::array<std::array<uint32_t, hands::kHandParts>, 2> touchedUntil{};
    float uncatchable_s = 0; // seconds before a hand can take hold of it
    int heldBy = -1;         // 0 left, 1 right, -1 none
    FishHold hold;
    Visit visit;
    // 1 if a hand that closes now takes it, else 0, eased in between. catchableBy: that hand, -1 none.
    float catchable = 0;
    int catchableBy = -1;

    bool free() const { return state != State::Held && state != State::Mouth; }

    auto fields() const {
        return std::tie(static_cast<const Swimmer&>(*this), species, school, route, push, separation, state,
                        flight, touchedUntil, uncatchable_s, heldBy, hold, visit, catchable, catchableBy);
    }
};

struct Shark : Swimmer {
    // Circle: far out. Prowl: visits the player. Threaten: points at a hand. Strike: dashes for the fish in
    // it. Leave: swims out again.
    enum class State { Circle, Prowl, Threaten, Strike, Leave };

    bool present = false;
    int species = -1;
    float direction = 1; // +1 circles to the left of looking outward, -1 to the right
    State state = State::Circle;
    float state_s = 0;      // seconds since the state changed
    float visit_s = 0;      // seconds left of the present visit
    float interest = 0;     // seconds of struggling it has noticed; decays slowly
    uint32_t nextVisit = 0; // index into SharkPlan::visits_s
    int prey = -1;          // index of the fish that it strikes at
    int mouth = -1;         // index of the fish that it carries
    float bumpRest_s = 0;   // seconds before it can bump a hand again
    int watched = -1;       // the threatened hand: 0 left, 1 right
    float aimed_s = 0;      // seconds for which it has pointed at that hand
    float threatRest_s = 0; // seconds before it may threaten again

    auto fields() const {
        return std::tie(static_cast<const Swimmer&>(*this), present, species, direction, state, state_s,
                        visit_s, interest, nextVisit, prey, mouth, bumpRest_s, watched, aimed_s,
                        threatRest_s);
    }

    void set(State next) {
        state = next;
        state_s = 0;
    }
    glm::vec3 mouthPosition(float length_m) const { return position + forward * (0.46f * length_m); }
};

// The giant of the dive's encounter (a whale), which swims past once.
struct Passer : Swimmer {
    enum class State { ToCome, Passing, Gone };

    State state = State::ToCome;

    auto fields() const { return std::tie(static_cast<const Swimmer&>(*this), state); }
};

} // namespace shoal::game
