// The state of a dive, and the form in which the rules of a tick read it. World frame unless a comment says
// otherwise; metres, seconds.
#pragma once

#include "engine/core/Random.h"
#include "engine/physics/Contact.h"
#include "engine/physics/ContactModel.h"
#include "engine/physics/Grip.h"
#include "engine/scene/HandPose.h"
#include "game/rules/FilmSpace.h"
#include "game/rules/Swimmer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace shoal::game {

// Fish, shark and the passing giant (a whale).

// The circle around the player that a fish swims; companions share their leader's.
struct Route {
    int leader = -1; // index of the fish whose route it follows; its own index if it leads
    float radius = 1, height = 0;
    float cruise_mps = 0.3f;
    float direction = 1; // +1: circles to the left for a player who looks at it, -1: to the right
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

// A fish's visit to a resting hand (chooseVisitors()).
struct Visit {
    int hand = -1; // 0 left, 1 right, -1 none
    float left_s = 0;
    float linger_s = 0; // seconds that it stays in front of the palm
    float rest_s = 0;   // seconds before its next visit
};

// The state of a loose thing beyond that of all that can be taken; see game/rules/Things.h.
struct LooseState {
    glm::vec3 home{0};   // where it drifts on seaweed, or comes up
    float time_s = 0;    // since it was let go; of a bottle out of sight: until it comes up
    bool thrown = false; // by a hand, and has struck nothing yet
    bool spent = false;  // a mussel that was cracked
};

// A fish, or a loose thing: all that a hand can take hold of.
struct Fish : Swimmer {
    // Cruise: swims its circle. Dart: flees. Held: in a hand. Shown: caught, it turns to the player before it
    // swims off. Mouth: in the shark's mouth. And loose things:
    // Drift: hangs on seaweed. Loose: moved by the physics world; its velocity is `push`. Gone: out of sight.
    enum class State { Cruise, Dart, Held, Shown, Mouth, Drift, Loose, Gone };

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
    LooseState loose;
    float catchable = 0;  // see CreatureView::catchable
    int catchableBy = -1; // the hand that takes it then: 0 left, 1 right, -1 none

    bool swims() const { return state == State::Cruise || state == State::Dart; }
    bool free() const { return swims() || state == State::Drift || state == State::Loose; }

    auto fields() const {
        return std::tie(static_cast<const Swimmer&>(*this), species, school, route, push, separation, state,
                        flight, touchedUntil, uncatchable_s, heldBy, hold, visit, loose, catchable,
                        catchableBy);
    }
};

struct Shark : Swimmer {
    // Circle: far out. Prowl: visits the player. Threaten: points at a hand. Strike: dashes for the fish in
    // it. Leave: swims out again.
    enum class State { Circle, Prowl, Threaten, Strike, Leave };

    bool present = false;
    int species = -1;
    float direction = 1; // +1: circles to the left for a player who looks at it, -1: to the right
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
    float warned_s = 0;     // seconds since it began to threaten

    auto fields() const {
        return std::tie(static_cast<const Swimmer&>(*this), present, species, direction, state, state_s,
                        visit_s, interest, nextVisit, prey, mouth, bumpRest_s, watched, aimed_s, threatRest_s,
                        warned_s);
    }

    bool aims() const { return state == State::Threaten || state == State::Strike; } // at a hand

    void set(State next) {
        state = next;
        state_s = 0;
    }
};

// The giant of the dive's encounter (a whale), which swims past once.
struct Giant : Swimmer {
    enum class State { ToCome, Passing, Gone };

    State state = State::ToCome;

