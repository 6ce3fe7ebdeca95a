// A display shows a dive: FlatDisplay in a window or off-screen picture, HeadsetDisplay in a headset. Each
// frame calls begin(), draw() and, if draw() returned true, present(), on the OpenGL context's thread.
#pragma once

#include "engine/gl/Target.h"
#include "engine/math/Trigonometry.h"
#include "engine/platform/Window.h"
#include "engine/render/HeadsetPasses.h"
#include "engine/xr/Headset.h"
#include "game/session/GameSession.h"
#include "game/ui/Hud.h"
#include "game/ui/Menu.h"
#include "game/views/SceneRenderer.h"
#include "input/hands/HandRig.h"
#include "input/haptics/HapticFrame.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace shoal::app {

// Draws the content of a frame; the display provides eyes and targets.
struct Painter {
    SceneRenderer& renderer; // has its scene set already
    // Draws the text into the bound framebuffer of `size` pixels.
    std::function<void(HudPart, Audience, const render::View&, glm::ivec2 size)> hud;
};

class Display {
  public:
    virtual ~Display() = default;

    // Begins a frame. A display that sets the pace waits here until it wants one.
    virtual Status begin() { return Done{}; }
    // Time between the display of the last frame and of this one; empty: the display does not know.
    virtual std::optional<double> elapsed_s() const { return std::nullopt; }
    virtual double period_s() const = 0;           // time between two pictures; 0: not known yet
    virtual bool leaving() const { return false; } // the player has ended the game in the display's own menu
    virtual bool lost() const { return false; }    // the device is gone, so a call failed; it may come back
    virtual const game::Notice* notice() const { return nullptr; } // message for the player now, or null

    // Gives the session the head and hands that the display tracks, and whether it is worn.
    virtual void feed(GameSession&) {}
    virtual Status vibrate(const haptics::HapticFrame&, bool /*paused*/) { return Done{}; }

    // Height of the player's eyes now; empty: the display does not know.
    virtual std::optional<float> eyesAboveFloor_m() const { return std::nullopt; }
    // Height of the floor of the player's room, world frame; empty: unknown, or the room is not shown.
    virtual std::optional<float> roomFloor_m() const { return std::nullopt; }
    // Makes the player's present view direction the direction ahead, if the display tracks the head.
    virtual void recentre() {}

    virtual bool seesRoom() const { return false; } // whether showRoom() can show the room
    // Shows the player's own room in place of the film from the next picture on. False: it cannot.
    virtual bool showRoom(bool /*wanted*/) { return true; }

    // Draws a frame. scale: share of the display's width and height that is drawn, then enlarged. Returns
    // false if nothing can be seen now.
    virtual Result<bool> draw(const Painter& painter, const game::Snapshot& shown, float scale) = 0;
    virtual void present() = 0;

    virtual MenuSurface menuSurface() const = 0;
    // Returns where the session's hands point on that surface.
    virtual std::array<Pointing, 2> pointing(const GameSession& session) const = 0;

    virtual std::span<const gl::Target> pictures() const = 0; // as last drawn: left, right
    virtual Audience audience() const { return Audience::WindowPlayer; }
};

// A display in a window or off screen, of one eye or of both side by side.
class FlatDisplay : public Display {
  public:
    // window: null off screen; it and the options must outlive this. samples: for anti-aliasing.
    FlatDisplay(platform::Window* window, const PlayOptions& options, int samples)
        : window_(window), options_(options), samples_(samples) {}

    double period_s() const override { return 1 / (window_ ? window_->refreshRate_Hz() : 60.0); }
    Result<bool> draw(const Painter& painter, const game::Snapshot& shown, float scale) override;
    void present() override;
    MenuSurface menuSurface() const override {
        const int eyes = sideBySide() ? 2 : 1;
        const glm::vec2 size = window_ ? window_->framebufferSize() : options_.look.size;
        return {size / glm::vec2(eyes, 1), eyes};
    }
    std::array<Pointing, 2> pointing(const GameSession& session) const override;
    std::span<const gl::Target> pictures() const override { return targets_; }

  private:
    bool sideBySide() const { return options_.stereo == StereoOutput::SideBySide; }

