// Where a dive is seen: in a window or off screen (FlatDisplay), or in a headset (HeadsetDisplay). A frame is
// begin(), draw() and, if there is a picture, present(). The thread of the OpenGL context only.
#pragma once

#include "engine/gl/Target.h"
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

// Draws the content of a frame for a display, which knows the eyes and the targets.
struct Painter {
    using AfterEye = render::Compositor::AfterEye;
    // The scene as these eyes see it, into their canvases; see SceneRenderer::draw().
    std::function<Status(std::span<const SceneRenderer::Eye>, const AfterEye&)> scene;
    // The depth of what was just drawn for this eye, into a framebuffer with depth.
    std::function<Status(const SceneRenderer::Eye&, uint32_t framebuffer)> depth;
    // Into the bound framebuffer, which is `size` pixels large.
    std::function<void(HudPart, Audience, const render::View&, glm::ivec2 size)> hud;

    // Scene and depth as this renderer draws them.
    static Painter of(SceneRenderer& renderer, decltype(hud) hud) {
        return {[&](auto eyes, const AfterEye& afterEye) { return renderer.draw(eyes, afterEye); },
                [&](const auto& eye, uint32_t into) { return renderer.drawDepth(eye, into); },
                std::move(hud)};
    }
};

class Display {
  public:
    virtual ~Display() = default;

    // First in a frame: waits until the display wants one, where it sets the pace.
    virtual Status begin() = 0;
    // From the frame before to this one, as they are seen; empty: the display does not know.
    virtual std::optional<double> elapsed_s() const { return std::nullopt; }
    virtual double period_s() const = 0;           // from one picture to the next; 0: not known yet
    virtual bool leaving() const { return false; } // the player has ended the game in the display's own menu
    virtual bool lost() const { return false; } // a step failed because the device is gone; it may come back
    virtual const game::Notice* notice() const { return nullptr; } // to be told to the player now

    // The head and hands that the display itself tracks, and whether it is worn.
    virtual void feed(GameSession&) {}
    virtual Status vibrate(const haptics::HapticFrame&, bool /*paused*/) { return Done{}; }

    // Of the player, now; empty: the display does not know.
    virtual std::optional<float> eyesAboveFloor_m() const { return std::nullopt; }
    // Ahead is where the player looks now, where the display tracks the head.
    virtual void recentre() {}

    virtual bool seesRoom() const { return false; } // showRoom() can
    // The player's own room in place of the film, from the next picture on. False: the display cannot.
    virtual bool showRoom(bool /*wanted*/) { return true; }

    // scale: of the drawn picture's width and height, which is enlarged to the display's. False: there is
    // nothing to be seen now.
    virtual Result<bool> draw(const Painter& painter, const game::Snapshot& shown, float scale) = 0;
    virtual void present() = 0;

    virtual MenuSurface menuSurface() const = 0;
    // Where the hands of the session point on it.
    virtual std::array<Pointing, 2> pointing(const GameSession& session) const = 0;

    virtual std::span<const gl::Target> pictures() const = 0; // as last drawn: left, right
    virtual Audience audience() const { return Audience::WindowPlayer; }
};

// Of both eyes side by side.
ImageRgb8 pictureOf(std::span<const gl::Target> eyes);

// Makes so many of this size, if they are not.
void resize(std::vector<gl::Target>& targets, int count, glm::ivec2 size, int samples);

} // namespace shoal::app
