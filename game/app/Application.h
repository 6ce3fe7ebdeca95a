// The command `shoal play`: opens window or headset, content and sound, then runs the frames of the title
// screen and of dives. Main thread, which has the OpenGL context.
#pragma once

#include "engine/gl/FramePace.h"
#include "engine/platform/Window.h"
#include "game/app/ContentLoader.h"
#include "game/app/Display.h"
#include "game/app/GuideAnimal.h"
#include "game/app/PhotoMode.h"
#include "game/app/Screens.h"
#include "game/app/SoundAndHaptics.h"
#include "game/views/DynamicQuality.h"

#include <future>
#include <memory>
#include <optional>
#include <vector>

namespace shoal::app {

class Application {
  public:
    explicit Application(const PlayOptions& options);

    Status open();

    // Runs until the player leaves or the run is complete. measured: false for a few seconds of warm-up.
    Status run(bool measured);

    bool hasPicture() const { return !display_->pictures().empty(); }
    Status saveScreenshot() const;
    const Statistics& statistics() const { return statistics_; }
    bool leaving() const { return leaving_; }           // the player has asked to leave
    const Screens& screens() const { return screens_; } // the pages over the picture

  private:
    // The present session and its state on the screen.
    struct Play : DiveRunner {
        Play(const SessionConfig& config, const PlayOptions& options, FrameClock::Mode clockMode,
             Screens& screens, Mode mode)
            : DiveRunner(config, options, clockMode), states(session, screens, mode, !options.headless),
              tutorial(mode, config.rig, session.dive.species()) {
            popups.reserve(8);
        }
        ProgramStates states;
        Controls controls;       // of this frame
        bool freshVideo = false; // a new frame of the video is shown
        Tutorial tutorial;
        float results_s = 0;             // seconds since the results appeared
        float resultsQuiet_s = 0;        // seconds without a press since then
        float goalsLeft_s = 0;           // seconds for which the goals are still shown
        std::optional<game::Notice> met; // the animal that is new in the field guide
        float metLeft_s = 0;             // seconds for which that is still shown
        std::vector<Popup> popups;
    };

    Status openContext();
    Status openDisplay();
    Status openScene();
    void openSound();
    Status openContent();
    bool drawLoading(float progress); // false: the player wants to leave
    bool inHeadset() const { return display_->audience() == Audience::HeadsetPlayer; }
    bool isForPerson() const { return !config_.script && !config_.replay; }
    Mode firstMode() const;
    Status begin(Mode mode);
    bool isSeated() const;
    int stars() const;
    int roomFloor_cm() const; // game::DiveRules::roomFloor_cm
    Status beginAsTracked();  // begins again if the player turns out to sit, or the room's floor is found
    bool records(Mode mode) const { return measured_ && !options_.record.empty() && mode != Mode::Title; }
    Path recordingFile();
    Status endPlay();

    Status frame();
    void rest(bool hidden);
    void readInput();
    void noteDevice();
    void noteTracker();
    void noteMet(size_t before);
    void measureHand();
    void readMenuInput();
    void globalActions(const Controls& controls);
    Status answer(const Request& request);
    Status startDive(const std::string& name, Mode mode);
    Status startHeadset();
    Status enterHeadset();
    void showRoom();
    void leaveHeadset(const Error& why);
    void awaitHeadset();
    Status reopen(const PlayOptions& wanted, Mode mode, Screen asker);
    Status goBack(const PlayOptions& before, const Error& why, Screen asker);
    Status endFirstSteps();
    void photograph();
    Status applySettings();
    void simulate();
    Look look() const;
    const game::Snapshot& shown();      // the dive, or what is shown in its place
    Result<bool> draw(float finer = 1); // factor on the number of rows and columns
    void drawHud(HudPart part, Audience audience, const render::View& view, glm::ivec2 size);
    void measure();

    PlayOptions options_;
    PlayOptions applied_; // options_ when they last took effect
    Bindings bindings_;
    Screens screens_{options_, bindings_};
    MenuControls menuControls_;
    SessionConfig config_;
    std::optional<platform::Headless> headless_; // before all that uses its context, and so destroyed last
    std::optional<platform::Window> window_;
    std::unique_ptr<Display> display_;
    std::optional<Hud> hud_;
    ContentLoader content_{[this](float progress) { return drawLoading(progress); }};
    std::optional<SoundAndHaptics> soundAndHaptics_;
    gl::FramePace pace_;
    std::optional<DynamicQuality> quality_; // only for a display whose quality may change
    std::optional<Play> play_;
    // While a dive is paused because its headset was lost: seconds until the runtime is asked for it again.
    std::optional<float> askForHeadset_s_;
    static constexpr float kAskEvery_s = 2;
    std::future<bool> headsetAnswer_; // whether the headset is there, once the runtime has said so
    std::optional<PhotoMode> photo_;  // set while the camera is free
    GuideAnimal guideAnimal_;
    Pictures::Picture cameraPicture_; // image of a hand tracker's camera
    ImageRgba8 cameraImage_;          // scratch memory for that image
    Statistics statistics_;           // of the present session
    int recordings_ = 0;              // number of recordings begun
    bool measured_ = true;            // false: the present run only warms up
    double volumeShown_s_ = -10;
    bool byGamepad_ = false; // the player's last input came from a gamepad
    float quiet_s_ = 0;      // seconds since that input
    bool leaving_ = false;
};

} // namespace shoal::app
