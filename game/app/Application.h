// The command `shoal play`: opens window or headset, content and sound, then runs the frames of the title
// screen and of dives. Main thread, which has the OpenGL context.
#pragma once

#include "engine/audio/Audio.h"
#include "engine/gl/FramePace.h"
#include "engine/media/SoundTrack.h"
#include "engine/platform/Window.h"
#include "game/app/ContentLoader.h"
#include "game/app/Display.h"
#include "game/app/Screens.h"
#include "game/feedback/Feedback.h"
#include "game/views/DynamicQuality.h"
#include "input/haptics/HapticDevices.h"

#include <future>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace shoal::app {

// Photo mode: the dive stands still, the camera is free and no text covers the picture; a press saves it and
// a lat-long of all directions as PNG files in the player's folder for pictures.
class PhotoMode {
  public:
    // The camera starts at the player's view. bindings: the keys that move the camera.
    PhotoMode(const game::Snapshot& from, float fov_deg, bool byGamepad, const Bindings& bindings);

    enum class Command { None, Picture, Leave };
    // Moves the camera and returns the player's command; once a frame. fov_deg: the picture's, which the
    // wheel changes.
    Command step(const Controls& controls, float sensitivity, float dt_s, float& fov_deg);
    // Saves the picture and a lat-long of all directions, and sets the notice.
    void save(const ImageRgb8& picture, SceneRenderer& renderer);

    game::Snapshot shown; // the dive's, with the free camera as the viewer
    float fovBefore_deg;
    std::optional<game::Notice> notice; // to show now

  private:
    glm::vec3 origin_;
    LookAngles look_;
};

// Sound and haptic output of a dive, from the same snapshots and events as the picture.
class SoundAndHaptics {
  public:
    // Opens sound and haptics. Without a sound device it is silent, which is logged. The options, whose
    // volumes and strength are read in every frame, must outlive this. video: the file whose sound plays in
    // step with the picture; empty: none.
    SoundAndHaptics(const PlayOptions& options, const Path& video, double videoLength_s);
    SoundAndHaptics(const SoundAndHaptics&) = delete; // the audio holds the track's address
    SoundAndHaptics& operator=(const SoundAndHaptics&) = delete;

    // Outputs a frame. attended: false while another window has the focus, which stops all haptics.
    // videoPosition_s: time of the frame shown since the video's first.
    void frame(const game::Snapshot& shown, const game::Events& events, float dt_s, bool attended,
               double videoPosition_s, const glm::quat& worldFromFilm);
    const haptics::HapticFrame& hapticFrame() const { return hapticFrame_; } // as sent by the last frame()
    // Newest first; valid until the next frame().
    std::span<const game::Caption> captions() const { return sounds_.captions(); }

  private:
    Status openSound();
    void openVideoSound(const Path& video, double videoLength_s);

    game::SoundCues sounds_;
    game::HapticFeedback hapticFeedback_;
    const PlayOptions& options_;
    float volume_;                           // last volume set on the audio
    std::optional<media::SoundTrack> track_; // declared before the audio, which reads it
    std::optional<audio::Audio> audio_;
    std::optional<haptics::HapticOutput> haptics_;
    haptics::HapticFrame hapticFrame_;
};

class Application {
  public:
    explicit Application(const PlayOptions& options);

    Status open();

    // Runs until the player leaves or the run is complete. measured: false for a few seconds of warm-up.
    Status run(bool measured);

    bool hasPicture() const { return !display_->pictures().empty(); }
    Status saveScreenshot() const;
    const std::string& summary() const { return summary_; } // of the last script that was played
    const Statistics& statistics() const { return statistics_; }
    bool leaving() const { return leaving_; }           // the player has asked to leave
    const Screens& screens() const { return screens_; } // the pages over the picture
    bool showsLiveVideo() const { return content_.environment().player().live(); }

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
    bool isForPerson() const { return !config_.script && !config_.replay; }
    Mode firstMode() const;
    Status begin(Mode mode);
    bool isSeated() const;
    Status beginSeated(); // begins again with seated rules if the player turns out to sit
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
    Look look() const { return lookOf(options_, content_.environment(), config_.dive.exposure_ev); }
    Result<bool> draw();
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
    Pictures::Picture cameraPicture_; // image of a hand tracker's camera
    ImageRgba8 cameraImage_;          // scratch memory for that image
    Statistics statistics_;           // of the present session
    std::string summary_;
    int recordings_ = 0;   // number of recordings begun
    bool measured_ = true; // false: the present run only warms up
    double volumeShown_s_ = -10;
    bool byGamepad_ = false; // the player's last input came from a gamepad
    float quiet_s_ = 0;      // seconds since that input
    bool leaving_ = false;
};

} // namespace shoal::app
