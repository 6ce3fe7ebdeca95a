// The program while it plays: what it holds, and its steps. open() once, then playThrough(); all on the
// thread that owns the window.
#pragma once

#include "engine/gl/Target.h"
#include "engine/platform/Headless.h"
#include "engine/platform/Window.h"
#include "game/app/Governor.h"
#include "game/app/Hud.h"
#include "game/app/Options.h"
#include "game/app/Outputs.h"
#include "game/app/Plan.h"
#include "game/app/Run.h"
#include "game/app/Stage.h"
#include "game/app/Statistics.h"
#include "game/app/Surround.h"
#include "game/app/XrPlay.h"

#include <chrono>
#include <optional>
#include <span>
#include <vector>

namespace shoal::app {

using Clock = std::chrono::steady_clock;

inline double secondsBetween(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

struct Player {
    const PlayOptions& options;
    Plan plan;
    std::optional<platform::Headless> headless; // the context first: it dies last
    std::optional<platform::Window> window;
    std::optional<XrPlay> headset; // with --xr; the window then shows what it shows
    std::optional<Surround> surround;
    std::optional<Stage> stage;
    std::optional<Hud> hud;
    std::optional<Outputs> outputs;
    std::vector<gl::Target> targets;  // one an eye
    std::vector<gl::Target> coarse;   // what the targets are enlarged from while the governor saves pixels
    std::optional<Governor> governor; // while somebody looks, and the quality is not fixed
    Statistics statistics;
    FrameTimes times;
    float volume = 0.8f;
    double volumeShown_s = -10;
    bool showTimes = false;
    int best = 0;
    bool newBest = false;
    bool scored = false;
    bool leaving = false;
    int samples = 1;

    explicit Player(const PlayOptions& o) : options(o), volume(o.volume) {}

    Status open();
    Status playThrough(bool measured);
    Status drawFrame(const Run& run, glm::ivec2 size);
    Status drawHeadset(const Run& run, glm::ivec2 size);
    render::Exposure exposure() const;
    render::Glossy glossy() const;
    Stage::Eye eyeOf(int eye, const render::View& view, glm::ivec2 size) const;
    HudInfo hudInfo(const Run& run, const render::View& view) const;
    const platform::WindowInput& readKeys(Run& run, double now_s);
    void govern(Clock::time_point frameBegan);
    Status saveScreenshot();
    void keepScore(const Run& run);
    std::span<const gl::Target> drawn() const { return headset ? headset->eyes() : targets; }
    bool stereo() const { return options.stereo == "sbs"; }
};

} // namespace shoal::app
