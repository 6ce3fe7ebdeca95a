#include "tests/bench/player/Player.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::player {

namespace {

constexpr float kHandLength_m = 0.19f;
constexpr double kMotion_s = 0.1; // over which motion is seen

glm::vec2 project(glm::vec3 view) { return glm::vec2(view) * (kFocal_px / -view.z); }

const SeenFish* find(const Sight& sight, int id) {
    for (const SeenFish& fish : sight.fish)
        if (fish.id == id) return &fish;
    return nullptr;
}

constexpr float kTires_s = 3;       // of a chase...
constexpr float kTiredFor_s = 5;    // ...and then avoids that fish for so long
constexpr float kWaits_s = 3;       // for a fish to come
constexpr float kPatience_s = 1.2f; // with a fish that looks right and does not light up
constexpr float kTurn_radps = 1.2f;
constexpr float kJudgement_m = 0.05f; // error of depth with a hand in space, at first
constexpr glm::vec3 kHandRests(0.12f, -0.15f, -0.55f);

// Fitts' law, seconds: a + b log2(distance / width + 1).
struct Fitts {
    float a_s, b_s;
};
constexpr Fitts kMouseFitts{0.12f, 0.15f}, kHandFitts{0.18f, 0.16f};

glm::vec3 rayOf(glm::vec2 px) { return glm::normalize(glm::vec3(px / kFocal_px, -1)); }

} // namespace

void Eyes::look(const game::Snapshot& shown, const game::SpeciesTable& species, double time_s) {
    Sight sight;
    sight.time_s = time_s;
    const glm::quat viewFromWorld = glm::conjugate(shown.worldFromView);
    for (const game::CreatureView& creature : shown.creatures) {
        const glm::vec3 view = viewFromWorld * (creature.position - shown.headWorld);
        if (view.z > -0.15f) continue;
        const glm::vec2 at = project(view);
        if (std::fabs(at.x) > kHalfScreen_px.x || std::fabs(at.y) > kHalfScreen_px.y) continue;
        sight.fish.push_back({static_cast<int>(creature.id), creature.species, at,
                              creature.length * kFocal_px / -view.z, creature.catchable > 0.5f,
                              game::isFish(species[creature.species]),
                              species[creature.species].thing == game::Thing::Mussel, creature.heldBy >= 0,
                              glm::length(view)});
    }
    const game::HandView& hand = shown.hands[1];
    const glm::vec3 view = viewFromWorld * (hands::graspCentre(hand.joints) - shown.headWorld);
    sight.hand_px = project(view);
    sight.handSize_px = kHandLength_m * kFocal_px / std::max(0.1f, -view.z);
    sight.handDistance_m = glm::length(view);
    sight.holds = hand.holds >= 0;
    sights_.push_back(std::move(sight));
    while (sights_.size() > 1 && sights_[1].time_s <= time_s - kReaction_s) {
        if (sights_.front().time_s - before_.time_s > kMotion_s) before_ = sights_.front();
        sights_.pop_front();
    }
}

glm::vec2 Eyes::velocity_px(int id) const {
    const SeenFish* then = find(before_, id);
    const SeenFish* here = find(now(), id);
    const double elapsed_s = now().time_s - before_.time_s;
    if (!then || !here || elapsed_s < 0.02 || elapsed_s > 0.3) return glm::vec2(0);
    return (here->at_px - then->at_px) / static_cast<float>(elapsed_s);
}

void Movement::start(glm::vec3 from, glm::vec3 to, double now_s, float length_s) {
    from_ = from;
    to_ = to;
    begin_s_ = now_s;
    end_s_ = now_s + length_s;
}

glm::vec3 Movement::at(double time_s) const {
    if (end_s_ <= begin_s_) return to_;
    const float t = std::clamp(static_cast<float>((time_s - begin_s_) / (end_s_ - begin_s_)), 0.0f, 1.0f);
    return from_ + (to_ - from_) * (t * t * t * (10 - 15 * t + 6 * t * t));
}

Player::Player(Skill skill, Device device, float arm_m, uint64_t seed, const game::SpeciesTable& species,
               bool cracksMussels)
    : skill_(skill), device_(device), arm_m_(arm_m), random_(seed, 77), species_(species),
      cracksMussels_(cracksMussels) {
    for (const game::Species& kind : species)
        length_m_.push_back(kind.length_m *
                            std::exp((skill == Skill::Novice ? 0.25f : 0.1f) * gauss(random_)));
    const glm::vec3 start = device == Device::Mouse ? glm::vec3(0) : kHandRests;
    movement_.start(start, start, 0, 0);
    turn_ = random_.unit() < 0.5f ? -1.0f : 1.0f;
}

