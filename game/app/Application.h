// `shoal play` while it runs: opens what is needed, then runs frames of the title screen and of dives. Main
// thread, which has the OpenGL context.
#pragma once

#include "engine/platform/Headless.h"
#include "engine/platform/Window.h"
#include "game/app/Display.h"
#include "game/app/FirstSteps.h"
#include "game/app/FrameClock.h"
#include "game/app/HeadsetReturn.h"
#include "game/app/PhotoMode.h"
#include "game/app/ProgramStates.h"
#include "game/session/SoundAndHaptics.h"
#include "game/session/Statistics.h"
#include "game/ui/MenuControls.h"
#include "game/views/DynamicQuality.h"
#include "game/views/Environment.h"
#include "game/views/SceneRenderer.h"

#include <memory>
#include <optional>

namespace shoal::app {

class Application {
  public:
    explicit Application(const PlayOptions& options);

    Status open();

    // Until the player leaves, or what was asked for is done; not measured: a few seconds, to warm up.
    Status run(bool measured);

    bool hasPicture() const { return !display_->pictures().empty(); }
    Status saveScreenshot() const;
    const std::string& summary() const { return summary_; } // of a script that was played
    const Statistics& statistics() const { return statistics_; }
    bool leaving() const { return leaving_; }           // the player has asked for it
    const Screens& screens() const { return screens_; } // as they stand over the picture
    bool showsLiveVideo() const { return environment_->live(); }

  private:
    // A session while it runs.
    struct Play {
        Play(const SessionConfig& config, Screens& screens, Mode mode, bool keepsScores,
             FrameClock::Mode clockMode, double fps)
            : session(config), states(session, screens, mode, keepsScores), clock(clockMode, fps),
              tutorial(mode == Mode::FirstSteps ? Tutorial::Kind::FirstSteps
                       : mode == Mode::Dive     ? Tutorial::Kind::Hints
                       : mode == Mode::FreeSwim ? Tutorial::Kind::FreeSwim
                                                : Tutorial::Kind::Nothing,
                       config.rig, session.dive.species()) {}
        GameSession session;
        ProgramStates states;
        FrameClock clock;
        double elapsed_s = 0;                         // of this frame
        const platform::WindowInput* input = nullptr; // of this frame; null: there is no window
        Controls controls;
        bool freshVideo = false; // a new frame of the video is shown
        Tutorial tutorial;
        float results_s = 0;             // for which the results have been shown
        float resultsQuiet_s = 0;        // for which nothing has been pressed since
        float goalsLeft_s = 0;           // for which the goals are still shown
        std::optional<game::Notice> met; // who is new in the field guide
        float metLeft_s = 0;             // for which that is still said
    };

    Status openContext();
    Status openDisplay();
    Status openScene();
    Status loadModels();
    EnvironmentSetup environmentSetup(float minRoughness);
    Status makeRenderer(CreatureModels models, render::Composition composition);
    render::Detail detail() const;
    void openSound();
    void setIcon();
    Status openContent();
    bool drawLoading(float progress); // false: the player wants to leave
    Mode firstMode() const;
    Status begin(Mode mode, bool measured = true);
    bool isSeated() const;
    Status beginSeated(bool measured); // again, where who dives turns out to sit
    bool records(Mode mode, bool measured) const;
    Path recordingFile();
    Status endPlay();

    Status frame(bool measured);
    void readInput();
    void noteDevice();
    void noteTracker();
    void noteMet(size_t before);
    void measureHand();
    void readMenuInput();
    void globalActions(const Controls& controls);
    Status answer(const Request& request);
    Status startDive(const std::string& name, Mode mode);
    Status openFilm(const std::string& file);
    Status startHeadset();
    Status enterHeadset();
    void showRoom();
    void leaveHeadset(const Error& why);
    void awaitHeadset();
    void takeHandsFrom(HandSourceKind kind);
    Status reopen(const PlayOptions& wanted, Mode mode, Screen asker);
    Status goBack(const PlayOptions& before, const Error& why, Screen asker);
    Status endFirstSteps();
    void photograph();
    Status applySettings();
    void simulate();
    Result<bool> draw();
    void drawHud(HudPart part, Audience audience, const render::View& view, glm::ivec2 size);
    TextOptions textOptions() const;
    void adjustQuality();
    void measure();
    bool isOver() const;

    PlayOptions options_;
    PlayOptions applied_; // as they took effect last
    Bindings bindings_;
    Screens screens_{options_, bindings_};
    MenuControls menuControls_;
    SessionConfig config_;
    std::optional<platform::Headless> headless_; // the context first: it dies last
    std::optional<platform::Window> window_;
    std::unique_ptr<Display> display_;
    std::optional<Hud> hud_;
    std::unique_ptr<Environment> environment_;
    std::optional<CreatureModels> models_; // while no scene renderer has them
    std::optional<SceneRenderer> sceneRenderer_;
    bool software_ = false; // OpenGL renders on the processor
    std::optional<SoundAndHaptics> soundAndHaptics_;
    std::optional<DynamicQuality> quality_; // while somebody looks on and the quality is not fixed
    std::optional<Play> play_;
    HeadsetReturn headsetReturn_;    // while a dive is paused because its headset was lost
    std::optional<PhotoMode> photo_; // while the camera is free
    Popups popups_;
    Pictures::Picture cameraPicture_; // what a hand tracker's camera sees
    ImageRgba8 cameraImage_;          // scratch: the same
    Statistics statistics_;           // of the present session
    std::string summary_;
    int recordings_ = 0; // begun
    double volumeShown_s_ = -10;
    bool byGamepad_ = false; // the player's last input
    bool leaving_ = false;
};

} // namespace shoal::app
