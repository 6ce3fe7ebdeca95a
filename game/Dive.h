// The game without picture and sound: rules and behaviours, stepped at 120 Hz. A function of its files, its
// seed and its inputs alone; no clock, no global state. One thread.
#pragma once

#include "engine/sim/FixedStep.h"
#include "game/DiveFile.h"
#include "game/Snapshot.h"
#include "game/Species.h"
#include "game/TickInput.h"

#include <memory>
#include <vector>

namespace shoal::game {

struct World; // game/World.h: the state itself, for those who write rules

class Dive {
  public:
    Dive(SpeciesTable, DiveFile, uint64_t seed);
    ~Dive();
    Dive(Dive&&) noexcept;
    Dive& operator=(Dive&&) noexcept;

    // One tick of 1/120 s. Appends what happened to out. Joints that are not finite or absurd are not
    // believed: the hand's last good pose stays for that tick.
    void step(const TickInput&, std::vector<Event>& out);

    // Overwrites out; allocates only the first time.
    void snapshot(Snapshot& out) const;

    // Of everything that the future depends on.
    uint64_t stateHash() const;

    uint64_t seed() const; // of the dive now under way
    const SpeciesTable& species() const;
    const DiveFile& file() const;

  private:
    std::unique_ptr<World> world_;
};

// What lies between two snapshots of neighbouring ticks, alpha 0 to 1. Creatures that jumped are not smeared.
void interpolate(const Snapshot& before, const Snapshot& after, float alpha, Snapshot& out);

// Help with depth for MouseInput::assist_m: distance from the eye, metres, of the nearest free fish whose
// body lies within a few degrees of a ray (unit, viewer's frame) and within reach; negative if there is none.
float reachAssist(const Snapshot&, const SpeciesTable&, glm::vec3 rayView);

} // namespace shoal::game
