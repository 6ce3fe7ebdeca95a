// Sounds, captions and haptics of a dive, from its snapshots and events. Main thread; allocates nothing once
// the creatures are known.
#pragma once

#include "engine/audio/Audio.h"
#include "engine/core/Random.h"
#include "game/feedback/EventTable.h"
#include "game/rules/Snapshot.h"
#include "input/haptics/HapticFrame.h"

#include <span>
#include <vector>

namespace shoal::game {

constexpr float kCaptionStay_s = 2.2f, kCaptionEach_s = 1; // Each: time from one new line to the next

struct Caption {
    Text text;
    glm::vec3 position{0}; // world frame; the origin: no place
    float age_s = 0;       // below 0: it is not shown yet
};

// Returns how tense the music is, 0 to 1: by what the shark does and how near it is, and by the last seconds.
float tensionOf(const Snapshot& shown);

// Chooses sounds and captions: for events by their table, and for breath, passing fish, the background, the
// music and the countdown.
class SoundCues {
  public:
    SoundCues();

    // Chooses the sounds and captions of a frame: emitters(), shots() and captions(). events: since the last
    // call; dt_s: time since then; volume, music: the player's settings, 0 to 1; music 0: none is loaded, or
    // wanted. Clip indices are Sound's, then those of kMusicLayers.
    void listen(const Snapshot& shown, std::span<const Event> events, float dt_s, float volume = 1,
                float music = 0);

    // Returns how enclosed the beds sound, 0 to 1: follows the snapshot's enclosure within seconds.
    float enclosure() const { return enclosure_; }

    std::span<const audio::Sound> emitters() const { return emitters_; }
    std::span<const audio::Sound> shots() const { return shots_; }
    std::span<const Caption> captions() const { return captions_; } // newest first

  private:
    float gainOf(Sound sound) const { return rowOf(sound).gain * volume_; }
    void play(Sound sound, const glm::vec3& position, float gain, bool everywhere = false, float pitch = 1,
              const glm::vec3& velocity = glm::vec3(0));
    void caption(Text text, const glm::vec3& position);
    void loop(size_t clip, float gain, bool inStep);
    void beds(const Snapshot& shown, float dt_s);
    void playMusic(const Snapshot& shown, std::span<const Event> events, float dt_s, float volume);
    void passing(const CreatureView& creature, const glm::vec3& headWorld, float& quiet_s);
    void struggling(const CreatureView& creature);
    void happened(const Event& event);
    void breathe(const Snapshot& shown, float dt_s);
    void countDown(const Snapshot& shown);

    std::vector<audio::Sound> emitters_;
    std::vector<audio::Sound> shots_;
    std::vector<Caption> captions_;
    std::vector<float> quiet_s_; // seconds before each creature may be heard passing again
    float volume_ = 1, touchQuiet_s_ = 0;
    float breath_s_;                          // seconds until the next breath
    float enclosure_ = 0;                     // follows the snapshot's enclosure without steps
    float calm_ = 0, tension_ = 0, lift_ = 0; // levels of the music, 0 to 1, without steps
    float liftLeft_s_ = 0;                    // seconds before the lift after a catch ends
    int countedDown_ = 0;                     // last second counted
    Random random_;                           // random pitches and breaths, apart from the simulation's
};

// Actuation of every haptic actuator: a fading pulse for each event; and pressing, stroking and the struggle
// of a held fish while a finger touches it. Time is an argument; the pulses are the only state.
class HapticFeedback {
  public:
    // Returns a frame's actuation. events: since the last call; dt_s: time since then; strength: 0 to 1.
    haptics::HapticFrame frame(const Snapshot& shown, std::span<const Event> events, float dt_s,
                               float strength);

  private:
    struct Pulse : haptics::Actuation { // its present one
        float decay_s = 1;              // time constant: falls to 1/e
    };
    void startPulse(const Event&);

    std::array<Pulse, haptics::kActuatorCount + 1> pulses_{}; // the last is the body's
};

} // namespace shoal::game
