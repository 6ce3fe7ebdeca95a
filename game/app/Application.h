// `shoal play` while it runs: opens what a dive needs, then runs its frames. Main thread, which has the
// OpenGL context.
#pragma once

#include "engine/platform/Headless.h"
#include "engine/platform/Window.h"
#include "game/app/Display.h"
#include "game/app/FrameClock.h"
#include "game/session/GameSession.h"
#include "game/session/SoundAndHaptics.h"
#include "game/session/Statistics.h"
#include "game/settings/PlayOptions.h"
#include "game/views/DynamicQuality.h"
#include "game/views/Environment.h"
#include "game/views/SceneRenderer.h"

#include <memory>
#include <optional>

namespace shoal::app {

class Application {
  public:
    explicit Application(const PlayOptions& options) : options_(options) {}

    Status open();

    // One session from start to end. measured: not only to warm up.
    Status runSession(bool measured);

    bool hasPicture() const { return !display_->pictures().empty(); }
    Status saveScreenshot() const;
    const PlayOptions& options() const { return options_; } // with what the player has changed by keys
    const Statistics& statistics() const { return statistics_; }
    bool showsLiveVideo() const { return environment_->live(); }

  private:
    struct Frame; // what the steps of one frame share
    Status openContext();
    Status openDisplay(int samples);
    Status openScene(bool software);

    void readInput(Frame& frame);
    void globalKey(int key);
    void simulate(Frame& frame);
    Result<bool> draw(const Frame& frame);
    void drawHud(const Frame& frame, HudPart part, Audience audience, const render::View& view,
                 glm::ivec2 size);
    void adjustQuality(const FrameClock& clock);
    void measure(const Frame& frame);
    bool isOver(const Frame& frame) const;

    PlayOptions options_;
    SessionConfig config_;
    std::optional<platform::Headless> headless_; // the context first: it dies last
    std::optional<platform::Window> window_;
    std::unique_ptr<Display> display_;
    std::unique_ptr<Environment> environment_;
    std::optional<SceneRenderer> sceneRenderer_;
    std::optional<Hud> hud_;
    std::optional<SoundAndHaptics> soundAndHaptics_;
    std::optional<DynamicQuality> quality_; // while somebody looks on and the quality is not fixed
    Statistics statistics_;                 // of the present session
    double volumeShown_s_ = -10;
    int bestScore_ = 0;
    bool leaving_ = false;
};

} // namespace shoal::app
