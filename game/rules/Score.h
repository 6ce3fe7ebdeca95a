// Points, combos, the tally of species, and the goals of a dive. Plain data; part of the hashed state.
#pragma once

#include "game/rules/DiveFile.h"

#include <cstdint>
#include <vector>

namespace shoal::game {

struct SpeciesTally {
    int caught = 0, lost = 0; // lost: to the shark
    bool touched = false;     // by a hand, in this dive
};

// A catch gives its species' points times the combo: how many different species, this one included, have been
// caught one after the other, at most kMaxCombo. A second fish of a species in the run begins a new run with
// itself; a fish lost to the shark ends the run.
struct Score {
    int points = 0, caught = 0;
    int lost = 0;     // to the shark
    uint64_t run = 0; // species of the present run, a bit each; the table holds at most 64
    int bestCombo = 0;
    std::vector<SpeciesTally> species; // by index into the species table
    std::vector<bool> reached;         // by index into DiveFile::goals

    int combo() const;                       // of the last catch; 0: no run
    int countCatch(int species, int points); // returns the points that it gave
    void countLoss(int species);
};

Score newScore(const SpeciesTable&, const DiveFile&);

// Returns how far a goal has been reached, 0 to Goal::count.
int progressOf(const Goal&, const Score&);

// over: the dive has ended, which decides NoLoss goals.
bool isReached(const Goal&, const Score&, bool over);

} // namespace shoal::game
