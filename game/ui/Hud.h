// Head-up display: score, time, progress of a hold, captions and the developer's panel (F1), with the overlay
// of the program's state among them. The thread of the OpenGL context only.
#pragma once

#include "engine/core/Result.h"
#include "engine/gl/PassTimers.h"
#include "engine/render/View.h"
#include "game/feedback/SoundCues.h"
#include "game/rules/Snapshot.h"
#include "game/ui/Pen.h"
#include "game/views/DynamicQuality.h"

#include <glm/vec2.hpp>

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace shoal::app {

// Times of the last frames, milliseconds, for the developer's panel.
struct FrameTimes {
    std::array<float, 120> frame_ms{};
    int next = 0;
    float light_ms = 0, decode_ms = 0, upload_ms = 0, sim_ms = 0;
    int draws = 0, triangles = 0;
    Quality quality;

    void add(float ms) {
        frame_ms[static_cast<size_t>(next)] = ms;
        next = (next + 1) % static_cast<int>(frame_ms.size());
    }
};

// In a headset text hangs on a panel of its own, and what marks a thing in the world is drawn where that is.
enum class HudPart { All, Panel, Marks };

struct HudInfo {
    HudPart part = HudPart::All;
    Audience audience = Audience::WindowPlayer;
    const game::Snapshot* snapshot = nullptr;
    const render::View* view = nullptr; // for what stands at a place in the world
    std::span<const game::Caption> captions;
    std::function<void(const Pen&)> overlay; // of the program's state; may be empty
    bool showTimes = false;
    const FrameTimes* times = nullptr;
    std::span<const gl::PassTimers::Time> passes; // what the graphics side took for each
    std::string_view lightName;                   // which light is used
    std::string_view renderer;
    std::string_view notice; // one sentence to the player, such as "the video is damaged"; empty: none
    float volume = 0;
    bool showVolume = false;
};

class Hud {
  public:
    // Needs a current GL context.
    static Result<Hud> make();
    Hud(Hud&&) noexcept;
    Hud& operator=(Hud&&) noexcept;
    ~Hud();

    // Over the bound framebuffer, which is `size` pixels large.
    void draw(const HudInfo& info, glm::ivec2 size);

  private:
    struct State;
    explicit Hud(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace shoal::app
