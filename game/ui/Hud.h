// Head-up display: score, time, progress of a hold, captions, the menu pages and the developer's panel (F1).
// Only on the thread of the OpenGL context.
#pragma once

#include "engine/core/Result.h"
#include "engine/gl/PassTimers.h"
#include "engine/render/View.h"
#include "game/feedback/Feedback.h"
#include "game/session/Statistics.h"
#include "game/ui/Pen.h"
#include "game/views/DynamicQuality.h"
#include "game/views/Environment.h"

#include <glm/vec2.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <span>

struct ImGuiContext;

namespace shoal::app {

// Returns the text in the language, in English where it is missing there.
inline const std::string& textIn(const game::InLanguages& text, game::Language language) {
    const std::string& words = text[static_cast<size_t>(language)];
    return words.empty() ? text[0] : words;
}

// Returns an animal's name on the screen.
inline const std::string& animalName(const game::Species& animal, int count, game::Language language) {
    const std::string& name = textIn(count == 1 ? animal.one : animal.several, language);
    return name.empty() ? animal.name : name;
}

inline std::string lengthText(float length_m) { return std::to_string(std::lround(100 * length_m)) + " cm"; }

// Part to draw. In a headset the text is on a panel, and marks are at their places in the world.
enum class HudPart { All, Panel, Marks };

// Points that rise where a fish was caught, with its size: "+25 snapper  31 cm, 600 g  Your largest".
struct Popup {
    static constexpr float kStay_s = 2.0f;
    int points = 0, combo = 0;
    const game::Species* species = nullptr;
    glm::vec3 position{0};           // world
    float length_m = 0, mass_kg = 0; // 0: not shown
    bool isRecord = false;           // the player's longest of its species
    float age_s = 0;
};

struct HudInfo {
    HudPart part = HudPart::All;
    Audience audience = Audience::WindowPlayer;
    const game::Snapshot* snapshot = nullptr;
    const render::View* view = nullptr; // for marks at places in the world
    std::span<const game::Caption> captions;
    std::span<const Popup> popups;
    std::span<const std::string> goals;      // lines on the dive's goals; empty while they are not shown
    bool inDive = true;                      // shows score, time and captions
    std::function<void(const Pen&)> overlay; // draws the menu pages or the tutorial; may be empty
    TextSettings text;
    float vignette = 0; // turning speed of the view for the dark edges, radians a second; 0: none
    std::optional<glm::vec2> finger;        // place where a finger points at a menu, pixels
    const Statistics* statistics = nullptr; // for the developer's panel; null: it is not shown
    Quality quality;
    std::span<const gl::PassTimers::Time> passes; // GPU time of each pass
    const Environment* environment = nullptr;
    const Pictures::Picture* camera = nullptr; // image of a hand tracker's camera to show; null: none
    const game::Notice* notice = nullptr;      // null: none
    std::optional<float> volume;               // empty: not shown
};

class Hud {
  public:
    // Needs a current GL context.
    static Result<Hud> make();

    // Draws over the bound framebuffer of `size` pixels.
    void draw(const HudInfo& info, glm::ivec2 size);
    // Draws one line and nothing else.
    void drawNotice(const game::Notice& notice, const TextSettings& text, glm::ivec2 size);
    // Draws the loading screen; progress: 0 to 1.
    void drawLoading(float progress, const TextSettings& text, glm::ivec2 size);

  private:
    Pen beginFrame(Audience audience, bool hasText, const TextSettings& text, glm::ivec2 size);
    static void endFrame();
    static void destroy(ImGuiContext* context);
    std::unique_ptr<ImGuiContext, decltype(&destroy)> context_{nullptr, destroy};
    Fonts fonts_;
    Pictures pictures_;
};

} // namespace shoal::app
