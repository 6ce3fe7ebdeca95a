#include "game/rules/Curiosity.h"

#include "game/rules/Steering.h"

#include <limits>

namespace shoal::game {

namespace {

constexpr float kStill_mps = 0.2f; // a hand slower than this rests...
constexpr float kFast_mps = 0.6f;  // ...until it is faster than this
constexpr float kRest_s = 1;       // rest before the first visitor comes
constexpr float kNext_s = 2;       // time between two visitors
constexpr int kVisitors = 2;       // visitors of a hand at a time
constexpr float kInView = 0.82f;   // cosine of the angle from the middle of the view: 35 degrees
constexpr float kNearest_m = 0.25f, kFarthest_m = 2.2f; // distance of a possible visitor from the hand
constexpr float kComes_s = 7;                           // longest time on its way
constexpr float kThere_m = 0.12f;                       // distance from its place at which it has arrived
constexpr float kBefore_m = 0.06f;                      // distance from the grasp centre to its place

bool isStill(const Hand& hand, const Viewpoint& view) {
    const bool open = hand.visible && hand.solid && hand.grip < kGripOpens && hand.stung_s == 0;
    const glm::vec3 way = normalizedOr(hand.graspCentre - view.headWorld, view.ahead());
    return open && glm::dot(way, view.ahead()) > kInView && glm::length(hand.calmVelocity) < kStill_mps;
}

void noteRest(Hand& hand, const Viewpoint& view) {
    if (isStill(hand, view))
        hand.rested_s += kDt;
    else if (!hand.visible || hand.grip > kGripCloses || glm::length(hand.calmVelocity) > kFast_mps)
        hand.rested_s = 0;
    hand.nextVisit_s = std::max(0.0f, hand.nextVisit_s - kDt);
}

void advanceVisit(Visit& visit, const Fish& f, const Hands& hands, Random& random) {
    visit.rest_s = std::max(0.0f, visit.rest_s - kDt);
    if (visit.hand < 0) return;
    const Hand& hand = hands[visit.hand];
    const bool there = glm::distance(f.position, visitedPlace(hand)) < kThere_m;
    visit.left_s -= there ? kDt : kDt * (visit.linger_s / kComes_s);
    if (f.state == Fish::State::Cruise && hand.rested_s > 0 && visit.left_s > 0) return;
    visit.hand = -1;
    visit.rest_s = random.between(6, 14);
}

// Returns the fish ahead of the player with the least distance over curiosity; -1: none may come.
int nextVisitor(const Hand& hand, std::span<const Fish> fish, const DiveContext& in) {
    int best = -1;
    float bestCost = std::numeric_limits<float>::max();
    for (size_t i = 0; i < fish.size(); ++i) {
        const Fish& f = fish[i];
        const float curiosity = in.kindOf(f).curiosity;
        if (f.state != Fish::State::Cruise || f.visit.hand >= 0 || f.visit.rest_s > 0) continue;
        if (curiosity <= 0 || f.uncatchable_s > 0 || f.flight.rest_s > 0) continue;
        const float distance = glm::distance(f.position, hand.graspCentre);
        if (distance < kNearest_m || distance > kFarthest_m) continue;
        if (glm::dot(f.position - in.head(), in.state.view.ahead()) < 0.3f) continue;
        const float cost = distance / curiosity;
        if (cost < bestCost) bestCost = cost, best = static_cast<int>(i);
    }
    return best;
}

} // namespace

glm::vec3 visitedPlace(const Hand& hand) { return hand.graspCentre + hand.outOfPalm() * kBefore_m; }

void chooseVisitors(Hands& hands, std::span<Fish> fish, const DiveContext& in, Random& random) {
    for (Hand& hand : hands) noteRest(hand, in.state.view);
    std::array<int, 2> visitors{};
    for (Fish& f : fish) {
        advanceVisit(f.visit, f, hands, random);
        if (f.visit.hand >= 0) ++visitors[f.visit.hand];
    }
    for (int h = 0; h < 2; ++h) {
        Hand& hand = hands[h];
        if (hand.rested_s < kRest_s || hand.nextVisit_s > 0 || visitors[h] >= kVisitors) continue;
        hand.nextVisit_s = kNext_s;
        const int id = nextVisitor(hand, fish, in);
        if (id < 0) continue;
        Visit& visit = fish[id].visit;
        visit.hand = h;
        visit.left_s = visit.linger_s = random.between(2, 4);
    }
}

} // namespace shoal::game
