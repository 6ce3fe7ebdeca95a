#include "game/app/FirstSteps.h"

#include "input/hands/MouseHands.h"

#include <glm/common.hpp>
#include <imgui/imgui.h>

#include <algorithm>
#include <cmath>

namespace shoal::app {

constexpr float kReach_m = 1.2f; // farthest fish that the ghost hand reaches for
constexpr std::array<game::Text, 3> kHints = {"A fast hand frightens fish",
                                              "Wait in a fish’s way with an open hand",
                                              "Keep what you hold away from the shark"};

// Instructions for a player with mouse, gamepad or headset: [Step][Audience].
constexpr std::array<std::array<game::Text, 3>, 3> kHowTo = {{
    {"Arrow keys, or hold the right mouse button and move", "Left stick", "Turn your head"},
    {"Move the mouse slowly: a fast hand frightens fish", "Right stick, slowly: a fast hand frightens fish",
     "Move slowly: a fast hand frightens fish"},
    {"Hold the left mouse button for one second", "Hold the right trigger for one second", "For one second"},
}};

// Returns the catchable fish within reach that is nearest to the middle of the view.
static std::optional<glm::vec3> fishToReach(const game::Snapshot& shown, const game::SpeciesTable& species) {
    std::optional<glm::vec3> best;
    float bestCosine = 0.9f; // cosine of 26 degrees: fish farther from the middle may lie outside the picture
    const glm::vec3 ahead = shown.worldFromView * glm::vec3(0, 0, -1);
    for (const game::CreatureView& creature : shown.creatures) {
        const glm::vec3 way = creature.position - shown.headWorld;
        const float distance = glm::length(way);
        if (!isFish(species[creature.species])) continue;
        if (distance > kReach_m || distance < 0.3f) continue;
        const float cosine = glm::dot(way / distance, ahead);
        if (cosine > bestCosine) bestCosine = cosine, best = creature.position;
    }
    return best;
}

static bool holdsAFish(const game::Snapshot& shown, const game::SpeciesTable& species) {
    return std::ranges::any_of(shown.hands, [&](const game::HandView& hand) {
        return hand.holds >= 0 && isFish(species[shown.creatures[static_cast<size_t>(hand.holds)].species]);
    });
}

// Draws a hand in white with a dark outline: each bone as a line with round ends, and the palm over them.
static void drawGhost(const Pen& pen, const render::View& view, const hands::HandPose& hand) {
    const glm::vec2 half = view.halfExtent();
    const auto onScreen = [&](int joint) {
        const glm::vec3 p = hand.joints[joint].position;
        const float depth = std::max(-p.z, 0.05f);
        return ImVec2((0.5f + 0.5f * p.x / (depth * half.x)) * pen.size.x,
                      (0.5f - 0.5f * p.y / (depth * half.y)) * pen.size.y);
    };
    const float depth = std::max(-hand.joints[hands::kPalmJoint].position.z, 0.1f);
    const float radius = 0.009f / (depth * half.y) * 0.5f * pen.size.y;
    const auto bone = [&](int from, int to, float thicker, uint32_t colour) {
        const ImVec2 a = onScreen(from), b = onScreen(to);
        pen.list->AddLine(a, b, colour, 2 * (radius + thicker));
        pen.list->AddCircleFilled(a, radius + thicker, colour);
        pen.list->AddCircleFilled(b, radius + thicker, colour);
    };
    const auto finger = [&](int number, float thicker, uint32_t colour) {
        const hands::FingerJoints& joints = hands::kFingerJoints[number];
        for (int joint = joints.proximal; joint < joints.tip; ++joint)
            bone(joint, joint + 1, thicker, colour);
    };
    const auto palm = [&](float thicker, uint32_t colour) {
        for (int number = 0; number < hands::kFingerCount; ++number) {
            const hands::FingerJoints& joints = hands::kFingerJoints[number];
            bone(hands::kWristJoint, joints.metacarpal, thicker, colour);
            bone(joints.metacarpal, joints.proximal, thicker, colour);
            if (number + 1 == hands::kFingerCount) break;
            const hands::FingerJoints& beside = hands::kFingerJoints[number + 1];
            pen.list->AddTriangleFilled(onScreen(hands::kWristJoint), onScreen(joints.proximal),
                                        onScreen(beside.proximal), colour);
        }
    };
    constexpr uint32_t kOutline = IM_COL32(4, 22, 34, 255), kSign = IM_COL32(235, 248, 255, 255);
    palm(0.12f * pen.line, kOutline);
    for (int number = 0; number < hands::kFingerCount; ++number) {
        finger(number, 0.12f * pen.line, kOutline); // separates neighbouring fingers, even in a fist
        finger(number, 0, kSign);
    }
    palm(0, kSign);
}

// Draws a left and a right arrow, which move outwards in turn. round: progress of the demonstration, 0 to 1.
static void drawTurning(const Pen& pen, float round) {
    for (const float side : {-1.0f, 1.0f}) {
        const float phase = side > 0 ? 2 * round : 2 * round - 1; // progress in its half of the round
        const float out = phase > 0 && phase < 1 ? std::sin(3.14159265f * phase) : 0.0f;
        const float x = pen.size.x * (0.5f + side * (0.2f + 0.06f * out)), y = pen.size.y * 0.5f;
        const auto arrow = [&](float size, uint32_t colour) {
            pen.list->AddTriangleFilled(ImVec2(x - side * 0.4f * size, y - size),
                                        ImVec2(x - side * 0.4f * size, y + size),
                                        ImVec2(x + side * 0.8f * size, y), colour);
        };
        arrow(1.5f * pen.line, IM_COL32(4, 22, 34, 255));
        arrow(1.2f * pen.line, IM_COL32(235, 248, 255, 255));
    }
}

void Tutorial::followSteps(const game::Snapshot& shown, float elapsed_s) {
    inStep_s_ += elapsed_s;
    if (!firstView_) firstView_ = shown.worldFromView;
    const glm::quat turn = glm::conjugate(*firstView_) * shown.worldFromView;
    const float turned_rad = 2 * std::atan2(glm::length(glm::vec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
    const bool catchable =
        std::ranges::any_of(shown.creatures, [](const auto& creature) { return creature.catchable > 0.5f; });
    near_s_ = catchable ? near_s_ + elapsed_s : 0;
    away_s_ = catchable || holdsAFish(shown, species_) ? 0 : away_s_ + elapsed_s;
    // The target stays for one demonstration, so that the ghost hand does not jump from fish to fish.
    if (!target_ || std::fmod(inStep_s_, kShown_s) < elapsed_s) target_ = fishToReach(shown, species_);

    if (shown.caught > 0) return next(Step::Done); // a catch takes all steps, so the player knows them
    if (step_ == Step::Look && turned_rad > kTurned_rad) return next(Step::Reach);
    if (step_ == Step::Reach && near_s_ > kNear_s) return next(Step::Hold);
    if (step_ == Step::Hold && away_s_ > kAway_s) next(Step::Reach); // the fish may have swum away
}

// The ghost hand reaches its place in the first half of a round and acts in the second.
hands::HandPose Tutorial::ghost(const render::View& view) const {
    const float round = std::fmod(inStep_s_, kShown_s) / kShown_s;
    const glm::vec3 rest(0.22f, -0.26f, -0.5f);
    glm::vec3 goal(0, 0, -0.7f);
    if (target_) goal = glm::conjugate(view.worldFromEye) * (*target_ - view.eyeWorld);
    const glm::vec3 at = glm::mix(rest, goal, glm::smoothstep(0.0f, 1.0f, round * 2));
    const float closed = step_ == Step::Hold ? glm::smoothstep(0.0f, 1.0f, (round - 0.5f) * 6) : 0.0f;
    return hands::reachingHand(rig_, hands::Side::Right, at, closed);
}

void Tutorial::drawStep(const Pen& pen, const render::View& view) const {
    if (step_ == Step::Done) return;
    if (step_ == Step::Look)
        drawTurning(pen, std::fmod(inStep_s_, kShown_s) / kShown_s);
    else
        drawGhost(pen, view, ghost(view));
    constexpr std::array<game::Text, 3> kTitles = {"Look around", "Reach for a fish until it glows",
                                                   "Close your hand and hold the fish"};
    const auto index = static_cast<size_t>(step_);
    const float x = pen.size.x / 2;
    const Rectangle title = pen.label(x, pen.size.y * 0.1f, TextSize::Heading, colour::kWhite,
                                      std::to_string(index + 1) + " / 3   " + pen.in(kTitles[index]));
    pen.label(x, title.high.y + 0.4f * pen.line, TextSize::Body, colour::kGold,
              pen.in(kHowTo[index][static_cast<size_t>(pen.audience)]));
}

void Tutorial::showHint(Hint hint) {
    if (hint_ || timesShown_[hint] >= kHintTimes) return;
    ++timesShown_[hint];
    hint_ = hint;
    hintLeft_s_ = kHintStay_s;
}

void Tutorial::followHints(const game::Snapshot& shown, std::span<const game::Event> events,
                           float elapsed_s) {
    if (shown.paused) return;
    hintLeft_s_ -= elapsed_s;
    if (hintLeft_s_ <= 0) hint_.reset();
    sinceCatch_s_ = shown.caught > caught_ ? 0 : sinceCatch_s_ + elapsed_s;
    caught_ = shown.caught;
    for (const game::Event& event : events) {
        if (event.kind == game::EventKind::SharkNear && holdsAFish(shown, species_)) showHint(Shark);
        if (event.kind == game::EventKind::MissTooFast && caught_ < kUnderstood) showHint(FastHand);
    }
    if (sinceCatch_s_ > kNoCatch_s && caught_ < kUnderstood) {
        showHint(Wait);
        sinceCatch_s_ = 0;
    }
}

std::optional<game::Text> Tutorial::hint() const {
    return hint_ ? std::optional(kHints[*hint_]) : std::nullopt;
}

void Tutorial::follow(const game::Snapshot& shown, std::span<const game::Event> events, float elapsed_s) {
    time_s_ += elapsed_s;
    if (mode_ == Mode::Dive) followHints(shown, events, elapsed_s);
    if (mode_ != Mode::FirstSteps) return;
    followSteps(shown, elapsed_s);
    if (step_ == Step::Done) done_s_ += elapsed_s;
}

void Tutorial::draw(const Pen& pen, const render::View& view) const {
    if (pen.audience == Audience::Onlooker) return;
    const auto say = [&](game::Text text) {
        pen.label(pen.size.x / 2, pen.size.y * 0.14f, TextSize::Body, colour::kWhite, pen.in(text));
    };
    if (mode_ == Mode::FirstSteps) drawStep(pen, view);
    if (done_s_ > 0) say("Well caught! Now for real: 90 seconds");
    if (const auto text = hint()) say(*text);
    if (mode_ == Mode::FreeSwim && time_s_ < kWelcome_s)
        say("Fish swim past and look at you. Touch them: the field guide remembers every animal that you "
            "meet.");
}

} // namespace shoal::app
