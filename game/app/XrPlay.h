// A dive in a headset: what the play loop asks of it, once a frame. The headset's clock is the game's.
#pragma once

#include "engine/gl/Target.h"
#include "engine/render/VeilPass.h"
#include "engine/xr/Headset.h"
#include "game/app/HudPlace.h"
#include "game/app/Run.h"
#include "game/app/XrGate.h"
#include "input/haptics/Vibration.h"

#include <array>
#include <functional>
#include <span>

namespace shoal::app {

class XrPlay {
  public:
    // Needs the window's context. samples: for anti-aliasing.
    static Result<XrPlay> open(int samples);

    // First thing in a frame: the runtime's news, and its next frame, for which it waits. Fails when the
    // headset is lost.
    Status wait();
    bool leaving() const { return headset_.leaving(); } // the player ended the game in the runtime's menu
    double elapsed_s() const { return elapsed_s_; }     // from the frame before to this one, as they are seen
    double period_s() const { return frame_.period_s; } // of the display; 0: not known yet

    // The player's head and hands, and whether the dive goes on. rig: of hands that hold controllers.
    void feed(Run& run, const hands::HandRig& rig);

    struct Painter {
        // Into the bound framebuffer, whose viewport is set.
        std::function<Status(int eye, const render::View&, const gl::Target& canvas)> scene;
        std::function<void(const render::View&, glm::ivec2 size)> marks; // on things in the world
        std::function<void(const render::View&, glm::ivec2 size)> panel; // text, on nothing
    };
    // Draws and hands in the frame. scale: of the eyes' width and height. window: size of what onlookers see,
    // the left eye's middle, into framebuffer 0; its view is left in windowView().
    Status draw(const Painter& painter, float scale, glm::ivec2 window);
    bool drew() const { return drew_; }
    const render::View& windowView() const { return windowView_; }

    Status feel(const haptics::HapticFrame& frame, bool paused);

    std::span<const gl::Target> eyes() const { return targets_; } // as last drawn; left, right

  private:
    XrPlay(xr::Headset headset, render::VeilPass veil, int samples)
        : headset_(std::move(headset)), veil_(std::move(veil)), samples_(samples) {}
    Status prepare(glm::ivec2 size);
    Status drawEye(int eye, const Painter& painter, glm::ivec2 window);
    Status drawPanel(const Painter& painter);

    xr::Headset headset_;
    render::VeilPass veil_;
    std::array<bool, 2> masked_{}; // eyes of which the headset hides something
    int samples_;
    std::vector<gl::Target> targets_;
    XrGate gate_;
    HudPlace place_;
    std::array<haptics::VibrationTimer, 2> vibration_;
    xr::Frame frame_;
    bool waiting_ = false; // a frame was waited for and is not yet handed in
    bool drew_ = false;
    int64_t last_ns_ = 0;
    double elapsed_s_ = 0, clock_s_ = 0;
    render::View windowView_;
};

} // namespace shoal::app
