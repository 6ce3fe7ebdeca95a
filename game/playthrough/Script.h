// A playthrough: steps of a scripted player and the expectations that must be met, read from a TOML file.
#pragma once

#include "engine/core/Hash.h"
#include "game/feedback/EventTable.h"
#include "game/rules/Dive.h"
#include "input/hands/MouseHands.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace shoal::game {

struct ScriptStep {
    enum class Do {
        // Steps of a hand:
        Reach, // bring it to the nearest fish (of `kind`), or to `offset` from it, until it is there
        Move,  // bring it to the place `to`, with `speed`
        Close, // close it (and keep following the fish just reached for)
        Open,
        Throw, // swing it towards the place `to`, or `at` "shark", with `speed`, and open it on the way
        Wave,  // swing it 0.5 m to both sides of where it is at `speed` m/s for `seconds`
        Hover, // bring it towards the middle of the shark, for `seconds`
        Offer, // bring the held fish as near to the shark's mouth as the hand reaches, for `seconds`
        Rest,  // take it back to the side
        // Steps of either:
        Hold,    // wait `seconds` with hands as they are
        Look,    // turn towards yaw and pitch, or `at` "shark"
        Wait,    // `seconds`, `until` an event of that name, until the `phase`, or until a fish is `near` the
                 // hand
        Restart, // a new dive
        Pause,   // for `seconds`
        Again,   // back to step number `from` (1 is the first), at most `times`, unless event `unless` has
                 // occurred
        // Steps of the mouse:
        Point, // move it to `x` and `y`, or after the nearest fish (of `kind`) until the mouse's hand has it
        Press, // the button
        Release,
    };
    bool movesHand() const { return what <= Do::Rest; }
    bool movesMouse() const { return what >= Do::Point; }

    Do what = Do::Wait;
    int line = 0; // line in the file
    int hand = 1; // 0 left, 1 right
    std::string kind = "any";
    enum class At { Shark, Fish };
    std::optional<At> at;       // Look or Throw at the shark, or Point at a fish, not at the numbers below
    glm::vec3 offset{0}, to{0}; // viewer's frame, metres
    glm::vec2 pointer_px{640, 360}; // place in a window of 1280x720: +x right, +y down
    float near_m = 0;
    float seconds = 0;
    float speed = 1.5f;
    float yaw = 0, pitch = 0; // radians; yaw to the right, pitch up
    float timeout_s = 30;
    std::optional<EventKind> until, unless;
    std::optional<Phase> phase;
    int from = 1, times = 1;
    bool optional = false; // a timeout goes on to the next step instead of failing
};

// A number at the script's end that an expectation names by its key.
struct EndValue {
    const char* key;
    int Snapshot::*value;
    bool isLeast; // the value must be at least the expected number; false: equal to it
};
constexpr std::array kEndValues = {
    EndValue{"caught", &Snapshot::caught, false}, EndValue{"score_at_least", &Snapshot::score, true},
    EndValue{"lost", &Snapshot::lost, false}, EndValue{"combo_at_least", &Snapshot::bestCombo, true}};

struct ScriptExpect {
    int line = 0;
    enum class Water { Open, Film };
    std::optional<Water> water; // checked only in a dive without FilmSpace, or only with one
    std::array<std::optional<int>, kEndValues.size()> atEnd;
    std::optional<float> fishAbove_m; // least height of all fish, relative to the eyes
    std::optional<EventKind> event;   // an event that occurs at least `count` times in the given time
    std::optional<EventKind> never;   // an event that does not occur at all
    std::optional<Phase> phase;       // phase at the end
    int count = 1;
    float after_s = 0, before_s = 1e9f; // limits on the time of `event` since the script began
    std::vector<EventKind> order;       // events that occur in this order, others may lie between
};

struct Script {
    std::string file; // stem of the file's name
    std::string name;
    std::string dive = "reef"; // name or file, for loadDiveFiles()
    std::string film;          // the film of another dive, by that dive's name; empty: the dive's own
    uint64_t seed = 1;
    DiveRules rules; // a player's defaults, changed by the file
    float timeout_s = 120;
    bool usesMouse = false; // in place of hands
    std::vector<ScriptStep> steps;
    std::vector<ScriptExpect> expects;
};

Result<Script> loadScript(const Path& file);

// Loads the script's dive, with the film that it names.
Result<DiveFiles> loadDiveFiles(const Script&);

// Plays a script: makes each tick's TickInput from the snapshot after the last tick. Hands move at 1.5 m/s at
// most, as a person's do, but Move and Wave at their own speed. Depends on snapshots and events alone.
class ScriptRun {
  public:
    // inFilm: the dive has a FilmSpace; some expectations hold only with one, or only without.
    ScriptRun(Script, hands::HandRig, SpeciesTable, bool inFilm);

    // Makes the input of the next tick, from the snapshot after the last one.
    void next(const Snapshot&, TickInput& out);
    // Takes the events of the tick just stepped, the state's hash, and the snapshot after it.
    void observe(std::span<const Event>, uint64_t stateHash, const Snapshot&);

    bool finished() const { return !failure_.empty() || step_ >= script_.steps.size(); }
    // Returns success, or the first step that timed out or expectation that failed, once finished().
    Status verdict() const;
    uint64_t ticks() const { return tick_; }
    const std::string& name() const { return script_.file; }
    uint64_t hash() const { return hash_.value(); } // hash of all ticks' states

  private:
    struct ScriptHand {
        glm::vec3 graspWorld{0};
        glm::vec3 anchor{0}; // middle of a wave
        glm::vec3 offset{0}; // from the followed creature, viewer's frame
        float closed = 0;
        float closedGoal = 0;
        int target = -1; // id of the followed creature, -1 none
    };
    struct Occurred {
        EventKind kind;
        float time_s;
    };

    std::string unmet(const ScriptExpect&) const;
    void performStep(const Snapshot&, TickInput&);
    bool perform(const ScriptStep&, const Snapshot&, TickInput&);
    bool reach(const ScriptStep&, const Snapshot&);
    bool look(const ScriptStep&, const Snapshot&, float spent_s);
    bool point(const ScriptStep&, const Snapshot&);
    void movePointer(glm::vec2 goal_px);
    bool wait(const ScriptStep&, const Snapshot&, float spent_s) const;
    void advance(size_t to);
    void moveHand(int hand, glm::vec3 goalWorld, float speed);
    void lookTowards(glm::vec3 directionWorld);
    int chooseFish(const ScriptStep&, const Snapshot&) const;
    bool follow(int hand, const Snapshot&);

    Script script_;
    hands::HandRig rig_;
    SpeciesTable species_;
    bool inFilm_;
    std::array<ScriptHand, 2> hands_{};
    hands::MouseHands mouse_; // for a script that moves the mouse
    hands::MouseInput mouseInput_;
    int reachTarget_ = -1; // see reachHelp()
    float yaw_ = 0, pitch_ = 0;
    size_t step_ = 0;
    uint64_t tick_ = 0, stepBegan_ = 0;
    size_t occurredAtStep_ = 0;
    std::vector<int> repeats_;
    std::vector<Occurred> occurred_;
    Snapshot last_;
    float lowestFish_m_ = 1e9f;
    Hash hash_;
    std::string failure_; // ends the script
};

} // namespace shoal::game
