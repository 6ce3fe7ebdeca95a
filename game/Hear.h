// From what happens to what is heard: which sounds, where, how loud, and what they are called on the screen.
#pragma once

#include "engine/audio/Audio.h"
#include "game/Snapshot.h"

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace shoal::game {

// Every sound of the game once: its file in content/sounds and its caption (empty: none, it would only
// distract).
enum class Sound {
    BedOpen,
    FishPassSmall,
    FishPassLarge,
    Touch,
    Catch,
    Struggle,
    Release,
    Escape,
    Startle,
    Miss,
    SharkNear,
    SharkBite,
    SharkBump,
    Countdown,
    DiveStart,
    DiveOver,
};
struct SoundRow {
    const char* file; // without .flac
    const char* caption;
};
constexpr std::array<SoundRow, 16> kSounds = {{
    {"bed_open", ""},
    {"fish_pass_small", ""},
    {"fish_pass_large", "something large passes"},
    {"touch", ""},
    {"catch", "caught"},
    {"struggle", ""},
    {"release", "let go"},
    {"escape", "it slips away"},
    {"startle", "a fish flees"},
    {"miss", ""},
    {"shark_near", "the shark is near"},
    {"shark_bite", "the shark bites"},
    {"shark_bump", "the shark bumps you"},
    {"countdown", ""},
    {"dive_start", ""},
    {"dive_over", "the dive is over"},
}};

struct Caption {
    std::string_view text;
    glm::vec3 position{0}; // world frame; the origin: nowhere in particular
    float age_s = 0;
};

class Hear {
  public:
    // events: since the last call, dt_s: time since then. clip indices are Sound's. Afterwards emitters(),
    // shots() and captions() say what to play and show.
    void listen(const Snapshot& shown, std::span<const Event> events, float dt_s);

    std::span<const audio::Emitter> emitters() const { return emitters_; }
    std::span<const audio::Shot> shots() const { return shots_; }
    std::span<const Caption> captions() const { return captions_; } // newest first

  private:
    void play(Sound sound, const glm::vec3& position, float gain, bool everywhere = false);

    std::vector<audio::Emitter> emitters_;
    std::vector<audio::Shot> shots_;
    std::vector<Caption> captions_;
    std::vector<float> quiet_s_; // per creature: until it may be heard passing again
    int countedDown_ = 0;        // the last second that was counted
};

} // namespace shoal::game
