// Chooses sounds and captions for what happens in a dive: for events by their table, and for breath, fish
// that pass, the background and the countdown. Main thread; takes no memory once the creatures are known.
#pragma once

#include "engine/audio/Audio.h"
#include "engine/core/Random.h"
#include "game/feedback/EventTable.h"
#include "game/rules/Events.h"
#include "game/rules/Snapshot.h"

#include <span>
#include <vector>

namespace shoal::game {

constexpr float kCaptionStay_s = 2.2f;

struct Caption {
    Text text;
    glm::vec3 position{0}; // world frame; the origin: nowhere in particular
    float age_s = 0;
};

class SoundCues {
  public:
    SoundCues();

    // events: since the last call, dt_s: time since then. Clip indices are Sound's. Afterwards emitters(),
    // shots() and captions() say what to play and show.
    void listen(const Snapshot& shown, std::span<const Event> events, float dt_s);

    // How enclosed the beds sound, 0 to 1: follows the snapshot's enclosure within seconds.
    float enclosure() const { return enclosure_; }

    std::span<const audio::Sound> emitters() const { return emitters_; }
    std::span<const audio::Sound> shots() const { return shots_; }
    std::span<const Caption> captions() const { return captions_; } // newest first

  private:
    void play(Sound sound, const glm::vec3& position, float gain, bool everywhere = false, float pitch = 1,
              const glm::vec3& velocity = glm::vec3(0));
    void caption(Text text, const glm::vec3& position);
    void beds(const Snapshot& shown, float dt_s);
    void passing(const CreatureView& creature, float& quiet_s);
    void struggling(const CreatureView& creature);
    void happened(const Event& event);
    void breathe(const Snapshot& shown, float dt_s);
    void countDown(const Snapshot& shown);

    std::vector<audio::Sound> emitters_;
    std::vector<audio::Sound> shots_;
    std::vector<Caption> captions_;
    std::vector<float> quiet_s_; // per creature: until it may be heard passing again
    float touchQuiet_s_ = 0;
    bool counted_ = false; // what was held last
    float breath_s_;       // until the next
    float enclosure_ = 0;  // of what is shown, but never in a step
    int countedDown_ = 0;  // the last second that was counted
    Random random_;        // of pitches and breaths; the simulation's is not touched
};

} // namespace shoal::game
