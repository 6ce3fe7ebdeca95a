// The state after a tick that picture, sound and haptics read, immutable once made; and the events of a dive.
// Plain data.
#pragma once

#include "engine/scene/HandPose.h"
#include "engine/sim/FixedStep.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace shoal::game {

constexpr float kDt = sim::kTick_s;

// World frame: the env frame of engine/math/LatLong.h, metres; the viewer's eyes rest at the origin, and a
// headset moves them.

enum class Phase { Diving, Results };

// The animation clips of a species' model; kMotionNames are their names in the file.
// The last three are for things: hanging on seaweed, detached from it, and a mussel opening.
enum class Motion { Swim, Dart, Struggle, Cruise, Lunge, Bite, Drift, Detached, Open };
constexpr std::array<const char*, 9> kMotionNames = {"swim", "dart",  "struggle", "cruise", "lunge",
                                                     "bite", "drift", "loose",    "open"};

// The bend that is added to a body's clip, and the amplitude to which the clip's tail wave is scaled.
struct BodyShape {
    float beats = 0;     // tail beats, left and right, since the dive began
    float amplitude = 0; // half the tail's sweep, in body lengths
    // Curvature times length: the angle between head and tail, radians; both ends to the left.
    float bendLeft = 0;
    float bendUp = 0;   // the same, both ends up
    float finsDown = 0; // how far the pectoral fins are lowered, radians; at most kThreatens
    static constexpr float kThreatens = 0.65f; // finsDown of a shark that threatens
};

// The animation clip that plays, and the clip from which it blends.
struct Gait {
    Motion motion = Motion::Swim, before = Motion::Swim;
    float blend = 1;   // 0: all `before`, 1: all `motion`
    float phase_s = 0; // time inside the motion's clip, for all but the spine; not wrapped

    void set(Motion next) {
        if (next == motion) return;
        before = std::exchange(motion, next);
        blend = 0;
    }
    void advance(float rate) { // rate 1: at the clip's own pace
        constexpr float kBlend_s = 0.2f;
        phase_s += kDt * rate;
        blend = std::min(1.0f, blend + kDt / kBlend_s);
    }
};

struct CreatureView {
    uint32_t id = 0;                     // stable during a dive; also its place in Snapshot::creatures
    int species = 0;                     // index into the species table
    glm::vec3 position{0};               // middle of the body
    glm::quat worldFromBody{1, 0, 0, 0}; // the body looks along its +Z, +Y up, as its model does
    glm::vec3 velocity{0};               // m/s
    float length = 0.2f;                 // metres, nose to tail
    Gait gait;
    BodyShape shape;      // the spine
    int heldBy = -1;      // 0 left, 1 right, -1 free
    float catchable = 0;  // 1 if a hand that closes now takes it, else 0, eased in between
    int catchableBy = -1; // that hand: 0 left, 1 right, -1 none
    bool hidden = false;  // the film hides it from the player's head
};

// Reason why a closing hand took nothing, as the events below.
enum class Miss { None, Nothing, TooFar, TooFast, TooEarly, Behind };

// Touch of one finger, or of the palm.
struct TouchView {
    bool touches = false;
    float depth_m = 0;   // how deep it presses
    float press_mps = 0; // how fast it presses in
    float slide_mps = 0; // how fast it strokes along
    float struggle = 0;  // 0 to 1: how hard a held fish wriggles under it
};

struct HandView {
    bool visible = false;
    float grip = 0;                                        // 0 open to 1 fist
    std::array<hands::Joint, hands::kJointCount> joints{}; // world frame
    int holds = -1;                                        // creature id
    float ready = 0;        // CreatureView::catchable of the creature that it takes
    int outOfReach = -1;    // creature that it points at and that is too far away, -1 none
    float haste = 0;        // 0 to 1: how nearly it frightens the animals in front of it
    float holdProgress = 0; // share of holdTime_s() that it has been held
    std::array<TouchView, hands::kHandParts> touching{}; // five fingers and the palm
    // Direction from the wrist to the elbow, world frame: unit where a tracker gives it, else 0. The session
    // adds it; the rules do not know it.
    glm::vec3 towardsElbow{0};
};

