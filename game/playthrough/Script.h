// A playthrough: steps of a scripted player and the expectations that must be met, read from a TOML file.
#pragma once

#include "game/feedback/EventTable.h"
#include "game/rules/Dive.h"
#include "input/hands/HandRig.h"

#include <optional>
#include <string>
#include <vector>

namespace shoal::game {

struct ScriptStep {
    enum class Do {
        Reach,   // bring a hand to the nearest fish (of `kind`) until it could be grasped
        Close,   // close a hand (and keep following the fish just reached for)
        Hold,    // wait `seconds` with hands as they are
        Open,    // open a hand
        Look,    // turn towards yaw and pitch, or `at` "shark"
        Wait,    // `seconds`, or `until` an event of that name, or until the `phase`
        Wave,    // swing a hand 0.5 m to both sides of where it is at `speed` m/s for `seconds`
        Hover,   // bring a hand in the shark's way, for `seconds`
        Offer,   // bring what the hand holds as near to the shark as it reaches, for `seconds`
        Rest,    // take a hand back to the side
        Restart, // a new dive
        Pause,   // for `seconds`
        Again,   // back to step number `from` (1 is the first), at most `times`, unless event `unless` has
                 // occurred
    };
    Do what = Do::Wait;
    int line = 0; // in the file
    int hand = 1; // 0 left, 1 right
    std::string kind = "any";
    bool atShark = false; // what to look at, instead of yaw and pitch
    float seconds = 0;
    float speed = 1.5f;
    float yaw = 0, pitch = 0; // radians; yaw to the right, pitch up
    float timeout_s = 30;
    std::optional<EventKind> until, unless;
    std::optional<Phase> phase;
    int from = 1, times = 1;
    bool optional = false; // a timeout goes on to the next step instead of failing
};

struct ScriptExpect {
    int line = 0;
    std::optional<int> caught, scoreAtLeast, lost; // at the script's end
    std::optional<EventKind> event;                // occurs at least `count` times in the given time
    std::optional<EventKind> never;                // does not occur at all
    std::optional<Phase> phase;                    // at the end
    int count = 1;
    float after_s = 0, before_s = 1e9f; // since the script began
    std::vector<EventKind> order;       // occur in this order, others between
};

struct Script {
    std::string name;
    std::string dive = "reef"; // for loadDiveFiles()
    uint64_t seed = 1;
    DiveRules rules;
    float timeout_s = 120;
    std::vector<ScriptStep> steps;
    std::vector<ScriptExpect> expects;
};

Result<Script> loadScript(const Path& file);

// Plays a script: one TickInput a tick from what the last tick showed. Motions keep below 1.5 m/s (but for
// Wave), as a person's do. Depends on snapshots and events alone, never on the display.
class ScriptRun {
  public:
    ScriptRun(Script, hands::HandRig, SpeciesTable);

    // Input of the next tick, from the snapshot after the last one.
    void next(const Snapshot&, TickInput& out);
    // Events of the tick just stepped, and the snapshot after it.
    void observe(const Events&, const Snapshot&);

    bool finished() const { return finished_; }
    // After the end: success, or the first step that timed out or expectation unmet, as a sentence.
    Status verdict() const;
    uint64_t ticks() const { return tick_; }

  private:
    struct ScriptHand {
        glm::vec3 graspWorld{0};
        glm::vec3 anchor{0}; // middle of a wave
        float closed = 0;
        float closedGoal = 0;
        int target = -1; // creature followed
    };
    struct Seen {
        EventKind kind;
        float time_s;
    };

    void performStep(const Snapshot&, TickInput&);
    bool perform(const ScriptStep&, const Snapshot&, TickInput&);
    bool reach(const ScriptStep&, const Snapshot&);
    bool look(const ScriptStep&, const Snapshot&, float spent_s);
    bool wait(const ScriptStep&, const Snapshot&, float spent_s) const;
    void wave(const ScriptStep&, const Snapshot&, float spent_s);
    void meetShark(const ScriptStep&, const Snapshot&);
    void advance(size_t to);
    void moveHand(int hand, glm::vec3 goalWorld, float speed);
    void lookTowards(glm::vec3 directionWorld);
    int chooseFish(const ScriptStep&, const Snapshot&) const;
    bool follow(int hand, const Snapshot&);

    Script script_;
    hands::HandRig rig_;
    SpeciesTable species_;
    std::array<ScriptHand, 2> hands_{};
    float yaw_ = 0, pitch_ = 0;
    size_t step_ = 0;
    uint64_t tick_ = 0, stepBegan_ = 0;
    size_t seenAtStep_ = 0;
    std::vector<int> repeats_;
    std::vector<Seen> seen_;
    Snapshot last_;
    bool finished_ = false;
    std::string failure_;
};

} // namespace shoal::game
