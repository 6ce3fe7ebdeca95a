#include "game/rules/Grasping.h"

#include "engine/math/Trigonometry.h"
#include "engine/physics/ContactModel.h"
#include "game/rules/FishBehaviour.h"
#include "game/rules/Intent.h"
#include "game/rules/Things.h"

namespace shoal::game {

// A fish's mass over the cube of its length, as common among fish that are not slender (Froese 2006, "Cube
// law, condition factor and weight-length relationships").
constexpr float kMass_kgpm3 = 20;
constexpr uint32_t kTouchKept = 12; // ticks for which a touch is remembered
constexpr float kGentle_mps = 0.6f; // speed of a palm below which its touch does not frighten...
constexpr float kPatience_s = 1.5f; // ...for this time

// Returns the strength of a fish's struggle after held_s in a hand, 1 at first.
static float tired(float held_s) { return std::max(physics::kTiredOut, 1 - physics::kTires_Hz * held_s); }

// Returns the deflection of its tail, -1 to 1.
static float tailBeat(const Fish& f) { return math::sine(f.hold.time_s * physics::kBeat_radps); }

// Returns the direction from a bone into a body, unit length.
static glm::vec3 into(const physics::Capsule& bone, const physics::Capsule& body) {
    const physics::Nearest at = physics::nearest(bone, body);
    return normalizedOr(at.onSecond - at.onFirst, kUp);
}

static void press(Hand& hand, int part, const physics::Press& one, float depth_m) {
    hand.fingers.presses[hand.fingers.pressCount++] = one;
    hand.touching[part].touches = true;
    hand.touching[part].depth_m = std::max(hand.touching[part].depth_m, depth_m);
}

static void pressPalm(const physics::Capsule& body, Hand& hand) { // the palm is rigid
    for (int j = 0; j < hands::kJointCount; ++j) {
        if (j == hands::kWristJoint || partOfBone(j) != hands::kPalmPart) continue;
        const physics::Capsule at = bone(hand.joints, j);
        const float gap = physics::separation(at, body);
        if (gap > physics::kLift_m) continue;
        const float depth = std::max(0.0f, -gap);
        press(hand, hands::kPalmPart,
              {into(at, body), std::min(physics::kPalmForce_N, physics::kPalmStiffness_Npm * depth)}, depth);
    }
}

static void wrapFinger(int finger, const physics::Capsule& body, Hand& hand) {
    const int first = hands::kFingerJoints[finger].metacarpal;
    physics::Finger given;
    given.count = hands::kFingerJoints[finger].count();
    for (int i = 0; i < given.count; ++i) {
        given.joints[i] = hand.joints[first + i].position;
        given.radii[i] = i == 0 ? 0 : bone(hand.joints, first + i).radius;
    }
    const physics::Finger rests = physics::wrapped(given, body);
    for (int i = 1; i < given.count; ++i) {
        hands::Joint& shown = hand.fingers.shown[first + i];
        shown.position = rests.joints[i];
        shown.orientation = rests.turned[std::min(i + 1, given.count - 1)] * shown.orientation;
        if (!rests.touches[i]) continue;
        const physics::Capsule here{rests.joints[i - 1], rests.joints[i], given.radii[i]};
        const glm::vec3 would = 0.5f * (given.joints[i - 1] + given.joints[i]);
        const float depth =
            glm::distance(would, 0.5f * (here.a + here.b)) + std::max(0.0f, -physics::separation(here, body));
        press(hand, finger, {into(here, body), physics::pressForce_N(depth)}, depth);
    }
}

void HandContacts::collide(physics::World& world, std::span<Fish> fish, const DiveContext& in,
                           std::vector<physics::Contact>& contacts) {
    const Hands& hands = in.state.hands;
    const Shark& shark = in.state.shark;
    const size_t maxBodies = fish.size() + 1, maxMovers = 2 * hands::kJointCount;
    bodies_.reserve(maxBodies);
    movers_.reserve(maxMovers);
    for (auto* found : {&contacts, &last_}) found->reserve(maxBodies * maxMovers);
    movers_.clear();
    for (int h = 0; h < 2; ++h) {
        const Hand& hand = hands[h];
        if (!hand.solid) continue;
        const float give =
            hand.grasp.closed ? 1.0f : physics::kOpenHandPush; // fingers of an open hand give way
        for (int j = hands::kWristJoint + 1; j < hands::kJointCount; ++j)
            movers_.push_back({bone(hand.before, j), bone(hand.joints, j),
                               give * hand.velocities[hands::kJointParent[j]], give * hand.velocities[j], h,
                               j});
    }
    bodies_.clear();
    for (size_t i = 0; i < fish.size(); ++i) {
        Fish& f = fish[i];
        f.separation = glm::vec3(0);
        if (f.state == Fish::State::Shown || f.state == Fish::State::Mouth || f.state == Fish::State::Gone ||
            (f.heldBy >= 0 && !hands[f.heldBy].solid))
            continue;
        f.hold.noPush_s = std::max(0.0f, f.hold.noPush_s - kDt);
        if (f.hold.noPush_s > 0) continue;
        bodies_.push_back(bodyOf(f, i, in.kindOf(f)));
    }
    if (shark.present) bodies_.push_back(bodyOf(shark, fish.size(), in.kindOf(shark)));
    std::swap(contacts, last_);
    world.touch(bodies_, movers_, kDt, last_, contacts);
}

void feel(const physics::Contact& contact, const Fish& f, Hands& hands) {
    Hand& hand = hands[contact.group];
    const glm::vec3 relative = contact.moverVelocity - f.velocity;
    const float along = glm::dot(relative, contact.normal);
    TouchView& under = hand.touching[partOfBone(contact.tag)];
    under.touches = true;
    if (hand.grasp.encloses != static_cast<int>(contact.body))
        under.depth_m = std::max(under.depth_m, contact.depth);
    under.press_mps = std::max(under.press_mps, along);
    under.slide_mps = std::max(under.slide_mps, glm::length(relative - along * contact.normal));
    if (f.heldBy == contact.group) under.struggle = f.hold.struggle;
}

void pushFish(Fish& f, int id, std::span<const physics::Contact> own, const DiveContext& in, Random& random,
              Events& events) {
    f.flight.touchedGently_s += kDt;
    for (const physics::Contact& contact : own) {
        const int h = contact.group, part = partOfBone(contact.tag);
        if (in.state.tick > f.touchedUntil[h][part])
            events.push_back({EventKind::Touch, id, h, contact.point, part, contact.closingSpeed});
        f.touchedUntil[h][part] = in.state.tick + kTouchKept;
        const Hand& hand = in.state.hands[h];
        const float palmClosing = glm::dot(hand.calmVelocity - f.velocity, contact.normal);
        if (helpedTo(hand, id) || feeds(f, in.state.hands)) continue;
        if (palmClosing > kGentle_mps || f.flight.touchedGently_s > kPatience_s ||
            (hand.grasp.closed && hand.grasp.window == 0))
            startle(f, id, hand.palm().position, in, random, events);
    }
    // Fingers that close around the fish do not push it away. Neither does an open hand that it swims into,
    // because a player's fingers would give way.
    const auto bats = [&](int h) {
        const Hand& hand = in.state.hands[h];
        const bool lets = !hand.grasp.closed && onPalmSide(f, hand) &&
                          graspGap(f, in.kindOf(f), hand) < 1.5f * kGraspRadius_m;
        return hand.grasp.encloses != id && !helpedTo(hand, id) && !lets;
    };
    const std::array<bool, 2> hits = {bats(0), bats(1)};
    const auto from = std::find_if(own.begin(), own.end(), [&](const auto& c) { return hits[c.group]; });
    const auto to = std::find_if(from, own.end(), [&](const auto& c) { return !hits[c.group]; });
    const std::span<const physics::Contact> pushing(from, to);
    const glm::vec3 kept = f.forward * f.speed + f.push; // without the separation, which leaves no speed
    f.push = limited(f.push + physics::pushed(kept, pushing) - kept, kMaxSpeed_mps);
    f.separation = physics::separating(pushing);
}

void wrapFingers(const physics::Capsule& body, Hand& hand) {
    hand.fingers.pressCount = 0;
    pressPalm(body, hand);
    for (int finger = 0; finger < hands::kFingerCount; ++finger) wrapFinger(finger, body, hand);
}

physics::Hold holdOn(int fish, const DiveState& state, glm::vec3 asked_N) {
    std::array<physics::Press, 2 * hands::kJointCount> presses;
    size_t count = 0;
    for (const Hand& hand : state.hands)
        if (hand.grasp.encloses == fish)
            for (int i = 0; i < hand.fingers.pressCount; ++i) presses[count++] = hand.fingers.presses[i];
    for (const physics::Contact& contact : state.contacts) // adds contacts of hands that only press on it
        if (static_cast<int>(contact.body) == fish && contact.lasting &&
            state.hands[contact.group].grasp.encloses != fish && count < presses.size())
            presses[count++] = {contact.normal, physics::pressForce_N(contact.depth)};
    return physics::hold({presses.data(), count}, asked_N);
}

static bool graspable(const Fish& f, const Hand& hand, int h, const DiveContext& in) {
    if (!in.mayBeTaken(f) || in.hides(f.position) || in.hides(hand.graspCentre) || !onPalmSide(f, hand))
        return false;
    const float gap = graspGap(f, in.kindOf(f), hand);
    const auto touched = [&](int part) { return f.touchedUntil[h][part] > in.state.tick; };
    const bool pinched =
        (touched(0) || touched(hands::kPalmPart)) && (touched(1) || touched(2) || touched(3) || touched(4));
    return gap < (pinched ? 2 : 1) * kGraspRadius_m;
}

// Returns the graspable fish nearest to the grasp centre, or -1.
static int nearestGraspable(const Hand& hand, int h, std::span<const Fish> fish, const DiveContext& in) {
    return leastCost(fish, kNever, [&](const Fish& f) {
        return graspable(f, hand, h, in) ? graspGap(f, in.kindOf(f), hand) : kNever;
    });
}

static void wrapAround(const Fish& f, Hand& hand, const DiveContext& in) {
    wrapFingers(capsuleOf(f, in.kindOf(f), physics::kEnclosed_m), hand);
}

static void grab(Fish& f, int id, Hand& hand, int h, const DiveContext& in, Events& events) {
    hand.grasp.holds = hand.grasp.encloses = id;
    hand.grasp.window = 0;
    hand.grasp.firmest = 1; // so that it takes hold again only after it has opened
    hand.lastMiss = Miss::None;
    f.state = Fish::State::Held;
    f.heldBy = h;
    f.push = glm::vec3(0);
    f.gait.set(in.thingOf(f) == Thing::None ? Motion::Struggle : Motion::Detached);
    f.hold = {};
    const glm::quat palmFromWorld = glm::conjugate(hand.palm().orientation);
    f.hold.palmFromBody = palmFromWorld * f.worldFromBody;
    f.hold.palmOffset = palmFromWorld * (f.position - hand.graspCentre);
    // A fish in a fist lies across the palm: its head out at the side it was heading for, its back towards
    // wrist or fingers.
    const glm::vec3 heading = f.hold.palmFromBody * glm::vec3(0, 0, 1), back = f.hold.palmFromBody * kUp;
    const glm::vec3 z(heading.x < 0 ? -1.0f : 1.0f, 0, 0), y(0, 0, back.z < 0 ? -1.0f : 1.0f);
    f.hold.palmFromBodyGoal = glm::quat_cast(glm::mat3(glm::cross(y, z), y, z));
    events.push_back({EventKind::Grab, id, h, f.position});
}

// Starts the flight of a released fish: away from the player and roughly the way it looks.
static void swimOff(Fish& f, glm::vec3 carried_mps, const DiveContext& in) {
    f.hold.struggle = 0;
    f.hold.noPush_s = physics::kLoose_s;
    f.heldBy = -1;
    f.state = Fish::State::Dart;
    f.flight.left_s = 1.2f;
    f.flight.rest_s = 1.5f;
    f.uncatchable_s = f.hold.counted ? kUncatchable_s : 0.6f;
    const glm::vec3 outward = normalizedOr(f.position - in.head() - 0.2f * kUp, {0, 0, -1});
    const glm::vec3 looks = f.worldFromBody * glm::vec3(0, 0, 1);
    f.flight.heading =
        normalizedOr(glm::vec3(outward.x, 0.2f * outward.y, outward.z) * 0.7f + looks * 0.5f, outward);
    f.forward = levelled(normalizedOr(looks, f.flight.heading), 0.6f);
    f.speed = std::min(0.5f, in.kindOf(f).dart_mps);
    f.push = limited(0.3f * carried_mps, 0.6f);
    f.velocity = f.forward * f.speed + f.push;
}

// Updates whether the hand is closed, and for how many ticks it may still take hold.
static void readGrip(Hand& hand) {
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
static void takeBetweenHands(Hands& hands, std::span<Fish> fish, const DiveContext& in, Events& events) {
    if (hands[0].grasp.holds >= 0 || hands[1].grasp.holds >= 0) return;
    bool taken = false;
    forEachCreature(in.state.contacts, [&](int id, std::span<const physics::Contact> own) {
        if (taken || own.front().group == own.back().group || id >= static_cast<int>(fish.size())) return;
        Fish& f = fish[id];
        if (!in.mayBeTaken(f) || in.hides(f.position) || in.thingOf(f) != Thing::None) return;
        if (holdOn(id, in.state, glm::vec3(0)).margin_N < physics::kFirm_N) return;
        const Species& kind = in.kindOf(f);
        const int h = graspGap(f, kind, hands[0]) < graspGap(f, kind, hands[1]) ? 0 : 1;
        grab(f, id, hands[h], h, in, events);
        taken = true;
    });
}

// Takes hold of the fish between the fingers, or else moves it into the hand. Returns whether it is held.
static bool takeHold(Hand& hand, int h, int id, Fish& f, const DiveContext& in, Events& events) {
    wrapAround(f, hand, in);
    hand.grasp.encloses = id;
    if (holdOn(id, in.state, glm::vec3(0)).margin_N > physics::kFirm_N) {
        grab(f, id, hand, h, in, events);
        return true;
    }
    if (id == hand.intent.fish && in.assist != Assist::None)
        helpClosing(f, hand, in);
    else
        f.push = pushIntoHollow(f, in.kindOf(f), hand);
    return false;
}

// Stings a hand that closes on a stinging species. Returns whether it did.
static bool sting(Hand& hand, int h, std::span<const Fish> fish, const DiveContext& in, Events& events) {
    const auto stings = [&](const Fish& f) {
        const Species& kind = in.kindOf(f);
        return kind.stings && onPalmSide(f, hand) && graspGap(f, kind, hand) <= kGraspRadius_m;
    };
    const auto found = std::ranges::find_if(fish, stings);
    if (found == fish.end()) return false;
    hand.stung_s = kSting_s;
    events.push_back({EventKind::Sting, static_cast<int>(found - fish.begin()), h, found->position});
    return true;
}

static void closeHand(Hand& hand, int h, std::span<Fish> fish, const DiveContext& in, Events& events) {
    Grasp& grasp = hand.grasp;
    const bool wasClosed = grasp.closed;
    readGrip(hand);
    if (grasp.closed && !wasClosed) hand.intent.miss = whyMissed(hand, fish, in);
    grasp.encloses = grasp.holds;
    if (grasp.holds >= 0) return wrapAround(fish[grasp.holds], hand, in);
    if (in.state.phase != Phase::Diving) return;
    if (hand.stung_s > 0) {
        grasp.window = 0;
        return;
    }
    const bool helped = in.assist != Assist::None && hand.intent.fish >= 0;
    if (grasp.window == 0) {
        if (helped && isClosing(hand)) helpClosing(fish[hand.intent.fish], hand, in);
        return;
    }
    if (sting(hand, h, fish, in, events)) return;
    const int id = helped ? hand.intent.fish : nearestGraspable(hand, h, fish, in);
    if (id >= 0 && takeHold(hand, h, id, fish[id], in, events)) return;
    if (--grasp.window > 0 || !grasp.closed) return;
    hand.lastMiss = hand.intent.miss;
    hand.sinceMiss_s = 0;
    events.push_back({.kind = eventOf(hand.lastMiss), .hand = h, .position = hand.graspCentre});
}

// Returns the force that a held fish asks of the grip.
static glm::vec3 askedForce_N(Fish& f, const Species& kind, const Hand& hand) {
    const float mass = physics::mass_kg(kind.bodyRadius_m, kind.bodyHalf_m);
    const float beat = tailBeat(f);
    f.hold.struggle = tired(f.hold.time_s) * (0.6f + 0.4f * beat);
    const glm::vec3 thrust =
        (f.forward + 0.5f * beat * leftOf(f.forward)) * (mass * physics::kStruggle_mps2 * f.hold.struggle);
    const float side = 2 * kind.bodyRadius_m * 2 * (kind.bodyHalf_m + kind.bodyRadius_m);
    const glm::vec3 drag = hand.calmVelocity * (0.5f * physics::kWater_kgpm3 * physics::kDragShape * side *
                                                glm::length(hand.calmVelocity));
    return thrust - drag - mass * hand.calmAcceleration;
}

// Advances the slipping of fish `id` in the hand: the grip's friction acts against the fish's struggle, the
// water's drag and the hand's acceleration. Returns false once the fish has slipped out.
static bool keepsHold(Fish& f, int id, const Hand& hand, const DiveContext& in) {
    const Species& kind = in.kindOf(f);
    const glm::quat palmFromWorld = glm::conjugate(hand.palm().orientation);
    FishHold& hold = f.hold;
    // The fish is drawn into the hollow of the hand at first; then friction keeps it where it lies.
    if (hold.time_s < physics::kSettle_s) {
        const glm::vec3 hollow = palmFromWorld * (hand.hollow(f.size * kind.bodyRadius_m) - hand.graspCentre);
        hold.palmOffset += (hollow - hold.palmOffset) * (20 * kDt);
    }
    const physics::Hold grip = holdOn(id, in.state, askedForce_N(f, kind, hand));
    if (grip.margin_N < 0) {
        const float mass = physics::mass_kg(kind.bodyRadius_m, kind.bodyHalf_m);
        hold.slide += palmFromWorld * grip.gives * (-grip.margin_N / mass * kDt);
        hold.slide = limited(hold.slide, physics::kSlideMax_mps);
    } else {
        hold.slide *= physics::kSlideGrip;
        if (glm::dot(hold.slide, hold.slide) < 1e-6f) hold.slid_m = 0;
    }
    hold.palmOffset += hold.slide * kDt;
    hold.slid_m += glm::length(hold.slide) * kDt;
    hold.unopposed = holdOn(id, in.state, glm::vec3(0)).margin_N > 0 ? 0 : hold.unopposed + 1;
    return hold.slid_m < physics::kSlideOut_m && hold.unopposed < physics::kUnopposed;
}

void closeHands(Hands& hands, std::span<Fish> fish, const DiveContext& in, Events& events) {
    for (int h = 0; h < 2; ++h) {
        Hand& hand = hands[h];
        if (hand.solid)
            closeHand(hand, h, fish, in, events);
        else if (!hand.visible && hand.grasp.holds >= 0 && hand.untrackedTicks > kHandDropTicks)
            drop(hand, h, fish, in, events);
    }
    if (in.state.phase == Phase::Diving) takeBetweenHands(hands, fish, in, events);
}

void drop(Hand& hand, int h, std::span<Fish> fish, const DiveContext& in, Events& events) {
    const int id = hand.grasp.holds;
    hand.grasp.holds = hand.grasp.encloses = -1;
    Fish& f = fish[id];
    if (in.thingOf(f) != Thing::None) return letGo(f, id, hand, h, in, events);
    swimOff(f, hand.calmVelocity, in);
    events.push_back({EventKind::Escape, id, h, f.position});
}

// Counts the held fish, which leaves the hand.
static void countCatch(Fish& f, int id, Hand& hand, int h, Score& score, const DiveContext& in,
                       Events& events) {
    const Species& kind = in.kindOf(f);
    const float length_m = lengthOf(f, kind);
    f.hold.counted = true;
    f.hold.struggle = 0;
    f.state = Fish::State::Shown;
    f.heldBy = hand.grasp.holds = hand.grasp.encloses = -1;
    const int points = score.countCatch(f.species, kind.points);
    float& largest_m = score.species[f.species].largest_m;
    largest_m = std::max(largest_m, length_m);
    events.push_back({.kind = EventKind::Catch,
                      .creature = id,
                      .hand = h,
                      .position = f.position,
                      .species = f.species,
                      .points = points,
                      .combo = score.combo(),
                      .length_m = length_m,
                      .mass_kg = kMass_kgpm3 * length_m * length_m * length_m});
}

void countCatches(Hands& hands, std::span<Fish> fish, Score& score, const DiveContext& in, Events& events) {
    for (int h = 0; h < 2; ++h) {
        Hand& hand = hands[h];
        const int id = hand.grasp.holds;
        if (id < 0) continue;
        Fish& f = fish[id];
        f.hold.time_s += kDt;
        f.bank = f.speed = 0;
        if (in.thingOf(f) != Thing::None) {
            if (!holdThing(f, id, hand, h, score, in, events)) drop(hand, h, fish, in, events);
            continue;
        }
        f.gait.set(Motion::Struggle);
        f.gait.advance(1.6f);
        if (hand.solid && !keepsHold(f, id, hand, in)) {
            drop(hand, h, fish, in, events);
            continue;
        }
        if (f.hold.time_s >= in.kindOf(f).hold_s + 0.5f * kDt) countCatch(f, id, hand, h, score, in, events);
    }
}

void showCatches(std::span<Fish> fish, const DiveContext& in, Events& events) {
    constexpr float kShownNear_m = 0.4f, kShownFar_m = 0.5f; // distance of a fish of no length from the eyes
    constexpr float kApproach_Hz = 5, kTurn_Hz = 9, kRise_mps = 0.04f;
    for (size_t i = 0; i < fish.size(); ++i) {
        Fish& f = fish[i];
        if (f.state != Fish::State::Shown) continue;
        const glm::vec3 was = f.position, fromHead = f.position - in.head();
        const float distance = glm::length(fromHead), room = 0.5f * lengthOf(f, in.kindOf(f));
        const glm::vec3 away = normalizedOr(fromHead, in.state.view.ahead());
        const float wanted = std::clamp(distance, kShownNear_m + room, kShownFar_m + room);
        f.position += away * ((wanted - distance) * kApproach_Hz * kDt) + kUp * (kRise_mps * kDt);
        f.position = in.film.pulledIn(f.position, capsuleOf(f, in.kindOf(f)), kMaxSpeed_mps * kDt);
        f.velocity = (f.position - was) / kDt;
        // It shows its side, and its face a little.
        const glm::vec3 left = leftOf(away), side = glm::dot(f.forward, left) < 0 ? -left : left;
        const glm::quat turned = bodyTurn(levelled(normalizedOr(side - 0.4f * away, side), 0.2f), 0);
        f.worldFromBody = blended(f.worldFromBody, turned, kTurn_Hz * kDt);
        f.forward = f.worldFromBody * glm::vec3(0, 0, 1);
        f.shape.amplitude = eased(f.shape.amplitude, tailAmplitude(0.5f), 12);
        for (float* bend : {&f.shape.bendLeft, &f.shape.bendUp}) *bend = eased(*bend, 0, 12);
        f.shape.beats += 2 * kDt;
        f.gait.set(Motion::Swim);
        f.gait.advance(1);
        f.hold.time_s += kDt;
        if (f.hold.time_s < in.kindOf(f).hold_s + kShowCatch_s) continue;
        swimOff(f, glm::vec3(0), in);
        events.push_back(
            {.kind = EventKind::Release, .creature = static_cast<int>(i), .position = f.position});
    }
}

void easeFingers(Hand& hand) {
    const glm::quat palm = hand.palm().orientation, palmFromWorld = glm::conjugate(palm);
    for (int j = 0; j < hands::kJointCount; ++j) {
        const hands::Joint& seen = hand.joints[j];
        hands::Joint& shown = hand.fingers.shown[j];
        FingerWrap::Lift& lift = hand.fingers.lifts[j];
        const glm::vec3 move = palmFromWorld * (shown.position - seen.position);
        const glm::quat turn = palmFromWorld * shown.orientation * glm::conjugate(seen.orientation) * palm;
        lift.move += (move - lift.move) * physics::kEase;
        lift.turn = blended(lift.turn, turn, physics::kEase);
        shown.position = seen.position + palm * lift.move;
        shown.orientation = palm * lift.turn * palmFromWorld * seen.orientation;
    }
}

void followHands(const Hands& hands, std::span<Fish> fish, const DiveContext& in) {
    for (const Hand& hand : hands) {
        if (hand.grasp.holds < 0) continue;
        Fish& f = fish[hand.grasp.holds];
        const glm::quat palm = hand.palm().orientation;
        const glm::vec3 was = f.position;
        // The tail beats at 4 Hz, strongest at first.
        const bool lives = in.thingOf(f) == Thing::None;
        const float beat = lives ? tailBeat(f) * (0.3f * tired(f.hold.time_s)) : 0;
        const glm::quat wriggle(1, 0, 0.5f * beat, 0.2f * beat);
        const float settle = std::min(1.0f, f.hold.time_s / physics::kSettle_s);
        f.worldFromBody =
            glm::normalize(palm * blended(f.hold.palmFromBody, f.hold.palmFromBodyGoal, settle) * wriggle);
        f.position =
            hand.graspCentre + palm * (f.hold.palmOffset + glm::vec3(0.012f * beat, 0, 0.02f * beat));
        f.forward = f.worldFromBody * glm::vec3(0, 0, 1);
        f.velocity = (f.position - was) / kDt;
    }
}

void struggle(Fish& f, const Hand& hand, Random& random) {
    if (f.hold.time_s == 0) {
        f.hold.struggles = true;
        f.hold.bout_s = 0.45f;
    } else if ((f.hold.bout_s -= kDt) <= 0) {
        f.hold.struggles = !f.hold.struggles;
        f.hold.bout_s = f.hold.struggles ? random.between(0.25f, 0.45f) : random.between(0.15f, 0.35f);
    }
    const float fresh = std::max(0.4f, 1 - 0.35f * f.hold.time_s);
    f.shape.beats += (f.hold.struggles ? 6.0f : 2.0f) * kDt;
    f.shape.amplitude = eased(f.shape.amplitude, f.hold.struggles ? 0.17f * fresh : 0.03f, 25);
    const glm::vec3 left = f.worldFromBody * glm::vec3(1, 0, 0), up = f.worldFromBody * kUp;
    const float curl = f.hold.struggles ? 0.9f * fresh : 0.5f;
    f.shape.bendLeft = eased(f.shape.bendLeft, curl * glm::dot(left, hand.outOfPalm()), 12);
    f.shape.bendUp = eased(f.shape.bendUp, 0.4f * curl * glm::dot(up, hand.outOfPalm()), 12);
    f.shape.finsDown = eased(f.shape.finsDown, 0, 6);
    f.route.gliding = false;
    f.flight.spent_s = f.flight.side = 0;
    f.spin = glm::vec3(0);
}

} // namespace shoal::game
