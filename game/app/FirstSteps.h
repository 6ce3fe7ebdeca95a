// The tutorial: three steps without a time limit, each of which ends when the player has done it; and hints
// in a dive, which appear when a rule matters. Reads snapshots and events only.
#pragma once

#include "engine/render/View.h"
#include "game/rules/DiveFile.h"
#include "game/rules/Snapshot.h"
#include "game/ui/Pen.h"
#include "input/hands/HandRig.h"

#include <array>
#include <optional>
#include <span>
#include <utility>

namespace shoal::app {

// Purpose of a session.
enum class Mode { Title, FirstSteps, Dive, FreeSwim };

// The tutorial of a session: the first steps, the hints of a dive, or the welcome of a free swim.
class Tutorial {
  public:
    enum class Step { Look, Reach, Hold, Done };

    Tutorial(Mode mode, hands::HandRig rig, game::SpeciesTable species)
        : mode_(mode), rig_(std::move(rig)), species_(std::move(species)) {}

    // Updates step and hint; call it once a frame. elapsed_s: time since the last call.
    void follow(const game::Snapshot& shown, std::span<const game::Event> events, float elapsed_s);
    // Draws the instruction, with a ghost hand that demonstrates a step.
    void draw(const Pen& pen, const render::View& view) const;

    Step step() const { return step_; }
    bool stepsAreOver() const { return done_s_ > kStay_s; } // and their last message has been shown
    // Returns the pose of the ghost hand, viewer's frame.
    hands::HandPose ghost(const render::View& view) const;
    std::optional<glm::vec3> target() const { return target_; } // goal of the ghost hand, world frame
    std::optional<game::Text> hint() const;

    static constexpr float kTurned_rad = 0.6f; // turn of the view that completes the step Look
    static constexpr float kNear_s = 0.25f;    // time within reach of a fish that ends the step Reach
    static constexpr float kShown_s = 3;       // duration of one demonstration by the ghost hand
    static constexpr float kAway_s = 3; // time without a fish in reach after which the step Reach comes back
    static constexpr float kStay_s = 2.5f, kWelcome_s = 9; // duration of the last message; of the welcome
    static constexpr int kHintTimes = 3;                   // how often each hint is shown at most
    static constexpr int kUnderstood = 3; // catches after which only the shark's hint is shown
    static constexpr float kHintStay_s = 5, kNoCatch_s = 14; // duration; time without a catch before Wait

  private:
    enum Hint { FastHand, Wait, Shark };
    void followSteps(const game::Snapshot& shown, float elapsed_s);
    void followHints(const game::Snapshot& shown, std::span<const game::Event> events, float elapsed_s);
    void drawStep(const Pen& pen, const render::View& view) const;
    void next(Step step) {
        step_ = step;
        inStep_s_ = 0;
        target_.reset(); // the view has turned, so another fish may be nearer to its middle
    }
    void showHint(Hint hint); // unless another is shown, or it was shown kHintTimes already

    Mode mode_;
    hands::HandRig rig_;
    game::SpeciesTable species_;
    float time_s_ = 0;
    float done_s_ = 0; // seconds since all steps were done; 0: not yet
    Step step_ = Step::Look;
    float inStep_s_ = 0, near_s_ = 0, away_s_ = 0;
    std::optional<glm::quat> firstView_;
    std::optional<glm::vec3> target_;
    std::array<int, 3> timesShown_{}; // how often each hint was shown
    std::optional<Hint> hint_;
    float hintLeft_s_ = 0, sinceCatch_s_ = 0;
    int caught_ = 0;
};

} // namespace shoal::app