    platform::Window* window_;
    const PlayOptions& options_;
    int samples_;
    std::vector<gl::Target> targets_;        // one per eye
    std::vector<gl::Target> reducedTargets_; // enlarged to targets_ while `scale` is below 1
};

// Returns the tangents of half the angles of a picture of this size. fov_deg: its vertical angle.
inline glm::vec2 halfExtentOf(glm::vec2 size, float fov_deg) {
    return render::View{.verticalFov = glm::radians(fov_deg), .aspect = size.x / std::max(size.y, 1.0f)}
        .halfExtent();
}

// Returns a picture of both eyes side by side.
ImageRgb8 pictureOf(std::span<const gl::Target> eyes);

// Placement of the text panel in a headset: in front of the player, upright. It follows the head smoothly,
// and only once the head looks well aside.
class PanelPlacement {
  public:
    static constexpr float kDistance_m = 1.5f;
    static constexpr float kBelow_m = 0.1f;      // below the eyes, which is more comfortable
    static constexpr float kLag_rad = 0.6f;      // turn of the head at which the panel starts to follow
    static constexpr float kSettled_rad = 0.05f; // remaining angle at which it stops
    static constexpr float kTurn_s = 0.35f, kMove_s = 0.5f; // time constants

    // Returns the panel's pose in the world of xr::Tracking, at first ahead of the head. Call once a frame.
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
// headset is taken off or loses the head's orientation; the player closes a hand to resume or restart it.
class HeadsetPause {
  public:
    // Updates `paused`, which a key may have changed too, once a frame: taking the headset off pauses until a
    // hand is closed; losing the head, until it is tracked again. Sets `restart` when both hands have been
    // closed while the results are shown.
    void step(const HeadsetMoment& now, float dt_s, bool& paused, bool& restart);

    // Darkness of the picture, 0 to 1 (black): rises smoothly while the head is not tracked.
    float fade() const { return fade_; }

    static constexpr float kFist = 0.7f, kOpen = 0.4f; // grip above and below which a hand is closed and open
    static constexpr float kResume_s = 0.4f;           // time with one fist that ends a pause
    static constexpr float kRestart_s = 1.0f;          // time with both fists that starts another dive
    static constexpr float kSteady_s = 0.3f;           // time with a tracked head that ends its pause
    static constexpr float kFadeOut_s = 0.25f, kFadeIn_s = 0.5f;

  private:
    void followHeadset(const HeadsetMoment& now, float dt_s, bool& paused);
    void readFists(const HeadsetMoment& now, float dt_s, bool& paused, bool& restart);

    bool begun_ = false;        // the headset has been worn and tracked once
    bool endsByItself_ = false; // the pause ends once the head is tracked, without a fist
    bool asked_ = false;        // the frame before asked the player for a fist
    bool menuWasDown_ = false;
    float steady_s_ = 0;
    // Whether the hand has opened since the pause began: a fist that still holds a fish does not end it.
    std::array<bool, 2> opened_{};
    std::array<float, 2> fist_s_{};
    float fade_ = 1;
};

// A display in an OpenXR headset: pictures for both eyes, text on a panel in front of the player, and the
// middle of the left eye's picture in a window for onlookers. The headset's clock drives the game.
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
    std::optional<float> eyesAboveFloor_m() const override {
        const xr::Tracking& tracking = headset_.tracking();
        if (!tracking.headTracked || !tracking.floor_m) return std::nullopt;
        return tracking.worldFromHead.position.y - *tracking.floor_m;
    }
    std::optional<float> roomFloor_m() const override {
        return surroundings_ == render::Surroundings::Room ? headset_.tracking().floor_m : std::nullopt;
    }
    void recentre() override {
        headset_.recentre();
        panel_ = {};
    }
    bool seesRoom() const override { return headset_.properties().seesRoom; }
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
    Status drawEyes(const Painter& painter, glm::ivec2 windowSize);
    // Completes an eye's picture and gives it, and its depth, to the headset.
    Status showEye(const SceneRenderer::Eye& drawnEye, const Painter& painter, glm::ivec2 windowSize);
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
    std::optional<xr::Planes> planes_; // near and far plane of the depth drawn; empty: no depth is taken
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
