// The whole state of a dive, and the parts a tick is made of. Internal to the rules; others use Dive and
// Snapshot.
#pragma once

#include "engine/core/Hash.h"
#include "engine/core/Random.h"
#include "engine/physics/ContactWorld.h"
#include "engine/physics/Grip.h"
#include "engine/sim/FixedStep.h"
#include "game/DiveFile.h"
#include "game/Snapshot.h"
#include "game/TickInput.h"
#include "input/haptics/HapticFrame.h"

#include <array>
#include <span>
#include <vector>

namespace shoal::game {

constexpr float kDt = sim::kTick_s;
constexpr int kParts = haptics::kActuatorsPerHand; // five fingers and the palm

// A hand closes when its grip rises through the first, opens when it falls through the second.
constexpr float kGripCloses = 0.55f;
constexpr float kGripOpens = 0.35f;
constexpr int kCloseWindow = 12; // ticks after it has stopped closing in which a hand still takes hold
constexpr float kGraspRadius_m = 0.075f; // around hands::graspCentre: what closing fingers draw in
constexpr int kHandDropTicks = 36;       // a hand untracked for longer: what it holds swims off
constexpr float kHoldToCatch_s = 1;
constexpr float kShowCatch_s = 0.2f; // from the catch until it is let go
constexpr float kUncatchable_s = 2;

struct Gait { // which clip plays
    Motion motion = Motion::Swim, before = Motion::Swim;
    float blend = 1;
    float phase_s = 0;

    void set(Motion next);
    void advance(float rate);
};

struct Fish {
    enum class Mind { Cruise, Dart, Held, Mouth };

    int species = 0;
    int school = 0;
    glm::vec3 position{0};
    glm::vec3 forward{0, 0, 1};
    glm::vec3 spin{0}; // of forward, rad/s
    float bank = 0;
    float speed = 0;       // along forward
    glm::vec3 push{0};     // m/s, what others did to it; fades
    glm::vec3 parting{0};  // m/s, out of what it overlaps; of this tick alone
    glm::vec3 velocity{0}; // of the last tick, in all
    glm::quat worldFromBody{1, 0, 0, 0};

    // Its habits; companions share those of one of them
    int leader = -1; // whose: its own index if alone
    float radius = 1, height = 0, cruise = 0.3f;
    float sense = 1; // +1 circles to the left of looking outward, -1 to the right
    glm::vec3 wander{0}, wanderGoal{0};
    int wanderTicks = 0;
    int routeTicks = 0; // until it takes up another radius and height
    float pace = 1;     // of cruising: those who live alone linger at times
    bool coasting = false;

    Mind mind = Mind::Cruise;
    float dart_s = 0;        // time left of the flight
    float flight_s = 0;      // since it took flight; 0 when it does not flee
    float flightSide = 0;    // the side it turned to then: +1 left
    float frightRest_s = 0;  // not frightened anew for so long
    glm::vec3 flee{0, 0, 1}; // unit
    float nervous_s = 0;     // how long it has been touched gently
    float uncatchable_s = 0;
    int heldBy = -1;
    float held_s = 0;
    bool counted = false; // this hold has become a catch
    glm::quat palmFromBody{1, 0, 0, 0}, palmFromBodyGoal{1, 0, 0, 0};
    glm::vec3 palmOffset{0}; // from the grasp centre, palm's frame
    glm::vec3 slide{0};      // m/s, how it slips in the hand, palm's frame
    float slid_m = 0;        // how far it has slipped since the grip was last firm
    float struggle = 0;      // of the last tick, 0 to 1: how hard the hand feels it wriggle
    int unopposed = 0;       // ticks for which nothing has held it from both sides
    float loose_s = 0;       // just let go: it slides out between the fingers, which do not push it
    std::array<std::array<uint32_t, kParts>, 2>
        touchedUntil{};      // tick to which a touch by that part still counts
    float struggle_s = 0;    // left of this bout of struggling, or of the rest after it
    bool struggling = false; // while held
    Gait gait;
    BodyShape shape;
};

struct Shark {
    enum class Mind { Circle, Prowl, Threaten, Strike, Leave };

