// What the player hears and feels: sound and haptics from the same snapshots and events as the picture.
#pragma once

#include "engine/audio/Audio.h"
#include "engine/core/Files.h"
#include "game/Snapshot.h"
#include "game/app/Hud.h"
#include "input/haptics/HapticFrame.h"

#include <memory>
#include <span>
#include <vector>

namespace shoal::app {

struct OutputOptions {
    bool sound = true;   // false: no device is opened
    bool haptics = true; // likewise
    bool headphones = false;
    float volume = 0.8f;
    float hapticStrength = 1;
    float doppler = audio::kDopplerAsInAir;
    Path video; // whose sound goes along; empty: none
    double videoLength_s = 0;
    float videoSound = 0.8f; // 0 to 1; 0: it is not opened
};

class Outputs {
  public:
    // Never fails: a machine without sound plays on silently and says so once.
    static Outputs open(const OutputOptions& options);
    Outputs(Outputs&&) noexcept;
    Outputs& operator=(Outputs&&) noexcept;
    ~Outputs();

    // attended: false while the player looks elsewhere (another window has the focus): nothing is felt then.
    // videoPosition_s: what is seen of the video, since its first picture.
    void frame(const game::Snapshot& shown, std::span<const game::Event> events, float dt_s, bool attended,
               double videoPosition_s);
    void setVolume(float volume); // 0 to 1

    const haptics::HapticFrame& felt() const;     // what haptic devices were told by the last frame()
    std::span<const HudCaption> captions() const; // newest first; valid until the next frame()

  private:
    struct State;
    explicit Outputs(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace shoal::app