float gauss(Random& random) { // Box & Muller 1958
    const float a = 1 - random.unit(), b = random.unit();
    return std::sqrt(-2 * std::log(a)) * std::cos(2 * std::numbers::pi_v<float> * b);
}

Action Player::frame(const game::Snapshot& shown, double time_s) {
    eyes_.look(shown, species_, time_s);
    if (time_s >= idleUntil_s_) {
        if (doing_ == Doing::Resting) begin(Doing::Looking, time_s);
        if (doing_ == Doing::Looking)
            look(time_s);
        else if (doing_ == Doing::Waiting)
            wait(time_s);
        else if (doing_ == Doing::Chasing)
            chase(time_s);
        else
            hold(time_s);
    }
    Action action;
    const glm::vec3 place = movement_.at(time_s);
    action.cursor_px = glm::clamp(glm::vec2(place), -kHalfScreen_px, kHalfScreen_px);
    action.grasp = place;
    action.close = close_;
    action.turn_radps = time_s < turnUntil_s_ ? turn_ * kTurn_radps : 0;
    return action;
}

// Returns the judged distance: by apparent size on a screen, else by stereo vision with an error.
float Player::judgedDistance_m(const SeenFish& fish) const {
    if (device_ == Device::Hands) return fish.distance_m + misjudged_m_;
    return length_m_[fish.species] * kFocal_px / fish.size_px;
}

// Returns the fish that is easiest to get: near the hand, near the eye, slow; -1: none.
int Player::choose(double time_s) const {
    const Sight& sight = eyes_.now();
    int best = -1;
    float bestCost = 1e9f;
    for (const SeenFish& fish : sight.fish) {
        const bool bait = fish.mussel && cracksMussels_ && time_s >= nextMussel_s_;
        if ((!fish.prey && !bait) || fish.held) continue;
        if (std::fabs(fish.at_px.x) > 560 || std::fabs(fish.at_px.y) > 320) continue;
        const auto tired = tiredOf_.find(fish.id);
        if (tired != tiredOf_.end() && time_s < tired->second) continue;
        const float distance_m = judgedDistance_m(fish), speed_px = glm::length(eyes_.velocity_px(fish.id));
        if (distance_m > 1.7f || speed_px > 700) continue; // looks small, or flees
        float cost = glm::distance(fish.at_px, sight.hand_px) / 300 + distance_m / 0.7f + speed_px / 250;
        if (fish.marked) cost -= 2;
        if (bait) cost -= 1.5f;
        if (cost < bestCost) bestCost = cost, best = fish.id;
    }
    return best;
}

void Player::look(double time_s) {
    target_ = choose(time_s);
    if (target_ >= 0) {
        begin(Doing::Chasing, time_s);
        turnUntil_s_ = 0;
        rightSince_s_ = -1;
        judged_s_ = time_s;
        misjudged_m_ = kJudgement_m * gauss(random_);
        return;
    }
    // Waits a while for one to come, then looks elsewhere.
    if (time_s - since_s_ > 1.5 && time_s >= turnUntil_s_) {
        if (random_.unit() < 0.2f) turn_ = -turn_;
        turnUntil_s_ = time_s + random_.between(0.4f, 0.9f);
        since_s_ = turnUntil_s_ - 1.0;
    }
}

void Player::giveUp(double time_s) {
    tiredOf_[target_] = time_s + kTiredFor_s;
    begin(Doing::Waiting, time_s);
}

void Player::begin(Doing what, double time_s) {
    doing_ = what;
    since_s_ = time_s;
}

// Lets the hand rest where it is, in the path of fish that come.
void Player::wait(double time_s) {
    for (const SeenFish& fish : eyes_.now().fish)
        if (fish.marked && fish.prey) {
            target_ = fish.id;
            return close(time_s);
        }
    if (time_s - since_s_ >= kWaits_s) begin(Doing::Looking, time_s);
}

// Returns the goal of the pointer or the hand. ahead_s: time since the picture, over which the practised
// extrapolate the fish's movement.
glm::vec3 Player::goalFor(const SeenFish& fish, float ahead_s) const {
    const float lead_s = skill_ == Skill::Practised ? ahead_s : 0;
    const glm::vec2 px = fish.at_px + eyes_.velocity_px(fish.id) * lead_s;
    if (device_ == Device::Mouse) return glm::vec3(px, 0);
    return rayOf(px) * std::clamp(judgedDistance_m(fish), 0.3f, arm_m_);
}