struct SpeciesTally {
    int caught = 0, lost = 0; // lost: to the shark
    bool touched = false;     // by a hand, in this dive
    float largest_m = 0;      // of those caught; 0: none
};

// One of the dive's goals.
struct GoalView {
    int goal = 0;     // index into DiveFile::goals
    int progress = 0; // 0 to Goal::count
    bool reached = false;
};

struct Snapshot {
    uint64_t tick = 0;
    double time_s = 0; // since the dive began
    Phase phase = Phase::Diving;
    bool paused = false;
    bool freeSwim = false; // no clock: timeLeft_s stays what it is
    float timeLeft_s = 0;
    float enclosure = 0; // 0 open water to 1 a tunnel, where the video now is
    int score = 0;
    int caught = 0;
    int lost = 0;                    // to the shark
    int combo = 0;                   // of the last catch, 0 to kMaxCombo; 0: no run of species is under way
    int bestCombo = 0;               // of the dive
    std::vector<SpeciesTally> tally; // by index into the species table
    std::vector<GoalView> goals;     // none in free swim
    glm::quat worldFromView{1, 0, 0, 0}; // direction of the player's view
    glm::vec3 headWorld{0};              // between the player's eyes
    std::array<HandView, 2> hands{};     // left, right
    std::vector<CreatureView> creatures;
};

// Events of a dive, for sound, captions, haptics and playthroughs. Each kind has a row in
// game/feedback/EventTable.h with its name, sound, caption and haptic pulse.
enum class EventKind {
    Touch,   // a finger or palm meets a fish
    Startle, // a fish flees; once per fright
    Grab,    // a hand closes on a fish
    Catch,   // held long enough: it counts
    Release, // let go after a catch
    Escape,  // let go, or slipped out, before it counted
    Miss,    // a hand closed on nothing: no fish was near it
    // A hand closed beside a fish and did not get it, with the reason (game/rules/Intent.h):
    MissTooFar,   // the fish was farther away than the hand
    MissTooFast,  // the hand was too fast
    MissTooEarly, // the fish had not yet come between the fingers
    MissBehind,   // the hand was behind the fish
    Sting,        // a hand closed on something that stings, and cannot hold for a while
    Throw,        // a hand throws a loose thing
    Knock,        // a loose thing knocks on rock, on another or on an animal
    Crack,        // a mussel cracks in a hand
    Feed,         // the first fish comes to feed on it
    NoGuest,      // no fish came to feed on it; reported at most once a dive
    SharkTurns,   // a stone turns the shark away
    Collect,      // a bottle is taken out of the sea
    Goal,         // a goal of the dive is reached
    Encounter,    // something large sets out to pass by
    SharkNear,    // the shark turns towards the player
    SharkAims,    // it points at a hand: the warning before a strike
    SharkBump,    // the shark hits a hand
    SharkSteal,   // the shark takes a fish out of a hand
    DiveStart,
    DiveOver,
};

struct Event {
    EventKind kind;
    int creature = -1;                   // CreatureView::id; -1: none, as for hand and part
    int hand = -1;                       // 0 left, 1 right
    std::optional<glm::vec3> position{}; // world frame; empty: everywhere
    int part = -1;                       // hands::Finger or hands::kPalmPart
    float closing_mps = 0;               // closing speed of hand and creature
    // Set for a Catch: its species, its points (combo included), and the combo, which multiplies the points;
    // for a Collect: species and points.
    int species = -1; // index into the species table
    int points = 0;
    int combo = 0;
    float length_m = 0, mass_kg = 0; // of a Catch
    int goal = -1;                   // index into Snapshot::goals, for a Goal
};

using Events = std::vector<Event>; // functions append to it

} // namespace shoal::game
