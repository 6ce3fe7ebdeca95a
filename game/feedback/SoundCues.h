// Chooses sounds and captions of a dive: for events by their table, and for breath, passing fish, the
// background and the countdown. Main thread; allocates nothing once the creatures are known.
#pragma once

#include "engine/audio/Audio.h"
#include "engine/core/Random.h"
#include "game/feedback/EventTable.h"
#include "game/rules/Snapshot.h"

#include <span>
#include <vector>

namespace shoal::game {

constexpr float kCaptionStay_s = 2.2f;

struct Caption {
    Text text;
    glm::vec3 position{0}; // world frame; the origin: no place
    float age_s = 0;
};

class SoundCues {
  public:
    SoundCues();

    // Chooses the sounds and captions of a frame: emitters(), shots() and captions(). events: since the last
    // call; dt_s: time since then; volume: the player's setting, 0 to 1. Clip indices are Sound's.
    void listen(const Snapshot& shown, std::span<const Event> events, float dt_s, float volume = 1);

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
    void beds(const Snapshot& shown, float dt_s);
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
    bool counted_ = false; // the last grab has become a catch
    float breath_s_;       // seconds until the next breath
    float enclosure_ = 0;  // follows the snapshot's enclosure without steps
    int countedDown_ = 0;  // last second counted
    Random random_;        // random pitches and breaths, apart from the simulation's
};

} // namespace shoal::game