    auto fields() const { return std::tie(static_cast<const Swimmer&>(*this), state); }
};

// Make fish and shark as a dive begins. sizes: generator of the fishes' sizes alone.
void spawnFish(const DiveFiles&, Random&, Random sizes, std::vector<Fish>& out);
Shark spawnShark(const DiveFiles&, Random&);

// One of the player's hands: its tracked joints, what it touches, what it grasps, and the fingers as they
// rest on a fish.

using Joints = std::array<hands::Joint, hands::kJointCount>;

// Whether the hand is closing, and what it holds.
struct Grasp {
    float firmest = 0;   // strongest grip since the hand was last open
    bool closed = false; // with hysteresis
    int window = 0;      // ticks left to take hold of what is between the fingers
    int holds = -1;      // index of the held fish, -1 none
    int encloses = -1;   // index of the fish its fingers close around: held, or about to be
};

// The fish that the hand reaches for, and the help for the hand to take it; see game/rules/Intent.h.
struct Intent {
    int fish = -1;          // -1: none
    bool inRange = false;   // that fish is taken if the hand closes now
    float unseen_s = 0;     // seconds since the fish was last in range
    bool helps = false;     // the hand has been helped to that fish since the hand began to close
    glm::vec3 movedView{0}; // how far the help has moved the hand, viewer's frame
    float closing_Hz = 0;   // growth of the grip a second, smoothed over about 30 ms
    float fastest_mps = 0;  // greatest speed of the hand since it began to close
    Miss miss = Miss::None; // reason if it takes nothing, decided when the grip closed
};

// Fingers that rest on the fish they close around instead of entering it.
struct FingerWrap {
    Joints shown{}; // the hand's joints, with fingers resting on that fish
    // Offset of each joint, as it rests on the fish, from the joint that the device sees, palm's frame. It is
    // eased, so that no finger jumps when the fist opens.
    struct Lift {
        glm::vec3 move{0};
        glm::quat turn{1, 0, 0, 0};
    };
    std::array<Lift, hands::kJointCount> lifts{};
    // Forces of the fingers on that fish in this tick; the first pressCount count.
    std::array<physics::Press, hands::kJointCount> presses{};
    int pressCount = 0;
};

constexpr int kThrowTicks = 10; // ticks (83 ms) whose mean velocity a thrown thing gets

struct Hand {
    bool visible = false;
    bool known = false;       // lastGood has been set
    hands::HandPose lastGood; // viewer's frame
    int untrackedTicks = 0;
    bool solid = false; // touches and pushes fish
    Joints joints{}, before{};
    std::array<glm::vec3, hands::kJointCount> velocities{}; // joints', smoothed over about 25 ms
    glm::vec3 graspCentre{0};
    glm::vec3 velocity{0};                          // velocity of the palm, over the last tick
    glm::vec3 calmVelocity{0};                      // the same, smoothed over about 50 ms
    glm::vec3 ownVelocity{0};                       // the same relative to the head, without the help's part
    std::array<glm::vec3, kThrowTicks + 1> trail{}; // the palm's places in the last ticks, newest first
    glm::vec3 calmAcceleration{0};                  // derivative of calmVelocity, smoothed, m/s2
    float grip = 0;                                 // 0 open to 1 fist
    std::array<TouchView, hands::kHandParts> touching{}; // felt by each finger and the palm
    Grasp grasp;
    Intent intent;
    FingerWrap fingers;
    Miss lastMiss = Miss::None; // None: it has taken hold since
    float sinceMiss_s = 0;
    float stung_s = 0;     // seconds left in which a stung hand cannot hold
    float rested_s = 0;    // seconds for which it has rested, open and in view
    float nextVisit_s = 0; // seconds before the next fish may come to look at it
    float baitLeft_s = 0;  // seconds for which a cracked mussel draws fish to it
    bool fed = false;      // one of these has come

    const hands::Joint& palm() const { return joints[hands::kPalmJoint]; }
    glm::vec3 outOfPalm() const { return palm().orientation * glm::vec3(0, -1, 0); }
    // Returns the position in the hand of a fish of that radius, which is capped at physics::kEnclosed_m.
    glm::vec3 hollow(float radius_m) const {
        const float radius = std::min(radius_m, physics::kEnclosed_m);
        return palm().position + palm().orientation * glm::vec3(0, -0.008f - radius, -0.030f);
    }
};
using Hands = std::array<Hand, 2>; // left, right

using hands::kGripCloses, hands::kGripOpens;
// A hand untracked for longer lets go of its fish.
constexpr auto kHandDropTicks = static_cast<int>(hands::kHandLost_s * sim::kTickRate_Hz + 0.5f);

// Returns the finger, or hands::kPalmPart, of the bone from kJointParent[joint] to the joint. The bones of
// the back of the hand belong to the palm.
inline int partOfBone(int joint) {
    const int finger = hands::fingerOfJoint(joint);
    if (finger < 0) return hands::kPalmPart;
    const hands::FingerJoints& joints = hands::kFingerJoints[finger];
    const bool thumb = finger == 0; // the thumb's proximal bone moves on its own
    return joint <= (thumb ? joints.metacarpal : joints.proximal) ? hands::kPalmPart : finger;
}

inline physics::Capsule bone(const std::array<hands::Joint, hands::kJointCount>& joints, int joint) {
    const hands::Joint& from = joints[hands::kJointParent[joint]];
    const hands::Joint& to = joints[joint];
    return {from.position, to.position, std::min(from.radius, to.radius)};
}

// Position and direction of the player's head.
struct Viewpoint {
    glm::quat worldFromView{1, 0, 0, 0};
    glm::vec3 headWorld{0}; // between the eyes