    bool present = false;
    int species = -1;
    glm::vec3 position{0};
    glm::vec3 forward{0, 0, 1};
    glm::vec3 spin{0}; // of forward, rad/s
    float bank = 0, speed = 0;
    glm::vec3 velocity{0};
    glm::quat worldFromBody{1, 0, 0, 0};
    float sense = 1;
    Mind mind = Mind::Circle;
    float mind_s = 0;   // since it changed
    float visit_s = 0;  // left of the present visit
    float interest = 0; // grows while a fish struggles
    uint32_t nextVisit = 0;
    int prey = -1;  // creature id it strikes at
    int mouth = -1; // creature id it carries
    float bumpRest_s = 0;
    int watched = -1;       // hand it threatens
    float aimed_s = 0;      // how long it has pointed at that hand
    float threatRest_s = 0; // until it may threaten anew
    Gait gait;
    BodyShape shape;
};

// What a fish makes of those around it, gathered once a tick.
struct Neighbours {
    glm::vec3 giveWay{0};  // m/s, away from who is or soon will be too near
    glm::vec3 push{0};     // m/s, as steering comes too late for bodies that touch
    glm::vec3 headings{0}; // sum over the companions in the zone of orientation
    glm::vec3 towards{0};  // sum of the ways to those in the zone of attraction, metres
    float speeds = 0;      // sum over the companions in the zone of orientation, m/s
    int aligned = 0, attracted = 0;
};

struct Hand {
    bool visible = false;
    bool known = false;       // joints hold a pose
    hands::HandPose lastGood; // viewer's frame
    int untrackedTicks = 0;
    bool solid = false;                                              // touches and pushes
    std::array<hands::Joint, hands::kJointCount> joints{}, before{}; // world
    std::array<glm::vec3, hands::kJointCount> velocities{}; // of the joints, smoothed over about 25 ms
    glm::vec3 grasp{0};
    glm::vec3 velocity{0};         // of the palm, over the last tick
    glm::vec3 calmVelocity{0};     // the same, smoothed over about 50 ms
    glm::vec3 calmAcceleration{0}; // of the calm velocity, m/s2
    float grip = 0;
    float firmest = 0; // grip since it was last open
    bool closed = false;
    int window = 0; // ticks left to take hold of what is between the fingers
    int holds = -1;
    int encloses = -1;                        // the fish its fingers close around: held, or about to be
    std::array<TouchView, kParts> touching{}; // what each finger and the palm feel
    std::array<hands::Joint, hands::kJointCount> shown{}; // the joints, with fingers resting on that fish

    // Of this tick, on that fish.
    std::array<physics::Press, hands::kJointCount> presses{};
    int pressCount = 0;
    void press(int part, const physics::Press&, float depth_m);
};

struct World {
    World(SpeciesTable, DiveFile, uint64_t seed);

    // The tick, in this order.
    void begin(uint64_t newSeed);
    void readHands(const TickInput&);
    void frightenByHands(std::vector<Event>&);
    void followHands();
    void touch(std::vector<Event>&);
    void closeHands(std::vector<Event>&);
    void swim();
    void swimShark(std::vector<Event>&);
    void carry(std::vector<Event>&);
    void step(const TickInput&, std::vector<Event>&);

    // Fish and hands
    void bump(std::span<const physics::Contact>, std::vector<Event>&);     // the shark
    void pushFish(std::span<const physics::Contact>, std::vector<Event>&); // one fish that nobody holds
    void feel(const physics::Contact&);
    physics::Capsule body(const Fish&, float widest_m = 1) const;
    void enclose(int fish, Hand&) const;
    void takeBetweenHands(std::vector<Event>&);
    void drawIn(Fish&, const Hand&) const;
    physics::Hold holdOn(int fish, glm::vec3 asked_N) const;
    bool slipsOn(int fish, int hand);            // false: it has slipped out
    glm::vec3 askedOf(Fish&, const Hand&) const; // newtons: what a held fish asks of the grip
    void drop(int hand, std::vector<Event>&);
    void startle(int fish, glm::vec3 from, std::vector<Event>&);
    void grab(int fish, int hand, std::vector<Event>&);
    void letGo(int hand, Event::Kind why, std::vector<Event>&); // Release or Escape
    bool graspable(const Fish&, const Hand&, int hand) const;
    bool onPalmSide(const Fish&, const Hand&) const;
    float graspGap(const Fish&, const Hand&) const; // from the grasp centre to the body's surface, m
    void lookAround();
    void choose(Fish&, size_t index);
    void steer(Fish&, size_t index);
    void keepInBounds(Fish&);
    void bendAndBeat(Fish&, glm::vec3 wishedSpin);
    void struggle(Fish&, const Hand&);

    // The shark
    void sharkMind(std::vector<Event>&);
    void sharkMove();
    void sharkBendAndBeat(glm::vec3 wishedSpin);
    int watchedHand() const;
    void steal(int fish, std::vector<Event>&);
    void setMind(Shark::Mind);
    glm::vec3 mouthPosition() const;
    int sharkId() const { return static_cast<int>(fish.size()); }

    void emit(std::vector<Event>&, Event::Kind, int creature = -1, int hand = -1, int finger = -1,
              float strength = 0, glm::vec3 position = glm::vec3(0)) const;
    void fill(Snapshot&) const;
    uint64_t hash() const;

    const SpeciesTable species;
    const DiveFile file;
    uint64_t seed = 0;
    Random random;
    uint32_t tick = 0; // since the dive began
    uint64_t totalTicks = 0;
    Phase phase = Phase::Diving;
    bool begun = false, paused = false, restartHeld = false;
    int score = 0, caught = 0, lost = 0;
    glm::quat worldFromView{1, 0, 0, 0};
    glm::vec3 headWorld{0};
    std::array<Hand, 2> hands;
    std::vector<Fish> fish;
    Shark shark;
    std::vector<physics::Contact> contacts; // of this tick; what lasts is next tick's past

    // Scratch: no part of the state.
    std::vector<Neighbours> neighbours;
    physics::ContactWorld contactWorld;
    std::vector<physics::Body> bodies;
    std::vector<physics::Mover> movers;
    std::vector<physics::Contact> lastContacts;
};

} // namespace shoal::game
