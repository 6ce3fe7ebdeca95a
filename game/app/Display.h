// Output of a dive: a window or off-screen picture (FlatDisplay), or a headset (HeadsetDisplay). A frame is
// begin(), draw() and, if there is a picture, present(). Only on the thread of the OpenGL context.
#pragma once

#include "engine/gl/Target.h"
#include "engine/platform/Window.h"
#include "engine/render/Compositor.h"
#include "game/session/GameSession.h"
#include "game/ui/Hud.h"
#include "game/ui/MenuControls.h"
#include "game/views/SceneRenderer.h"
#include "input/haptics/HapticFrame.h"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace shoal::app {

// Callbacks that draw the content of a frame; the display provides eyes and targets.
struct Painter {
    using AfterEye = render::Compositor::AfterEye;
    // Draws the scene for these eyes into their canvases; see SceneRenderer::draw().
    std::function<Status(std::span<const SceneRenderer::Eye>, const AfterEye&)> scene;
    // Draws the depth of the scene just drawn for this eye into a framebuffer with depth.
    std::function<Status(const SceneRenderer::Eye&, uint32_t framebuffer)> depth;
    // Draws the text into the bound framebuffer of `size` pixels.
    std::function<void(HudPart, Audience, const render::View&, glm::ivec2 size)> hud;

    // Returns a painter whose scene and depth come from this renderer.
    static Painter of(SceneRenderer& renderer, decltype(hud) hud) {
        return {[&](auto eyes, const AfterEye& afterEye) { return renderer.draw(eyes, afterEye); },
                [&](const auto& eye, uint32_t into) { return renderer.drawDepth(eye, into); },
                std::move(hud)};
    }
};

class Display {
  public:
    virtual ~Display() = default;

    // Begins a frame; waits until the display wants one, if it sets the pace.
    virtual Status begin() = 0;
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

    Status begin() override { return Done{}; }
    double period_s() const override;
    Result<bool> draw(const Painter& painter, const game::Snapshot& shown, float scale) override;
    void present() override;
    MenuSurface menuSurface() const override;
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

// Returns a picture of both eyes side by side.
ImageRgb8 pictureOf(std::span<const gl::Target> eyes);

// Replaces the targets by `count` new ones of this size, unless they have this count and size already.
void resize(std::vector<gl::Target>& targets, int count, glm::ivec2 size, int samples);

} // namespace shoal::app
