// The fixed pool of sources and who has them. Internal to this room. All calls want the context current.
#pragma once

#include "engine/audio/Audio.h"
#include "engine/audio/Medium.h"

#include <array>

namespace shoal::audio {

class Voices {
  public:
    void setUp(float doppler); // fewer than kSources where the device has fewer
    void tearDown();

    // One frame. now_s: the device's clock, less the time spent paused.
    struct Clips {
        std::span<const ALuint> buffers;
        std::span<const Clip> clips;
    };
    void update(const Clips& clips, const glm::vec3& listener, std::span<const Emitter> emitters,
                std::span<const Shot> shots, double now_s);

    void setShelter(float shelter) { medium_.setShelter(shelter); } // 0 to 1
    void setSilent(bool silent) { medium_.setSilent(silent); } // no echo; the listener's gain does the rest
    void setPaused(bool paused);
    int sounding() const;

  private:
    enum class Use { Free, Shot, Emitter, Ending };
    struct Voice {
        ALuint source = 0; // 0: the device has no more
        ALuint filter = 0;
        Use use = Use::Free;
        uint32_t id = 0;    // of the emitter
        Shot shot;          // what plays; of an emitter likewise
        double since_s = 0; // when it started, or began to end
        float heard = 0;    // gain at the ear
    };

    void release(Voice& voice);
    void place(Voice& voice, const glm::vec3& listener, double age_s);
    void start(Voice& voice, const Clips& clips, bool loop);
    Voice* voiceFor(float heard);
    static float heardGain(const Shot& shot, const glm::vec3& listener);

    Medium medium_;
    std::array<Voice, Audio::kSources> voices_{};
};

} // namespace shoal::audio
