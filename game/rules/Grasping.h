// Finds what the player's hands touch, and its effect on a fish that no hand holds; decides which fish a
// closing hand takes hold of, whether the hand keeps it, and when it counts as a catch; moves the fish in a
// hand, and the fingers that lie on it.
// Steps 4 and 5 of engine/physics/ContactModel.h say how fingers lie on a fish and what force they bear.
#pragma once

#include "engine/physics/Grip.h"
#include "engine/physics/World.h"
#include "game/rules/DiveState.h"

#include <algorithm>
#include <span>
#include <vector>

namespace shoal::game {

constexpr int kCloseWindow = 12;      // ticks for which a hand that has stopped closing can still take hold
constexpr int kHelpedWindow = 22;     // the same for a hand that is helped to a fish
constexpr float kShowCatch_s = 0.75f; // time for which a caught fish turns to the player
constexpr float kUncatchable_s = 2;   // time before a fish can be caught again, after a catch or the shark
constexpr float kSting_s = 1;         // time in which a stung hand cannot hold

// Finds the contacts of a tick. Holds scratch memory only, no state; allocates only in the first tick.
class HandContacts {
  public:
    // Replaces the last tick's contacts by this tick's, sorted by creature id, hand and joint. The shark's id
    // is fish.size(). Resets the separation velocities of all fish and counts down their noPush_s.
    void collide(physics::World&, std::span<Fish>, const DiveContext&,
                 std::vector<physics::Contact>& contacts);

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

// Wraps the hand's fingers around the body: sets the shown joints and the presses.
void wrapFingers(const physics::Capsule& body, Hand&);

// Returns whether the contacts of both hands with the fish can bear the force asked_N.
physics::Hold holdOn(int fish, const DiveState&, glm::vec3 asked_N);

// Updates each hand's closing and opening. A closing hand takes hold of a fish that its fingers, or both
// hands, press from opposing sides; it is helped to the fish it reaches for, and stung by one that stings.
// Once the dive is over, hands take nothing.
void closeHands(Hands&, std::span<Fish>, const DiveContext&, Events&);

// Lets the held fish escape. A thing is let go by letGo(). h: 0 left, 1 right.
void drop(Hand&, int h, std::span<Fish>, const DiveContext&, Events&);

// Advances all holds, after everything has moved: a held fish may slip out, or is caught and leaves the hand.
void countCatches(Hands&, std::span<Fish>, Score&, const DiveContext&, Events&);

// Turns caught fish to the player; then they swim off.
void showCatches(std::span<Fish>, const DiveContext&, Events&);

// Moves held fish and things along with the hands.
void followHands(const Hands&, std::span<Fish>, const DiveContext&);

// Bends the body and beats the tail of a fish in the hand: it curls away from the palm, and bouts of
// struggling alternate with rests, each bout weaker than the last.
void struggle(Fish&, const Hand&, Random&);

// Eases the shown joints towards where the fingers rest: the last step of a tick.
void easeFingers(Hand&);

} // namespace shoal::game
