// Sound and haptic output of a dive, from the same snapshots and events as the picture. Main thread.
#pragma once

#include "engine/audio/Audio.h"
#include "engine/core/Files.h"
#include "game/feedback/SoundCues.h"
#include "game/rules/Snapshot.h"
#include "input/haptics/HapticFrame.h"

#include <memory>
#include <span>
#include <vector>

namespace shoal::app {

struct SoundAndHapticsOptions {
    bool sound = true;   // false: no device is opened
    bool haptics = true; // likewise
    bool headphones = false;
    float volume = 0.8f;
    float hapticStrength = 1;
    float doppler = audio::kDopplerAsInAir;
    Path video; // whose sound is played in step with it; empty: none
    double videoLength_s = 0;
    float videoSound = 0.8f; // 0 to 1; 0: it is not opened
};

class SoundAndHaptics {
  public:
    // Never fails: without a sound device it is silent, which is logged.
    static SoundAndHaptics open(const SoundAndHapticsOptions& options);
    SoundAndHaptics(SoundAndHaptics&&) noexcept;
    SoundAndHaptics& operator=(SoundAndHaptics&&) noexcept;
    ~SoundAndHaptics();

    // attended: false while another window has the focus, which stops all haptics.
    // videoPosition_s: of the frame that is shown, since the video's first.
    void frame(const game::Snapshot& shown, std::span<const game::Event> events, float dt_s, bool attended,
               double videoPosition_s);
    void setVolume(float volume); // 0 to 1

    const haptics::HapticFrame& hapticFrame() const; // sent to haptic devices by the last frame()
    std::span<const game::Caption> captions() const; // newest first; valid until the next frame()

  private:
    struct State;
    explicit SoundAndHaptics(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace shoal::app
