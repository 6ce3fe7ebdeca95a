// The game without picture and sound: rules and behaviours, stepped at 120 Hz. A function of its files, its
// seed and its inputs alone; no clock, no global state. One thread.
#pragma once

#include "engine/core/Random.h"
#include "engine/sim/Recording.h"
#include "game/rules/Catching.h"
#include "game/rules/DiveFile.h"
#include "game/rules/DiveRules.h"
#include "game/rules/Events.h"
#include "game/rules/FilmSpace.h"
#include "game/rules/FishBehaviour.h"
#include "game/rules/HandContacts.h"
#include "game/rules/SharkBehaviour.h"
#include "game/rules/Snapshot.h"
#include "game/rules/TickInput.h"

#include <tuple>
#include <vector>

namespace shoal::game {

// All that the future depends on besides files and inputs. Plain data.
struct DiveState {
    uint64_t seed = 0;
    Random random{};
    uint32_t tick = 0; // since the dive began
    uint64_t totalTicks = 0;
    Phase phase = Phase::Diving;
    bool begun = false, paused = false, restartHeld = false;
    Score score;
    Viewpoint view;
    Hands hands;
    std::vector<Fish> fish;
    Shark shark;                            // its creature id is fish.size()
    Passer passer;                          // its creature id comes after the shark's
    std::vector<physics::Contact> contacts; // of this tick; what lasts is next tick's past

    auto fields() const {
        return std::tie(seed, random, tick, totalTicks, phase, begun, paused, restartHeld, score, view, hands,
                        fish, shark, passer, contacts);
    }
};

class Dive {
  public:
    Dive(SpeciesTable, DiveFile, uint64_t seed, DiveRules = {});

    // One tick of 1/120 s. Appends what happened. Joints that are not finite or absurd are not
    // believed: the hand's last good pose stays for that tick.
    void step(const TickInput&, Events& events);

    // Overwrites out; allocates only the first time.
    void snapshot(Snapshot& out) const;

    // Of everything that the future depends on.
    uint64_t stateHash() const;

    uint64_t seed() const { return state_.seed; } // of the dive now under way
    const SpeciesTable& species() const { return files_.species; }
    const DiveFile& file() const { return files_.dive; }
    const DiveRules& rules() const { return rules_; }

    const DiveState& state() const { return state_; }
    DiveState& state() { return state_; } // for tests of single rules

  private:
    void begin(uint64_t seed);
    void touch(Events&);
    SharkView sharkView() const;
    void advanceShark(Events&);
    FilmMoment film(FilmSpace::Room of = FilmSpace::Room::Fish, float ahead_s = 0) const;
    int passerId() const { return static_cast<int>(state_.fish.size()) + (state_.shark.present ? 1 : 0); }
    void endWhenOver(Events&);
    void reachGoals(Events&);

    DiveFiles files_;
    DiveRules rules_;
    DiveState state_;
    // Scratch memory, no part of the state.
    HandContacts handContacts_;
    std::vector<Neighbours> neighbours_;
};

sim::RecordingHeader recordingHeader(const Dive&);

// The rules under which a recording was made; an error names a value, or the kind of inputs, that this
// version does not know.
Result<DiveRules> rulesOf(const sim::RecordingHeader&);

// The film that it was played in, a file below content/; own: the dive's own.
std::string filmOf(const sim::RecordingHeader&, const std::string& own);

// A dive goes the same way only in the same space: a recording that was made with one is played with that
// one, and one made without is played without. An error says which it is not.
bool needsFilmSpace(const sim::RecordingHeader&);
Status checkFilmSpace(const sim::RecordingHeader&, const FilmSpace*); // null: none

// A mark's effect grows over the two seconds before it and fades over the two after it, beyond the video's
// end from its start on. Nothing is known where videoLength_s is 0 (no video) or where a mark begins behind
// the end (it belongs to a longer one).
//
// 0 to 1 at a time of a video that repeats every videoLength_s; where marks meet the greater counts.
float enclosureAt(std::span<const VideoMark> marks, double videoLength_s, double time_s);

// What lies between two snapshots of neighbouring ticks, alpha 0 to 1. Creatures that jumped are not smeared.
void interpolate(const Snapshot& before, const Snapshot& after, float alpha, Snapshot& out);

} // namespace shoal::game
