// A display in an OpenXR headset: pictures for both eyes, text on a panel in front of the player, and the
// middle of the left eye's picture in a window for onlookers. The headset's clock is the game's.
#pragma once

#include "engine/platform/Window.h"
#include "engine/render/HeadsetPasses.h"
#include "engine/xr/Headset.h"
#include "game/app/Display.h"
#include "game/session/HeadsetPause.h"
#include "game/ui/PanelPlacement.h"
#include "input/hands/HandRig.h"
#include "input/haptics/HapticFrame.h"

#include <array>
#include <vector>

namespace shoal::app {

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
    Status drawDepth(const Painter& painter, const SceneRenderer::Eye& eye);
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
