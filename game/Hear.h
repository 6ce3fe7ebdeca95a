// From what happens to what is heard: which sounds, where, how loud, and what they are called on the screen.
#pragma once

#include "engine/audio/Audio.h"
#include "engine/core/Random.h"
#include "game/Snapshot.h"

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace shoal::game {

// Every sound of the game once, in the order of kSounds, which is also the order of the audio's clips.
enum class Sound {
    BedOpen,
    BedTunnel,
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
    Bubbles,
    Countdown,
    DiveStart,
    DiveOver,
};
struct SoundRow {
    const char* file;    // in content/sounds, without .flac
    const char* caption; // empty: none, it would only distract
    float gain;          // 0 to 1, at the loudness it was mastered to
};
constexpr std::array<SoundRow, 18> kSounds = {{
    {"bed_open", "", 0.45f},
    {"bed_tunnel", "", 0.5f},
    {"fish_pass_small", "", 0.8f},
    {"fish_pass_large", "something large passes", 1},
    {"touch", "", 1},
    {"catch", "caught", 1},
    {"struggle", "it struggles", 0.8f},
    {"release", "let go", 0.9f},
    {"escape", "it slips away", 1},
    {"startle", "a fish flees", 0.8f},
    {"miss", "", 0.9f},
    {"shark_near", "the shark is near", 1},
    {"shark_bite", "the shark bites", 1},
    {"shark_bump", "the shark bumps you", 1},
    {"bubbles", "", 0.3f},
    {"countdown", "the last seconds", 0.8f},
    {"dive_start", "the dive begins", 0.8f},
    {"dive_over", "the dive is over", 1},
}};

// What is heard of each kind of event, in the order of Event::Kind.
struct Heard {
    Sound sound;
    float gain;              // without strength
    float perStrength;       // and what each m/s adds; together at most 1
    bool everywhere = false; // no place of its own
};
constexpr std::array<Heard, kEventNames.size()> kHeard = {{
    {Sound::Touch, 0.4f, 0.4f},
    {Sound::Startle, 1, 0},
    {Sound::Touch, 1, 0}, // a grab
    {Sound::Catch, 1, 0},
    {Sound::Release, 1, 0},
    {Sound::Escape, 1, 0},
    {Sound::Miss, 1, 0},
    {Sound::SharkNear, 1, 0},
    {Sound::SharkBump, 0.5f, 0.4f},
    {Sound::SharkBite, 1, 0},
    {Sound::DiveStart, 1, 0, true},
    {Sound::DiveOver, 1, 0, true},
}};

struct Caption {
    std::string_view text;
    glm::vec3 position{0}; // world frame; the origin: nowhere in particular
    float age_s = 0;
};

class Hear {
  public:
    Hear();

    // events: since the last call, dt_s: time since then. Clip indices are Sound's. Afterwards emitters(),
    // shots() and captions() say what to play and show. Takes no memory once the creatures are known.
    void listen(const Snapshot& shown, std::span<const Event> events, float dt_s);

    // How enclosed the beds sound, 0 to 1: follows the snapshot's shelter within seconds.
    float shelter() const { return shelter_; }

    std::span<const audio::Emitter> emitters() const { return emitters_; }
    std::span<const audio::Shot> shots() const { return shots_; }
    std::span<const Caption> captions() const { return captions_; } // newest first

  private:
    void play(Sound sound, const glm::vec3& position, float gain, bool everywhere = false, float pitch = 1,
              const glm::vec3& velocity = glm::vec3(0));
    void caption(Sound sound, const glm::vec3& position);
    void beds(const Snapshot& shown, float dt_s);
    void passing(const CreatureView& creature, float& quiet_s);
    void struggling(const CreatureView& creature);
    void happened(const Event& event);
    void breathe(const Snapshot& shown, float dt_s);
    void countDown(const Snapshot& shown);

    std::vector<audio::Emitter> emitters_;
    std::vector<audio::Shot> shots_;
    std::vector<Caption> captions_;
    std::vector<float> quiet_s_; // per creature: until it may be heard passing again
    float touchQuiet_s_ = 0;
    float breath_s_;      // until the next
    float shelter_ = 0;   // of what is shown, but never in a step
    int countedDown_ = 0; // the last second that was counted
    Random random_;       // of pitches and breaths; the simulation's is not touched
};

} // namespace shoal::game
