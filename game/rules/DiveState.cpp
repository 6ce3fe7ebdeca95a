#include "game/rules/DiveState.h"

#include "game/rules/Things.h"

#include <numeric>

namespace shoal::game {

// Fish and shark as a dive begins.

// Returns a random unit vector in the level plane, without trigonometry: rejection from the square.
static glm::vec3 randomAround(Random& random) {
    for (;;) {
        const float x = random.between(-1, 1), z = random.between(-1, 1);
        const float squared = x * x + z * z;
        if (squared > 0.01f && squared <= 1) return glm::vec3(x, 0, z) / std::sqrt(squared);
    }
}

// Makes a fish. Most fish of a school circle the same way; companions start beside their leader.
static Fish spawnOne(const School& school, int schoolIndex, const Species& kind, float mainDirection,
                     const Fish* leader, Random& random) {
    Fish fish;
    fish.species = school.species;
    fish.school = schoolIndex;
    Route& route = fish.route;
    route.radius = random.between(school.radiusLow_m, school.radiusHigh_m);
    route.height = random.between(school.heightLow_m, school.heightHigh_m);
    route.cruise_mps = kind.cruise_mps * random.between(0.8f, 1.25f);
    route.direction = random.unit() < 0.8f ? mainDirection : -mainDirection;
    route.wanderTicks = 1 + static_cast<int>(random.below(200));
    route.changeTicks = 600 + static_cast<int>(random.below(1200));
    glm::vec3 outward = randomAround(random);
    glm::vec3 position = outward * route.radius + glm::vec3(0, route.height, 0);
    if (leader) {
        route.follow(leader->route);
        route.cruise_mps = leader->route.cruise_mps;
        // One draw a statement: the order in which arguments are evaluated is the compiler's choice.
        const float z = random.between(-1, 1), y = random.between(-0.7f, 0.7f), x = random.between(-1, 1);
        position = leader->position + 2.2f * kind.spacing * kind.length_m * glm::vec3(x, y, z);
        position.y = std::clamp(position.y, school.heightLow_m, school.heightHigh_m);
        outward = normalizedOr({position.x, 0, position.z}, outward);
    }
    startCircling(fish, position, outward, route.direction, route.cruise_mps);
    fish.gait.phase_s = random.between(0, 2);
    if (kind.thing != Thing::None) startDrifting(fish, kind);
    return fish;
}

// Makes twelve random fish or things, and returns the one that is farthest from all others.
static Fish spawnWithRoom(const DiveFiles& files, int schoolIndex, float mainDirection, const Fish* leader,
                          const std::vector<Fish>& others, Random& random) {
    const School& school = files.dive.schools[schoolIndex];
    Fish best;
    float bestRoom = -1;
    for (int attempt = 0; attempt < 12; ++attempt) {
        const Fish candidate =
            spawnOne(school, schoolIndex, files.species[school.species], mainDirection, leader, random);
        float room = 10;
        for (const Fish& other : others)
            room = std::min(room, glm::distance(candidate.position, other.position));
        if (room <= bestRoom) continue;
        best = candidate;
        bestRoom = room;
    }
    return best;
}

void spawnFish(const DiveFiles& files, Random& random, Random sizes, std::vector<Fish>& out) {
    out.clear();
    for (size_t i = 0; i < files.dive.schools.size(); ++i) {
        const School& school = files.dive.schools[i];
        const float mainDirection = random.unit() < 0.5f ? 1.0f : -1.0f;
        const Company company = files.species[school.species].company;
        int leader = -1;
        for (int n = 0; n < school.count; ++n) {
            const bool joins = company == Company::Shoal ? n > 0 : company == Company::Pair && n % 2;
            if (!joins) leader = static_cast<int>(out.size());
            Fish fish = spawnWithRoom(files, static_cast<int>(i), mainDirection,
                                      joins ? &out[leader] : nullptr, out, random);
            fish.route.leader = leader;
            const Species& kind = files.species[school.species];
            const float more = sizes.unit(), less = sizes.unit(); // middle sizes are the most common
            if (kind.thing == Thing::None) fish.size = 1 + kind.varies * (more - less);
            out.push_back(fish);
        }
    }
}

Shark spawnShark(const DiveFiles& files, Random& random) {
    const SharkPlan& plan = files.dive.shark;
    Shark shark;
    shark.present = plan.species >= 0;
    if (!shark.present) return shark;
    shark.species = plan.species;
    const glm::vec3 outward = randomAround(random);
    shark.direction = random.unit() < 0.5f ? 1.0f : -1.0f;
    startCircling(shark, outward * plan.radius_m + glm::vec3(0, plan.height_m, 0), outward, shark.direction,
                  files.species[shark.species].cruise_mps);
    shark.gait.motion = shark.gait.before = Motion::Cruise;
    return shark;
}

// Hands.

constexpr int kKeepTicks = 12; // a hand lost for less than 0.1 s stays where it was

static bool nearUnit(const glm::quat& q) {
    const float norm = glm::dot(q, q);
    return norm > 0.9f && norm < 1.1f; // false for NaN
}

// Zeroes the velocities of a hand that appears or jumps, so that it pushes no fish and takes hold of none.
static void stop(Hand& hand) {
    hand.velocity = hand.calmVelocity = hand.ownVelocity = hand.calmAcceleration = glm::vec3(0);
    hand.velocities.fill(glm::vec3(0));
    hand.trail.fill(hand.palm().position);
    hand.grasp.window = 0;
}

static void believe(const hands::HandPose& given, Hand& hand) {
    if (given.tracked && hands::plausible(given)) {
        hand.lastGood = given;
        hand.known = true;
        hand.untrackedTicks = 0;
    } else
        ++hand.untrackedTicks;
    hand.visible = hand.known && hand.untrackedTicks <= kKeepTicks;
    hand.solid = hand.visible && hand.lastGood.solid;
    if (!hand.visible) hand.untrackedTicks = std::min(hand.untrackedTicks, 10 * kHandDropTicks);
}

static void placeJoints(const Viewpoint& view, Hand& hand) {
    for (int j = 0; j < hands::kJointCount; ++j) {
        hand.joints[j] = hand.lastGood.joints[j];
        hand.joints[j].position =
            view.headWorld + view.worldFromView * (hand.joints[j].position + hand.intent.movedView);
        hand.joints[j].orientation = view.worldFromView * hand.joints[j].orientation;
    }
    hand.fingers.shown = hand.joints;
    hand.graspCentre = hands::graspCentre(hand.joints);
    hand.grip = std::clamp(hand.lastGood.grip, 0.0f, 1.0f);
}

// Marks a hand that appears as a fist as closed already, so that it takes hold of nothing.
static void startGrasp(Hand& hand) {
    hand.fingers.lifts = {};
    hand.grasp.closed = hand.grasp.holds >= 0 || hand.grip > kGripCloses;
    hand.grasp.firmest = std::max(hand.grip, kGripOpens);
}

// palmBefore: the palm's position in the last tick, viewer's frame.
static void updateVelocities(glm::vec3 palmBefore, const Viewpoint& view, Hand& hand) {
    hand.velocity = (hand.palm().position - hand.before[hands::kPalmJoint].position) / kDt;
    const glm::vec3 change = (hand.velocity - hand.calmVelocity) * (1.0f / 6);
    hand.calmVelocity += change;
    std::shift_right(hand.trail.begin(), hand.trail.end(), 1);
    hand.trail[0] = hand.palm().position;
    const glm::vec3 own =
        view.worldFromView * ((hand.lastGood.joints[hands::kPalmJoint].position - palmBefore) / kDt);
    hand.ownVelocity += (own - hand.ownVelocity) * (1.0f / 6);
    hand.calmAcceleration += (change / kDt - hand.calmAcceleration) * (1.0f / 6);
    for (int j = 0; j < hands::kJointCount; ++j) {
        const glm::vec3 now = (hand.joints[j].position - hand.before[j].position) / kDt;
        hand.velocities[j] += (now - hand.velocities[j]) * (1.0f / 3);
    }
}

static void trackHand(const hands::HandPose& given, const Viewpoint& view, Hand& hand) {
    const bool appears = !hand.visible;
    const glm::vec3 palmBefore = hand.lastGood.joints[hands::kPalmJoint].position;
    believe(given, hand);
    hand.touching = {};
    hand.fingers.pressCount = 0;
    if (!hand.visible) return stop(hand);
    if (!appears) hand.before = hand.joints;
    if (appears) hand.intent = {};
    const float gripBefore = hand.grip;
    placeJoints(view, hand);
    const float closing_Hz = appears ? 0 : (hand.grip - gripBefore) / kDt;
    hand.intent.closing_Hz += (closing_Hz - hand.intent.closing_Hz) * (1.0f / 4);
    if (appears) startGrasp(hand);
    const bool replaced =
        glm::distance(hand.palm().position, hand.before[hands::kPalmJoint].position) > physics::kTeleport_m;
    if (appears || replaced || !hand.solid) {
        hand.before = hand.joints;
        stop(hand);
    } else
        updateVelocities(palmBefore, view, hand);
}

void trackHands(const TickInput& input, Viewpoint& view, Hands& hands) {
    if (nearUnit(input.worldFromView)) view.worldFromView = glm::normalize(input.worldFromView);
    if (glm::dot(input.headWorld, input.headWorld) <= kHeadReach_m * kHeadReach_m)
        view.headWorld = input.headWorld;
    for (size_t i = 0; i < hands.size(); ++i) trackHand(input.hands[i], view, hands[i]);
}

// Goals.

std::vector<int> drawGoals(const std::vector<Goal>& all, uint64_t seed) {
    std::vector<int> drawn;
    if (all.size() <= kGoals) {
        drawn.resize(all.size());
        std::iota(drawn.begin(), drawn.end(), 0);
        return drawn;
    }
    Random random(seed, 2);
    for (int level = 1; level <= kLevels; ++level) {
        std::vector<int> open;
        for (size_t i = 0; i < all.size(); ++i) {
            const auto like = [&](int other) {
                return all[other].kind == all[i].kind &&
                       (all[i].kind == GoalKind::First || all[other].species == all[i].species);
            };
            if (all[i].level == level && std::ranges::none_of(drawn, like))
                open.push_back(static_cast<int>(i));
        }
        if (!open.empty()) drawn.push_back(open[random.below(static_cast<uint32_t>(open.size()))]);
    }
    return drawn;
}

void countForGoals(std::span<const Event> events, const DiveContext& in, GoalCounts& goalCounts) {
    for (const Event& event : events) {
        if (event.kind == EventKind::Catch) {
            std::shift_right(goalCounts.caughtAt.begin(), goalCounts.caughtAt.end(), 1);
            goalCounts.caughtAt[0] = in.state.tick;
            ++goalCounts.byHand[event.hand];
            ++goalCounts.calm;
            if (goalCounts.first < 0) goalCounts.first = event.species;
        } else if (event.kind == EventKind::Touch) {
            const Fish& fish = in.state.fish[event.creature];
            if (in.thingOf(fish) == Thing::None) goalCounts.touched |= uint64_t{1} << fish.species;
        } else if (event.kind == EventKind::Startle)
            goalCounts.calm = 0;
        goalCounts.guests += event.kind == EventKind::Feed;
        goalCounts.turned += event.kind == EventKind::SharkTurns;
    }
}

// Returns the number of catches within that time until the latest.
static int quickest(const Score& score, float within_s) {
    const auto& at = score.goalCounts.caughtAt;
    return static_cast<int>(
        std::count_if(at.begin(), at.begin() + std::min(score.caught, kMaxQuick), [&](auto tick) {
            return static_cast<float>(at[0] - tick) <= within_s * sim::kTickRate_Hz;
        }));
}

int progressOf(const Goal& goal, const Score& score) {
    const auto different = static_cast<int>(std::ranges::count_if(score.species, &SpeciesTally::caught)) -
                           std::popcount(score.things);
    const GoalCounts& goalCounts = score.goalCounts;
    const std::array<int, kGoalNames.size()> progress = {
        goal.species < 0 ? score.caught : score.species[goal.species].caught,
        different,
        score.points,
        score.lost == 0 ? score.caught : 0,
        score.bestCombo,
        quickest(score, goal.within_s),
        goalCounts.first >= 0 && goalCounts.first == goal.species ? 1 : 0,
        std::ranges::min(goalCounts.byHand),
        goalCounts.guests,
        goalCounts.turned,
        std::popcount(goalCounts.touched),
        goalCounts.calm}; // by GoalKind
    return std::min(progress[static_cast<size_t>(goal.kind)], goal.count);
}

bool isReached(const Goal& goal, const Score& score, bool over) {
    return progressOf(goal, score) >= goal.count && (over || goal.kind != GoalKind::NoLoss);
}

} // namespace shoal::game
