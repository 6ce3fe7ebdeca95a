// A display in an OpenXR headset: pictures for both eyes, text on a panel in front of the player, and the
// middle of the left eye's picture in a window for onlookers. The headset's clock is the game's.
#pragma once

#include "engine/math/Trigonometry.h"
#include "engine/platform/Window.h"
#include "engine/render/HeadsetPasses.h"
#include "engine/xr/Headset.h"
#include "game/app/Display.h"
#include "input/hands/HandRig.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace shoal::app {

// Placement of the text panel in a headset: in front of the player, upright. It follows the head smoothly,
// and only once the head looks well aside.
class PanelPlacement {
  public:
    static constexpr float kDistance_m = 1.5f;
    static constexpr float kBelow_m = 0.1f;      // below the eyes, which is more comfortable
    static constexpr float kLag_rad = 0.6f;      // turn of the head at which the panel starts to follow
    static constexpr float kSettled_rad = 0.05f; // remaining angle at which it stops
    static constexpr float kTurn_s = 0.35f, kMove_s = 0.5f; // time constants

    // Returns the panel's pose, at first ahead of the head; once a frame. Worlds as in xr::Tracking.
    xr::Pose follow(const xr::Pose& worldFromHead, float dt_s) {
        const xr::Pose upright = xr::originAt(worldFromHead);
        const float headYaw = 2 * std::atan2(upright.orientation.y, upright.orientation.w);
        if (!placed_) {
            placed_ = true;
            yaw_ = headYaw;
            centre_ = upright.position;
        }
        const float aside = std::remainder(headYaw - yaw_, 2 * std::numbers::pi_v<float>);
        if (std::abs(aside) > kLag_rad) turning_ = true;
        if (std::abs(aside) < kSettled_rad) turning_ = false;
        if (turning_) yaw_ += aside * math::followShare(dt_s, kTurn_s);
        centre_ += (upright.position - centre_) * math::followShare(dt_s, kMove_s);
        const glm::quat turn = glm::angleAxis(yaw_, glm::vec3(0, 1, 0));
        return {centre_ + turn * glm::vec3(0, -kBelow_m, -kDistance_m), turn};
    }

  private:
    bool placed_ = false, turning_ = false;
    float yaw_ = 0; // about +Y
    glm::vec3 centre_{0};
};

struct HeadsetMoment {
    bool plays = false;                // the headset is worn and shows no menus of its own
    bool headTracked = false;          // the head's orientation is known
    bool menu = false;                 // a controller's menu button is down
    bool results = false;              // the dive is over
    std::array<float, 2> grip{-1, -1}; // 0 open to 1 fist; negative: that hand is not seen
};

// Pauses and resumes a dive in a headset, whose player may have bare hands only. The dive pauses when the
// headset is taken off or loses the head's orientation; closed hands are the player's answers. Has no clock.
class HeadsetPause {
  public:
    // Updates `paused`, which a key may have changed too, once a frame: taking the headset off pauses until a
    // hand is closed; losing the head, until it is tracked again. Sets `restart` when both hands have been
    // closed while the results are shown.
    void step(const HeadsetMoment& now, float dt_s, bool& paused, bool& restart);

    // Darkness of the picture, 0 to 1 (black): rises smoothly while the head is not tracked.
    float fade() const { return fade_; }

    static constexpr float kFist = 0.7f, kOpen = 0.4f; // grip above and below which a hand is closed and open
    static constexpr float kGoOn_s = 0.4f;             // time with one fist that ends a pause
    static constexpr float kAgain_s = 1.0f;            // time with both fists that starts another dive
    static constexpr float kSteady_s = 0.3f;           // time with a tracked head that ends its pause
    static constexpr float kFadeOut_s = 0.25f, kFadeIn_s = 0.5f;

  private:
    void followHeadset(const HeadsetMoment& now, float dt_s, bool& paused);
    void readFists(const HeadsetMoment& now, float dt_s, bool& paused, bool& restart);

    bool begun_ = false;    // the headset has been worn and tracked once
    bool byItself_ = false; // the present pause ends without an answer
    bool waiting_ = false;  // paused or over in the frame before
    bool menuWas_ = false;
    float steady_s_ = 0;
    // Hands opened since the pause began: a hand that holds a fish does not end it.
    std::array<bool, 2> opened_{};
    std::array<float, 2> fist_s_{};
    float fade_ = 1;
};

class HeadsetDisplay : public Display {
  public:
    // Opens the headset. The window, whose OpenGL context must be current, and the rig, for hands that hold
    // controllers, must outlive this. samples: for anti-aliasing.
    static Result<HeadsetDisplay> open(platform::Window& window, const hands::HandRig& rig, int samples);

    // Fails when the headset is lost, as all other calls may.
    Status begin() override;
    std::optional<double> elapsed_s() const override { return elapsed_s_; }
    double period_s() const override { return frame_.period_s; }
    bool leaving() const override { return headset_.leaving(); }
    bool lost() const override { return headset_.lost(); }
    const game::Notice* notice() const override;
    void feed(GameSession& session) override;
    std::optional<float> eyesAboveFloor_m() const override;
    void recentre() override;
    bool seesRoom() const override { return headset_.seesRoom(); }
    bool showRoom(bool wanted) override;
    Status vibrate(const haptics::HapticFrame& frame, bool paused) override;
    Result<bool> draw(const Painter& painter, const game::Snapshot& shown, float scale) override;
    void present() override { window_->present(); }
    MenuSurface menuSurface() const override;
    std::array<Pointing, 2> pointing(const GameSession&) const override { return pointing_; }
    std::span<const gl::Target> pictures() const override { return targets_; }
    Audience audience() const override { return Audience::HeadsetPlayer; }

    const render::View& windowView() const { return windowView_; } // of the onlookers' window, as last drawn

  private:
    HeadsetDisplay(platform::Window& window, const hands::HandRig& rig, xr::Headset headset,
                   render::HeadsetPasses passes, int samples)
        : window_(&window), rig_(&rig), headset_(std::move(headset)), passes_(std::move(passes)),
          samples_(samples) {}
    Status drawEye(int eye, const Painter& painter, glm::ivec2 windowSize);
    Pointing pointingOf(size_t side, const hands::HandPose& hand) const;
    Status drawPanel(const Painter& painter);
    void mirror(const gl::Target& target, uint32_t framebuffer, glm::ivec2 windowSize,
                const render::View& view);

    platform::Window* window_;
    const hands::HandRig* rig_;
    xr::Headset headset_;
    render::HeadsetPasses passes_;
    int samples_;
    render::Surroundings surroundings_ = render::Surroundings::Film;
    double noRoom_s_ = 0; // seconds for which the notice "cannot show the room" is still shown
    std::vector<gl::Target> targets_;
    std::optional<xr::Planes> planes_; // planes of the depth drawn; empty: the headset takes no depth
    HeadsetPause pause_;
    PanelPlacement panel_;
    xr::Pose worldFromPanel_;            // panel's pose as last shown
    std::array<Pointing, 2> pointing_{}; // on the panel
    std::array<haptics::VibrationTimer, 2> vibration_;
    xr::Frame frame_;
    bool waiting_ = false; // a frame has been waited for and not yet submitted
    int64_t last_ns_ = 0;
    double elapsed_s_ = 0, clock_s_ = 0;
    render::View windowView_;
};

} // namespace shoal::app
