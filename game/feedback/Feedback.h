// Sounds, captions and haptics of a dive, from its snapshots and events. Main thread. Allocates nothing after
// the first frame with all creatures.
#pragma once

#include "engine/audio/Audio.h"
#include "engine/core/Random.h"
#include "game/feedback/EventTable.h"
#include "game/rules/Snapshot.h"
#include "input/haptics/HapticFrame.h"

#include <span>
#include <vector>

namespace shoal::game {

constexpr float kCaptionStay_s = 2.2f, kCaptionGap_s = 1; // time on display; time between new captions

struct Caption {
    Text text;
    glm::vec3 position{0}; // world frame; 0: the caption belongs to no place
    float age_s = 0;       // below 0: it is not shown yet
};

// Returns the tension of the music, 0 to 1, from the shark's behaviour and distance and from the time left.
float tensionOf(const Snapshot& shown);

// Chooses sounds and captions: for events by EventTable.h; and for breath, passing and held fish, background
// sounds (beds), music and countdown.
class SoundCues {
  public:
    SoundCues();

    // Chooses the sounds and captions of a frame: emitters(), shots() and captions(). events: since the last
    // call; dt_s: time since then; volume, music: the player's settings, 0 to 1; music 0: it is off or not
    // loaded. Clip indices: those of Sound, then kMusicLayers.
    void listen(const Snapshot& shown, std::span<const Event> events, float dt_s, float volume = 1,
                float music = 0);

    // Returns the cross-fade from the open to the tunnel bed, 0 to 1; it follows Snapshot::enclosure.
    float enclosure() const { return enclosure_; }

    std::span<const audio::Sound> emitters() const { return emitters_; }
    std::span<const audio::Sound> shots() const { return shots_; }
    std::span<const Caption> captions() const { return captions_; } // newest first

  private:
    float gainOf(Sound sound) const { return rowOf(sound).gain * volume_; }
    void play(Sound sound, const glm::vec3& position, float gain, bool everywhere = false, float pitch = 1,
              const glm::vec3& velocity = glm::vec3(0));
    void caption(Text text, const glm::vec3& position);
    void playLoop(size_t clip, float gain, bool inStep);
    void playBeds(const Snapshot& shown, float dt_s);
    void playMusic(const Snapshot& shown, std::span<const Event> events, float dt_s, float volume);
    void playPass(const CreatureView& creature, const glm::vec3& headWorld, float& quiet_s);
    void playStruggle(const CreatureView& creature);
    void playEvent(const Event& event);
    void playBreath(const Snapshot& shown, float dt_s);
    void playCountdown(const Snapshot& shown);

    std::vector<audio::Sound> emitters_;
    std::vector<audio::Sound> shots_;
    std::vector<Caption> captions_;
    std::vector<float> quiet_s_; // by creature: seconds until a sound of its passing may play again
    std::array<float, kEventRows.size()> eventQuiet_s_{}; // by EventKind: seconds until it may sound again
    float volume_ = 1;
    float breath_s_;                          // seconds until the next breath
    float enclosure_ = 0;                     // Snapshot::enclosure, smoothed
    float calm_ = 0, tension_ = 0, lift_ = 0; // levels of the music, 0 to 1, smoothed
    float liftLeft_s_ = 0;                    // seconds until the lift after a catch ends
    int countedDown_ = 0;                     // last second counted
    Random random_;                           // for pitches and breaths; the simulation has its own
};

// Computes the actuation of all haptic actuators: a fading pulse for each event; and, while a finger touches,
// its pressure, its stroking and the struggle of a held fish. The pulses are its only state.
class HapticFeedback {
  public:
    // Returns a frame's actuation. events: since the last call; dt_s: time since then; strength: 0 to 1.
    haptics::HapticFrame frame(const Snapshot& shown, std::span<const Event> events, float dt_s,
                               float strength);

  private:
    struct Pulse : haptics::Actuation { // base: the current actuation, which decays
        float decay_s = 1;              // time constant: falls to 1/e
    };
    void startPulse(const Event&);

    std::array<Pulse, haptics::kActuatorCount + 1> pulses_{}; // the last is the body's
};

} // namespace shoal::game