    glm::vec3 ahead() const { return worldFromView * glm::vec3(0, 0, -1); }
};

constexpr float kHeadReach_m = 10; // a head position farther out, or not finite, is ignored

// All input of one tick. Nothing else enters the simulation from outside.
struct TickInput {
    std::array<hands::HandPose, 2> hands{}; // left, right; viewer's frame
    glm::quat worldFromView{1, 0, 0, 0};
    glm::vec3 headWorld{0}; // between the eyes; within kHeadReach_m of the origin
    bool pause = false;     // held: the tick changes nothing but `paused`
    bool restart = false;   // on the tick it becomes true: a new dive with the next seed
};

// Updates view and hands from the tick's input. Values that are not finite or not plausible are ignored: the
// last good ones stay.
void trackHands(const TickInput&, Viewpoint&, Hands&);

// Counts that goals need besides points and catches.
struct GoalCounts {
    std::array<uint32_t, kMaxQuick> caughtAt{}; // ticks of the latest catches, the newest first
    std::array<int, 2> byHand{};                // catches of the left and the right hand
    int first = -1;                             // species of the first catch
    int calm = 0;                               // catches since a fish was frightened
    int guests = 0, turned = 0; // mussels on which fish fed; times that a stone turned the shark
    uint64_t touched = 0;       // species of animals, a bit each
};

// A catch gives its species' points times the combo: how many different species, this one included, have been
// caught one after the other, at most kMaxCombo. A second fish of a species in the run begins a new run with
// itself; a fish lost to the shark ends the run.
struct Score {
    int points = 0, caught = 0;
    int lost = 0;     // to the shark
    uint64_t run = 0; // species of the present run, a bit each; the table holds at most 64
    int bestCombo = 0;
    uint64_t things = 0;               // kinds of loose things among the species caught, a bit each
    std::vector<SpeciesTally> species; // by index into the species table
    GoalCounts goalCounts;
    std::vector<int> goals;    // of this dive: indices into DiveFile::goals
    std::vector<bool> reached; // by index into `goals`

    // Returns the combo of the last catch; 0: no run.
    int combo() const { return std::min(std::popcount(run), kMaxCombo); }
    // Counts a catch; returns the points that it gave.
    int countCatch(int kind, int kindPoints) {
        const uint64_t bit = uint64_t{1} << kind;
        run = (run & bit) != 0 ? bit : run | bit;
        bestCombo = std::max(bestCombo, combo());
        ++caught;
        ++species[kind].caught;
        const int given = kindPoints * combo();
        points += given;
        return given;
    }
    // Counts a loose thing taken out of the sea, outside of all runs.
    void countThing(int kind, int kindPoints) {
        things |= uint64_t{1} << kind;
        ++species[kind].caught;
        points += kindPoints;
    }
    void countLoss(int kind) {
        ++lost;
        ++species[kind].lost;
        run = 0;
    }
};

// Returns a dive's goals, indices into `all`: all if they are at most kGoals, else one of each level, drawn
// by the seed. No two are alike or exclude each other.
std::vector<int> drawGoals(const std::vector<Goal>& all, uint64_t seed);

// Returns how far a goal has been reached, 0 to Goal::count.
int progressOf(const Goal&, const Score&);

// over: the dive has ended, which decides NoLoss goals.
bool isReached(const Goal&, const Score&, bool over);

// The complete state of a dive: with the files and the coming inputs it determines the future. Plain data.
struct DiveState {
    uint64_t seed = 0;
    Random random{};
    uint32_t tick = 0; // since the dive began
    uint64_t totalTicks = 0;
    Phase phase = Phase::Diving;
    bool begun = false, paused = false, restartHeld = false;
    bool toldOfNoGuest = false;
    Score score;
    Viewpoint view;
    Hands hands;
    std::vector<Fish> fish;
    Shark shark;                            // its creature id is fish.size()
    Giant giant;                            // its creature id comes after the shark's
    std::vector<physics::Contact> contacts; // of this tick; the next tick continues those that last

    float time_s() const { return static_cast<float>(tick) * kDt; } // since the dive began
};

// The dive as its rules read it. A rule takes the parts that it changes as arguments of its own.
struct DiveContext {
    const DiveFile& dive;
    const SpeciesTable& species;
    const DiveState& state;
    FilmMoment film{};
    Assist assist = Assist::None;

    const Species& kindOf(const Fish& fish) const { return species[fish.species]; }
    const Species& kindOf(const Shark& shark) const { return species[shark.species]; }
    glm::vec3 head() const { return state.view.headWorld; }
    bool hides(glm::vec3 place) const { return film.hides(head(), place); }
    Thing thingOf(const Fish& fish) const { return kindOf(fish).thing; }
    // Returns whether a hand can take hold of the fish now.
    bool mayBeTaken(const Fish& f) const { return f.free() && f.uncatchable_s <= 0 && !kindOf(f).stings; }
};

// Counts a tick's events.
void countForGoals(std::span<const Event>, const DiveContext&, GoalCounts&);

} // namespace shoal::game
