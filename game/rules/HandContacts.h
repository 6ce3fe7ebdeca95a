// Contacts of the player's hands with fish and shark, and their effect on a fish that no hand holds.
#pragma once

#include "engine/physics/ContactWorld.h"
#include "game/rules/DiveState.h"

#include <algorithm>
#include <span>
#include <vector>

namespace shoal::game {

// Finds the contacts of a tick. Holds scratch memory only, no state; allocates only in the first tick.
class HandContacts {
  public:
    // Replaces the last tick's contacts by this tick's, sorted by creature id, hand and joint. The shark's id
    // is fish.size(). Resets the separation velocities of all fish and counts down their noPush_s.
    void collide(std::span<Fish>, const DiveContext&, std::vector<physics::Contact>& contacts);

  private:
    std::vector<physics::Body> bodies_;
    std::vector<physics::Mover> movers_;
    std::vector<physics::Contact> last_;
};

// Calls visit(creature, contacts) for each creature that a hand touches.
template <class Visit> void forEachCreature(std::span<const physics::Contact> contacts, Visit visit) {
    for (auto from = contacts.begin(); from != contacts.end();) {
        const auto to =
            std::find_if(from, contacts.end(), [&](const auto& c) { return c.body != from->body; });
        visit(static_cast<int>(from->body), std::span<const physics::Contact>(from, to));
        from = to;
    }
}

// Updates what the touching finger or palm feels of the fish.
void feel(const physics::Contact&, const Fish&, Hands&);

// Pushes a fish that no hand holds, by all contacts with it, and startles it when they are too rough.
void pushFish(Fish&, int id, std::span<const physics::Contact>, const DiveContext&, Random&, Events&);

} // namespace shoal::game
