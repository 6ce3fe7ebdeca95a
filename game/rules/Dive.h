// The game without picture and sound: rules and behaviours, stepped at 120 Hz. The state depends on files,
// seed and inputs alone; no clock, no global state. One thread.
#pragma once

#include "engine/sim/Recording.h"
#include "game/rules/DiveState.h"
#include "game/rules/FishBehaviour.h"
#include "game/rules/Grasping.h"
#include "game/rules/Snapshot.h"
#include "game/rules/Things.h"

#include <span>
#include <vector>

namespace shoal::game {

class Dive {
  public:
    Dive(SpeciesTable, DiveFile, uint64_t seed, DiveRules = {});

    // Advances the dive by one tick of 1/120 s and appends its events. A hand whose joints are not finite or
    // not plausible keeps its last good pose for that tick.
    void step(const TickInput&, Events& events);

    // Copies the visible state to out; allocates only the first time.
    void snapshot(Snapshot& out) const;

    // Returns the hash of the whole DiveState.
    uint64_t stateHash() const;

    uint64_t seed() const { return state_.seed; } // of the dive now under way
    const SpeciesTable& species() const { return files_.species; }
    const DiveFile& file() const { return files_.dive; }
    const DiveRules& rules() const { return rules_; }

    const DiveState& state() const { return state_; }
    DiveState& state() { return state_; } // for tests of single rules
    DiveContext context() const {
        const FilmMoment now(files_.dive.space.get(), static_cast<double>(state_.tick) / sim::kTickRate_Hz);
        return {files_.dive, files_.species, state_, now, rules_.assist};
    }

  private:
    void begin(uint64_t seed);
    void touch(Events&);
    int giantId() const { return static_cast<int>(state_.fish.size()) + (state_.shark.present ? 1 : 0); }
    void endWhenOver(Events&);
    void reachGoals(Events&);

    DiveFiles files_;
    DiveRules rules_;
    DiveState state_;
    // Scratch memory, no part of the state.
    physics::World world_;
    HandContacts handContacts_;
    ThingMover thingMover_;
    std::vector<Neighbours> neighbours_;
};

// The input as bytes for a Recording: little-endian floats, fixed size.
constexpr size_t kTickInputBytes = 2 * (3 * 4 + 2 + 8 + hands::kJointCount * 8 * 4) + 7 * 4 + 1;
void toBytes(const TickInput&, std::span<uint8_t, kTickInputBytes> out);
TickInput fromBytes(std::span<const uint8_t, kTickInputBytes>);

sim::RecordingHeader recordingHeader(const Dive&);

// Returns the rules under which a recording was made; an error names a value, or the kind of inputs, that
// this version does not know.
Result<DiveRules> rulesOf(const sim::RecordingHeader&);

// Returns the video that a recording names, a file below content/; if it names none, own: the dive's video.
std::string filmOf(const sim::RecordingHeader&, const std::string& own);

// A recording that was made with a FilmSpace can be replayed only with an equal one, and a recording that was
// made without one only without. The error says what differs.
bool needsFilmSpace(const sim::RecordingHeader&);
Status checkFilmSpace(const sim::RecordingHeader&, const FilmSpace*); // null: the film has no distances

// Returns how enclosed the video, which repeats every videoLength_s, is at a time: 0 to 1. A mark's amount
// ramps up over the two seconds before it and down over the two after it, across the video's end too; of
// overlapping marks the greater counts. A mark counts nothing if videoLength_s is 0 (no video) or if it
// begins beyond the end (it belongs to a longer video).
float enclosureAt(std::span<const VideoMark> marks, double videoLength_s, double time_s);

// Interpolates snapshots of neighbouring ticks, alpha 0 to 1. Creatures that jumped are shown as in `after`.
void interpolate(const Snapshot& before, const Snapshot& after, float alpha, Snapshot& out);

} // namespace shoal::game