void Player::startMoving(glm::vec3 goal, float width, double time_s) {
    const glm::vec3 from = movement_.at(time_s);
    const float way = glm::distance(from, goal);
    const Fitts law = device_ == Device::Mouse ? kMouseFitts : kHandFitts;
    const float calm = skill_ == Skill::Novice ? 1.4f : 1.15f; // a slow hand
    const float length_s = calm * (law.a_s + law.b_s * std::log2(way / width + 1));
    const float sd = (skill_ == Skill::Novice ? 0.05f : 0.035f) * way + 0.04f * width;
    glm::vec3 end = goal;
    end.x += sd * gauss(random_);
    end.y += sd * gauss(random_);
    if (device_ == Device::Hands) end.z += sd * gauss(random_);
    movement_.start(from, end, time_s, length_s);
}

void Player::point(const SeenFish& fish, double time_s) {
    if (!movement_.over(time_s)) return;
    const bool mouse = device_ == Device::Mouse;
    const float width = mouse ? std::max(0.5f * fish.size_px, 20.0f) : 0.05f;
    const float off = glm::distance(movement_.at(time_s), goalFor(fish, kReaction_s));
    if (off < 0.4f * width) return;
    const Fitts law = mouse ? kMouseFitts : kHandFitts;
    const float takes_s = law.a_s + law.b_s * std::log2(off / width + 1);
    startMoving(goalFor(fish, kReaction_s + takes_s), width, time_s);
}

// Returns whether to close: on the highlight, or after longer with the hand at the fish's judged place.
bool Player::looksRight(const SeenFish& fish, double time_s) {
    const Sight& sight = eyes_.now();
    const float near_px = 0.5f * fish.size_px + 1.5f * kDegree_px;
    const float hand_m =
        device_ == Device::Hands ? sight.handDistance_m : 0.19f * kFocal_px / sight.handSize_px;
    const float fish_m = judgedDistance_m(fish);
    const bool over = glm::distance(fish.at_px, sight.hand_px) < near_px &&
                      std::fabs(fish_m - hand_m) < (device_ == Device::Hands ? 0.06f : 0.25f * fish_m);
    if (!over) rightSince_s_ = -1;
    if (over && rightSince_s_ < 0) rightSince_s_ = time_s;
    return fish.marked || (over && time_s - rightSince_s_ > kPatience_s);
}

void Player::chase(double time_s) {
    const SeenFish* fish = find(eyes_.now(), target_);
    if (!fish || fish->held) return begin(Doing::Looking, time_s);
    if (time_s - since_s_ > kTires_s) return giveUp(time_s);
    // Another that lights up beside it is as good.
    for (const SeenFish& other : eyes_.now().fish)
        if (other.marked && other.prey && !fish->marked) fish = &other, target_ = other.id;
    if (device_ == Device::Hands && time_s - judged_s_ > 0.4) {
        misjudged_m_ *= 0.6f; // hand and fish side by side show how far off it is
        judged_s_ = time_s;
    }
    point(*fish, time_s);
    if (looksRight(*fish, time_s)) close(time_s);
}

void Player::close(double time_s) {
    close_ = true;
    begin(Doing::Holding, time_s);
    const bool novice = skill_ == Skill::Novice;
    holdFor_s_ = std::max(1.25f, (novice ? 1.5f : 1.4f) + 0.12f * gauss(random_));
    const SeenFish* held = find(eyes_.now(), target_);
    if (held) holdFor_s_ += species_[held->species].hold_s - 1; // until the ring is full
    if (held && held->mussel) {
        holdFor_s_ = 0.8f;
        nextMussel_s_ = time_s + 8;
    }
}

void Player::hold(double time_s) {
    const double held_s = time_s - since_s_;
    // Sees that the hand is empty, and what became of it.
    const bool missed = held_s > 0.5 && !eyes_.now().holds;
    if (held_s < holdFor_s_ && !missed) return;
    close_ = false;
    tiredOf_[target_] = time_s + 2;
    // Fish come to its cracked mussel, so it waits for them.
    begin(time_s < nextMussel_s_ ? Doing::Waiting : Doing::Resting, time_s);
    const bool novice = skill_ == Skill::Novice;
    idleUntil_s_ =
        time_s + static_cast<double>(novice ? random_.between(0.5f, 1.0f) : random_.between(0.3f, 0.6f));
}

} // namespace shoal::player
