#include "game/rules/Catching.h"

#include "engine/physics/ContactModel.h"
#include "game/rules/Hand.h"
#include "game/rules/HandContacts.h"
#include "game/rules/Holding.h"
#include "game/rules/Intent.h"
#include "game/rules/Steering.h"

#include <algorithm>
#include <limits>

namespace shoal::game {

float graspGap(const Fish& f, const Species& kind, const Hand& hand) {
    return physics::separation({hand.graspCentre, hand.graspCentre, 0}, capsuleOf(f, kind));
}

bool onPalmSide(const Fish& f, const Hand& hand) {
    return glm::dot(f.position - hand.palm().position, hand.outOfPalm()) > 0;
}

namespace {

bool graspable(const Fish& f, const Hand& hand, int h, const Closing& closing) {
    const Species& kind = closing.species[f.species];
    if (!f.free() || f.uncatchable_s > 0 || kind.stings) return false;
    const auto hides = [&](glm::vec3 at) { return closing.film.hides(closing.view.headWorld, at); };
    if (hides(f.position) || hides(hand.graspCentre)) return false;
    if (!onPalmSide(f, hand)) return false;
    if (graspGap(f, kind, hand) < kGraspRadius_m) return true;
    const auto touched = [&](int part) { return f.touchedUntil[h][part] > closing.tick; };
    return (touched(0) || touched(hands::kPalmPart)) &&
           (touched(1) || touched(2) || touched(3) || touched(4)) &&
           graspGap(f, kind, hand) < 2 * kGraspRadius_m;
}

// Returns the graspable fish nearest to the grasp centre, or -1.
int nearestGraspable(const Hand& hand, int h, std::span<const Fish> fish, const Closing& closing) {
    int nearest = -1;
    float gap = std::numeric_limits<float>::max();
    for (size_t i = 0; i < fish.size(); ++i) {
        if (!graspable(fish[i], hand, h, closing)) continue;
        const float distance = graspGap(fish[i], closing.species[fish[i].species], hand);
        if (distance < gap) gap = distance, nearest = static_cast<int>(i);
    }
    return nearest;
}

// Pushes a fish between closing fingers into the hollow of the hand.
void drawIn(Fish& f, const Species& kind, const Hand& hand) {
    const glm::vec3 hollow = hollowOf(hand.palm(), std::min(kind.bodyRadius_m, physics::kEnclosed_m));
    const glm::vec3 wanted =
        hand.calmVelocity + limited((hollow - f.position) * physics::kDrawRate_Hz, physics::kDrawMax_mps);
    f.push = limited(wanted, kMaxSpeed_mps) - f.forward * f.speed;
}

void wrapAround(const Fish& f, const Species& kind, Hand& hand) {
    wrapFingers(capsuleOf(f, kind, physics::kEnclosed_m), hand);
}

void grab(Fish& f, int id, Hand& hand, int h, Events& events) {
    hand.grasp.holds = hand.grasp.encloses = id;
    hand.grasp.window = 0;
    hand.grasp.firmest = 1; // it takes hold again only after it has opened
    hand.lastMiss = Miss::None;
    f.state = Fish::State::Held;
    f.heldBy = h;
    f.held_s = 0;
    f.counted = false;
    f.push = f.slide = glm::vec3(0);
    f.slid_m = 0;
    f.unopposed = 0;
    f.gait.set(Motion::Struggle);
    const glm::quat palmFromWorld = glm::conjugate(hand.palm().orientation);
    f.palmFromBody = palmFromWorld * f.worldFromBody;
    f.palmOffset = palmFromWorld * (f.position - hand.graspCentre);
    // A fish in a fist lies across the palm: its head out at the side it was heading for, its back towards
    // wrist or fingers.
    const glm::vec3 heading = f.palmFromBody * glm::vec3(0, 0, 1), back = f.palmFromBody * kUp;
    const glm::vec3 z(heading.x < 0 ? -1.0f : 1.0f, 0, 0), y(0, 0, back.z < 0 ? -1.0f : 1.0f);
    f.palmFromBodyGoal = glm::quat_cast(glm::mat3(glm::cross(y, z), y, z));
    events.push_back({EventKind::Grab, id, h, f.position});
}

// Starts the flight of a released fish: away from the player and roughly the way it looks.
void swimOff(Fish& f, const Species& kind, const Hand& hand) {
    f.struggle = 0;
    f.loose_s = physics::kLoose_s;
    f.heldBy = -1;
    f.state = Fish::State::Dart;
    f.dart_s = 1.2f;
    f.frightRest_s = 1.5f;
    f.uncatchable_s = f.counted ? kUncatchable_s : 0.6f;
    const glm::vec3 outward = normalizedOr(f.position - 0.2f * kUp, {0, 0, -1});
    const glm::vec3 looks = f.worldFromBody * glm::vec3(0, 0, 1);
    f.flee = normalizedOr(glm::vec3(outward.x, 0.2f * outward.y, outward.z) * 0.7f + looks * 0.5f, outward);
    f.forward = levelled(normalizedOr(looks, f.flee), 0.6f);
    f.speed = std::min(0.5f, kind.dart_mps);
    f.push = limited(0.3f * hand.calmVelocity, 0.6f);
    f.velocity = f.forward * f.speed + f.push;
}

// Updates whether the hand is closed, and for how many ticks it may still take hold.
void readGrip(Hand& hand) {
    Grasp& grasp = hand.grasp;
    const bool helped = hand.intent.helps && hand.intent.fish >= 0;
    if (hand.grip < kGripOpens) {
        grasp.closed = false;
        grasp.firmest = kGripOpens;
        grasp.window = 0;
        hand.intent.fastest_mps = 0;
    } else if (hand.grip > grasp.firmest + physics::kFirmer) {
        grasp.firmest = hand.grip;
        grasp.window = helped ? kHelpedWindow : kCloseWindow;
    }
    if (grasp.window > 0)
        hand.intent.fastest_mps = std::max(hand.intent.fastest_mps, glm::length(hand.calmVelocity));
    grasp.closed = grasp.closed || hand.grip > kGripCloses;
}

// Takes hold of a fish that both hands press on from opposing sides.
void takeBetweenHands(Hands& hands, std::span<Fish> fish, const Closing& closing, Events& events) {
    if (hands[0].grasp.holds >= 0 || hands[1].grasp.holds >= 0) return;
    bool taken = false;
    forEachCreature(closing.contacts, [&](int id, std::span<const physics::Contact> own) {
        const bool both = own.front().group != own.back().group, isFish = id < static_cast<int>(fish.size());
        if (taken || !both || !isFish || fish[id].heldBy >= 0 || fish[id].uncatchable_s > 0) return;
        const Species& kind = closing.species[fish[id].species];
        if (kind.stings || closing.film.hides(closing.view.headWorld, fish[id].position)) return;
        if (holdOn(id, hands, closing.contacts, glm::vec3(0)).margin_N < physics::kFirm_N) return;
        const int h = graspGap(fish[id], kind, hands[0]) < graspGap(fish[id], kind, hands[1]) ? 0 : 1;
        grab(fish[id], id, hands[h], h, events);
        taken = true;
    });
}

} // namespace

void drop(Hand& hand, int h, const SpeciesTable& species, std::span<Fish> fish, Events& events) {
    const int id = hand.grasp.holds;
    hand.grasp.holds = hand.grasp.encloses = -1;
    Fish& f = fish[id];
    swimOff(f, species[f.species], hand);
    events.push_back({f.counted ? EventKind::Release : EventKind::Escape, id, h, f.position});
}

namespace {

// Takes hold of the fish between the fingers, or draws it in. Returns whether it is held.
bool takeHold(Hands& hands, int h, int id, std::span<Fish> fish, const Closing& closing, Events& events) {
    Hand& hand = hands[h];
    Fish& f = fish[id];
    const Species& kind = closing.species[f.species];
    wrapAround(f, kind, hand);
    hand.grasp.encloses = id;
    if (holdOn(id, hands, closing.contacts, glm::vec3(0)).margin_N > physics::kFirm_N) {
        grab(f, id, hand, h, events);
        return true;
    }
    if (id == hand.intent.fish && closing.assist != Assist::None)
        helpClosing(f, kind, hand, closing.view, closing.assist);
    else
        drawIn(f, kind, hand);
    return false;
}

// Stings a hand that closes on a stinging species. Returns whether it did.
bool sting(Hand& hand, int h, std::span<Fish> fish, const Closing& closing, Events& events) {
    for (size_t i = 0; i < fish.size(); ++i) {
        const Species& kind = closing.species[fish[i].species];
        if (!kind.stings || !onPalmSide(fish[i], hand)) continue;
        if (graspGap(fish[i], kind, hand) > kGraspRadius_m) continue;
        hand.stung_s = kSting_s;
        events.push_back({EventKind::Sting, static_cast<int>(i), h, fish[i].position});
        return true;
    }
    return false;
}

void miss(Hand& hand, int h, Events& events) {
    hand.lastMiss = hand.intent.miss;
    hand.sinceMiss_s = 0;
    events.push_back({.kind = eventOf(hand.lastMiss), .hand = h, .position = hand.graspCentre});
}

void closeHand(Hands& hands, int h, std::span<Fish> fish, const Closing& closing, Events& events) {
    Hand& hand = hands[h];
    Grasp& grasp = hand.grasp;
    const bool wasClosed = grasp.closed;
    readGrip(hand);
    if (grasp.closed && !wasClosed)
        hand.intent.miss = missOf(hand, closing.view, closing.species, fish, closing.film);
    if (grasp.holds >= 0) wrapAround(fish[grasp.holds], closing.species[fish[grasp.holds].species], hand);
    grasp.encloses = grasp.holds;
    if (grasp.holds >= 0 || !closing.takes) return;
    if (hand.stung_s > 0) {
        grasp.window = 0;
        return;
    }
    const bool helped = closing.assist != Assist::None && hand.intent.fish >= 0;
    if (grasp.window == 0) {
        if (helped && isClosing(hand))
            helpClosing(fish[hand.intent.fish], closing.species[fish[hand.intent.fish].species], hand,
                        closing.view, closing.assist);
        return;
    }
    if (sting(hand, h, fish, closing, events)) return;
    const int id = helped ? hand.intent.fish : nearestGraspable(hand, h, fish, closing);
    if (id >= 0 && takeHold(hands, h, id, fish, closing, events)) return;
    if (--grasp.window == 0 && grasp.closed) miss(hand, h, events);
}

} // namespace

void closeHands(Hands& hands, std::span<Fish> fish, const Closing& closing, Events& events) {
    for (int h = 0; h < 2; ++h) {
        Hand& hand = hands[h];
        if (!hand.visible) {
            if (hand.grasp.holds >= 0 && hand.untrackedTicks > kHandDropTicks)
                drop(hand, h, closing.species, fish, events);
        } else if (hand.solid)
            closeHand(hands, h, fish, closing, events);
    }
    if (closing.takes) takeBetweenHands(hands, fish, closing, events);
}

void countCatches(Hands& hands, const SpeciesTable& species, std::span<Fish> fish,
                  std::span<const physics::Contact> contacts, Score& score, Events& events) {
    for (int h = 0; h < 2; ++h) {
        Hand& hand = hands[h];
        if (hand.grasp.holds < 0) continue;
        const int id = hand.grasp.holds;
        Fish& f = fish[id];
        const Species& kind = species[f.species];
        f.held_s += kDt;
        f.bank = 0;
        f.speed = 0;
        f.gait.set(Motion::Struggle);
        f.gait.advance(1.6f);
        if (hand.solid && !keepsHold(f, id, kind, hands, h, contacts)) {
            drop(hand, h, species, fish, events);
            continue;
        }
        if (!f.counted && f.held_s >= kHoldToCatch_s + 0.5f * kDt) {
            f.counted = true;
            const int points = score.countCatch(f.species, kind.points);
            events.push_back({.kind = EventKind::Catch,
                              .creature = id,
                              .hand = h,
                              .position = f.position,
                              .species = f.species,
                              .points = points,
                              .combo = score.combo()});
        }
        if (f.counted && f.held_s >= kHoldToCatch_s + kShowCatch_s) drop(hand, h, species, fish, events);
    }
}

} // namespace shoal::game
