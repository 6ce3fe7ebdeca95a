// Head-up display: score, time, progress of a hold, captions and the developer's panel (F1), with the overlay
// of the program's state among them. The thread of the OpenGL context only.
#pragma once

#include "engine/core/Result.h"
#include "engine/gl/PassTimers.h"
#include "engine/render/View.h"
#include "game/feedback/SoundCues.h"
#include "game/session/Statistics.h"
#include "game/ui/Pen.h"
#include "game/ui/Pictures.h"
#include "game/ui/Popups.h"
#include "game/views/DynamicQuality.h"
#include "game/views/Environment.h"

#include <glm/vec2.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <span>

struct ImGuiContext;

namespace shoal::app {

// How text is written; as the player has set it.
struct TextOptions {
    game::Language language = game::Language::English;
    float scale = 1;        // of all text
    float captionScale = 1; // of captions besides
    bool highContrast = false;
};

// In a headset text hangs on a panel of its own, and what marks a thing in the world is drawn where that is.
enum class HudPart { All, Panel, Marks };

struct HudInfo {
    HudPart part = HudPart::All;
    Audience audience = Audience::WindowPlayer;
    const game::Snapshot* snapshot = nullptr;
    const render::View* view = nullptr; // for what stands at a place in the world
    std::span<const game::Caption> captions;
    std::span<const Popup> popups;
    std::span<const std::string> goals;      // of the dive; empty while they are not shown
    bool inDive = true;                      // score, time and captions are shown
    std::function<void(const Pen&)> overlay; // of the program's state; may be empty
    TextOptions text;
    float vignette = 0;              // of comfort: how fast the view turns, radians a second; 0: none
    std::optional<glm::vec2> finger; // that points at a menu, pixels
    bool showTimes = false;
    const Statistics* statistics = nullptr;
    Quality quality;
    std::span<const gl::PassTimers::Time> passes; // what the graphics side took for each
    const Environment* environment = nullptr;
    const Pictures::Picture* camera = nullptr; // of a hand tracker, to be shown; null: not
    const game::Notice* notice = nullptr;      // null: none
    float volume = 0;
    bool showVolume = false;
};

class Hud {
  public:
    // Needs a current GL context.
    static Result<Hud> make();

    // Over the bound framebuffer, which is `size` pixels large.
    void draw(const HudInfo& info, glm::ivec2 size);
    // One line and nothing else.
    void drawNotice(const game::Notice& notice, const TextOptions& text, glm::ivec2 size);
    // While things are loaded; progress: 0 to 1.
    void drawLoading(float progress, const TextOptions& text, glm::ivec2 size);

  private:
    Pen beginFrame(Audience audience, bool hasText, const TextOptions& text, glm::ivec2 size);
    static void endFrame();
    struct DestroyContext {
        void operator()(ImGuiContext* context) const;
    };
    std::unique_ptr<ImGuiContext, DestroyContext> context_;
    Fonts fonts_;
    Pictures pictures_;
};

} // namespace shoal::app
