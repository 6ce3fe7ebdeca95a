#include "game/rules/Intent.h"

#include "engine/physics/ContactModel.h"

#include <algorithm>
#include <array>

namespace shoal::game {

namespace {

// Range within which a fish can be a hand's target, and limit of the hand's displacement towards it.
struct Help {
    float across_m;   // range of the gap between grasp centre and body, across the line of sight...
    float along_m;    // ...and along it, where eyes judge worse
    float moveHand_m; // farthest that the hand is moved
};
constexpr std::array<Help, 3> kHelp = {{
    {kGraspRadius_m, kGraspRadius_m, 0},
    {0.10f, 0.18f, 0.05f},
    {0.17f, 0.30f, 0.10f},
}}; // by Assist

constexpr float kEnter = 0.85f;        // share of the range below which a fish becomes the target...
constexpr float kKeep = 1.5f;          // ...above which it is dropped at once...
constexpr float kForget_s = 0.35f;     // ...and time after which it is dropped beyond the range
constexpr float kThing = 0.3f;         // cost of a loose thing, in ranges
constexpr float kLook_s = 0.1f;        // look-ahead, about the time in which fingers close
constexpr float kSlow_mps = 0.9f;      // speed relative to the fish that counts as none...
constexpr float kTooFast_mps = 1.8f;   // ...and above which nothing is caught
constexpr float kClosing_Hz = 1.5f;    // growth of the grip a second above which...
constexpr float kBegun = 0.1f;         // ...from this grip on, a hand is closing
constexpr float kMoveHand_mps = 0.8f;  // speed at which the help moves the hand...
constexpr float kMoveBack_mps = 0.25f; // ...and back when it is open and empty
constexpr float kPull_mps2 = 30;       // acceleration of a fish into the hand
constexpr float kShow_Hz = 12;         // easing rate of Fish::catchable

// Returns the smaller of the fish's distances from the hand now and in kLook_s, in units of the range (0 in
// the hand, 1 at the range's edge), plus a penalty for speed; very large if the fish cannot be the target.
float reachOf(const Fish& f, const Hand& hand, const DiveContext& in) {
    const Help& help = kHelp[static_cast<size_t>(in.assist)];
    if (!in.mayBeTaken(f)) return kNever;
    const glm::vec3 apart = f.velocity - hand.calmVelocity;
    const float speed = glm::length(apart);
    if (speed > kTooFast_mps) return kNever;
    const float behindPalm = 2 * help.moveHand_m; // as hand and fish both move
    if (glm::dot(f.position - hand.palm().position, hand.outOfPalm()) < -behindPalm) return kNever;
    if (in.hides(f.position)) return kNever;
    const auto gapAt = [&](glm::vec3 centre) {
        const physics::Capsule body = capsuleOf(f, in.kindOf(f));
        const physics::Nearest at = physics::nearest({centre, centre, 0}, body);
        const glm::vec3 way = at.onSecond - centre;
        const float distance = glm::length(way);
        const glm::vec3 gap = way * (std::max(0.0f, distance - body.radius) / std::max(distance, 1e-6f));
        const glm::vec3 sight = normalizedOr(hand.graspCentre - in.head(), {0, 0, -1});
        const float along = glm::dot(gap, sight);
        const float across = glm::length(gap - along * sight);
        return std::sqrt(along * along / (help.along_m * help.along_m) +
                         across * across / (help.across_m * help.across_m));
    };
    const float now = gapAt(hand.graspCentre), soon = gapAt(hand.graspCentre - apart * kLook_s);
    // A thing is the target only of a hand that reaches straight for it; otherwise a fish beside it is.
    const float thing = in.thingOf(f) != Thing::None ? kThing : 0;
    // The minimum of both: a fish in the hand stays the target although it is about to leave.
    return thing + std::min(now, soon) + std::max(0.0f, speed - kSlow_mps) / (kTooFast_mps - kSlow_mps);
}

void readIntent(Hand& hand, std::span<const Fish> fish, const DiveContext& in) {
    Intent& intent = hand.intent;
    intent.inRange = false;
    if (!hand.solid || hand.stung_s > 0 || hand.grasp.holds >= 0 || in.hides(hand.graspCentre)) {
        intent.fish = -1;
        return;
    }
    const auto reach = [&](const Fish& f) { return reachOf(f, hand, in); };
    const float kept = intent.fish >= 0 ? reach(fish[intent.fish]) : 1e9f;
    intent.unseen_s = kept < 1 ? 0 : intent.unseen_s + kDt;
    if (kept > kKeep || intent.unseen_s > kForget_s) intent.fish = -1;
    const bool closes = isClosing(hand);
    if (hand.grasp.closed && !closes) { // a closed fist has no target
        intent.fish = -1;
        return;
    }
    // Another fish becomes the target if it is clearly nearer, and never while the fingers close.
    const float limit = intent.fish < 0 ? kEnter : closes ? 0.0f : std::min(kept - 0.25f, kEnter);
    const int nearer = leastCost(fish, limit, reach);
    if (nearer >= 0) {
        intent.fish = nearer;
        intent.unseen_s = 0;
    }
    intent.inRange = intent.fish >= 0 && intent.unseen_s == 0;
}

// Moves an open, empty hand slowly back to where the device sees it.
void moveBack(Hand& hand) {
    Intent& intent = hand.intent;
    if (hand.grasp.closed || hand.grasp.holds >= 0 || hand.grasp.window > 0) return;
    intent.helps = false;
    intent.movedView -= limited(intent.movedView, kMoveBack_mps * kDt);
}

} // namespace

void readIntents(Hands& hands, std::span<Fish> fish, const DiveContext& in) {
    std::array<int, 2> meant{};
    for (int h = 0; h < 2; ++h) {
        Hand& hand = hands[h];
        hand.stung_s = std::max(0.0f, hand.stung_s - kDt);
        hand.sinceMiss_s += kDt;
        readIntent(hand, fish, in);
        moveBack(hand);
        meant[h] = hand.intent.inRange ? hand.intent.fish : -1;
    }
    for (size_t i = 0; i < fish.size(); ++i) {
        Fish& f = fish[i];
        const int id = static_cast<int>(i), by = meant[1] == id ? 1 : meant[0] == id ? 0 : -1;
        if (by >= 0) f.catchableBy = by;
        f.catchable =
            by >= 0 ? eased(f.catchable, 1, kShow_Hz) : std::max(0.0f, eased(f.catchable, -0.1f, kShow_Hz));
        if (f.catchable == 0) f.catchableBy = -1;
    }
}

glm::vec3 pushIntoHollow(const Fish& f, const Species& kind, const Hand& hand) {
    const glm::vec3 way = hand.hollow(f.size * kind.bodyRadius_m) - f.position;
    const glm::vec3 wanted = hand.calmVelocity + limited(way * physics::kDrawRate_Hz, physics::kDrawMax_mps);
    return limited(wanted, kMaxSpeed_mps) - f.forward * f.speed;
}

void helpClosing(Fish& f, Hand& hand, const DiveContext& in) {
    Intent& intent = hand.intent;
    intent.helps = true;
    const glm::vec3 apart = f.position - hand.hollow(f.size * in.kindOf(f).bodyRadius_m);
    const glm::vec3 step = limited(apart, kMoveHand_mps * kDt);
    intent.movedView = limited(intent.movedView + glm::conjugate(in.state.view.worldFromView) * step,
                               kHelp[static_cast<size_t>(in.assist)].moveHand_m);
    f.push += limited(pushIntoHollow(f, in.kindOf(f), hand) - f.push, kPull_mps2 * kDt);
}

bool isClosing(const Hand& hand) {
    return hand.grasp.window > 0 || (hand.intent.closing_Hz > kClosing_Hz && hand.grip > kBegun);
}

// The fish that a hand points at, as the eyes see it.
struct PointedAt {
    int id = -1;
    float beyond_m = 0;  // how much farther from the eyes than the hand it is
    glm::vec3 across{0}; // from the line of sight through the hand to the fish
};

static PointedAt pointedAt(const Hand& hand, std::span<const Fish> fish, const DiveContext& in) {
    constexpr float kCone = 0.12f, kBeside_m = 0.12f; // cone around the line of sight: tangent, radius at eye
    constexpr float kFarthestMeant_m = 3;
    const glm::vec3 sight = normalizedOr(hand.graspCentre - in.head(), {0, 0, -1});
    const auto along = [&](const Fish& f) { return glm::dot(f.position - in.head(), sight); };
    const auto across = [&](const Fish& f) { return f.position - in.head() - along(f) * sight; };
    const auto beyond = [&](const Fish& f) { return along(f) - glm::distance(hand.graspCentre, in.head()); };
    const int id = leastCost(fish, 1, [&](const Fish& f) {
        if (!f.free() || f.uncatchable_s > 0) return kNever;
        if (along(f) < 0.2f || along(f) > kFarthestMeant_m) return kNever;
        const float room = kBeside_m + 0.5f * lengthOf(f, in.kindOf(f)) + kCone * along(f);
        const float beside = glm::length(across(f));
        if (beside > room || in.hides(f.position)) return kNever; // hides() takes longest, so it comes last
        // Depth counts a little: of two fish beside the line the nearer one was meant.
        return beside / room + 0.15f * std::fabs(beyond(f));
    });
    if (id < 0) return {};
    return {id, beyond(fish[id]), across(fish[id])};
}

static float reachBeyond(const Fish& f, const DiveContext& in) {
    return kGraspRadius_m + in.kindOf(f).bodyRadius_m;
}

Miss whyMissed(const Hand& hand, std::span<const Fish> fish, const DiveContext& in) {
    const PointedAt at = pointedAt(hand, fish, in);
    if (at.id < 0) return Miss::Nothing;
    const Fish& meant = fish[at.id];
    if (hand.intent.fastest_mps > kFastHand_mps || meant.state == Fish::State::Dart) return Miss::TooFast;
    const float reach = reachBeyond(meant, in);
    if (at.beyond_m > reach) return Miss::TooFar;
    const bool leaves = glm::dot(meant.velocity, at.across) > 0;
    if (at.beyond_m < -reach || (leaves && glm::length(at.across) > reach)) return Miss::Behind;
    return Miss::TooEarly;
}

int fishOutOfReach(const Hand& hand, std::span<const Fish> fish, const DiveContext& in) {
    constexpr float kAhead = 0.82f; // cosine of 35 degrees from the middle of the view, where no hand rests
    const glm::vec3 way = normalizedOr(hand.graspCentre - in.head(), in.state.view.ahead());
    const bool points = hand.solid && !hand.grasp.closed && glm::dot(way, in.state.view.ahead()) > kAhead;
    if (!points || hand.intent.fish >= 0) return -1;
    const PointedAt at = pointedAt(hand, fish, in);
    const bool far =
        at.id >= 0 && isFish(in.kindOf(fish[at.id])) && at.beyond_m > reachBeyond(fish[at.id], in);
    return far ? at.id : -1;
}

EventKind eventOf(Miss miss) {
    constexpr auto kFirst = static_cast<int>(EventKind::Miss); // both enumerations have the same order
    return static_cast<EventKind>(kFirst + std::max(0, static_cast<int>(miss) - 1));
}

std::optional<float> reachHelp(const Snapshot& now, const SpeciesTable& species, glm::vec3 rayView,
                               float hand_m, int& target) {
    // Reach of hands that are tracked above a desk, a third of a metre ahead of its middle (see Mount in
    // input/hands/HandTracker.h), so that mouse and hands have the same fish within reach. The wheel goes
    // beyond.
    constexpr float kNear_m = 0.3f, kFar_m = 1.3f;
    // Angles between the ray and the fish's outline, as tangents: full help up to the first (4 degrees), none
    // from the second on (12 degrees).
    constexpr float kFull = 0.07f, kNone = 0.21f;
    constexpr float kKeptTo = 0.06f;      // bonus of the present target, a tangent...
    constexpr float kNearerPer_m = 0.08f; // ...and bonus for each metre that a fish is nearer
    constexpr float kOnIt = 0.06f;        // bonus of a fish that the ray meets, a tangent
    constexpr float kThingBeside = 0.06f; // penalty of a loose thing, a tangent
    constexpr float kLead_s = 0.15f;      // look-ahead that makes up for the hand's delay behind the fish
    const glm::vec3 ray = now.worldFromView * rayView;
    const auto along = [&](const CreatureView& c) { return glm::dot(c.position - now.headWorld, ray); };
    const auto beside = [&](const CreatureView& c) { // angle from ray to outline, a tangent
        const float across_m = glm::length(c.position - now.headWorld - ray * along(c));
        return std::max(0.0f, across_m - 0.3f * c.length) / along(c);
    };
    target = leastCost(now.creatures, kNever, [&](const CreatureView& c) {
        const bool free = c.heldBy < 0 && c.gait.motion != Motion::Struggle && c.gait.motion != Motion::Open;
        if (!isCatchable(species[c.species]) || !free || c.hidden) return kNever;
        if (along(c) < kNear_m || along(c) > kFar_m || beside(c) >= kNone) return kNever;
        const float thing = species[c.species].thing != Thing::None ? kThingBeside : 0;
        return thing + beside(c) + kNearerPer_m * along(c) - (beside(c) == 0 ? kOnIt : 0) -
               (static_cast<int>(c.id) == target ? kKeptTo : 0);
    });
    if (target < 0) return std::nullopt;
    const CreatureView& fish = now.creatures[target];
    const float goal = std::clamp(along(fish) + kLead_s * glm::dot(fish.velocity, ray), kNear_m, kFar_m);
    const float edge = std::clamp((kNone - beside(fish)) / (kNone - kFull), 0.0f, 1.0f);
    return hand_m + (goal - hand_m) * edge * edge * (3 - 2 * edge);
}

} // namespace shoal::game
