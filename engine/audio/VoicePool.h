// Fixed pool of OpenAL sources and their assignment to sounds. Internal to this folder. All calls require the
// OpenAL context to be current.
#pragma once

#include "engine/audio/Audio.h"
#include "engine/audio/UnderwaterEffects.h"

#include <array>

namespace shoal::audio {

class VoicePool {
  public:
    void setUp(float doppler); // fewer than kSources where the device has fewer
    void tearDown();

    // One frame. now_s: the device's clock, less the time spent paused.
    struct Clips {
        std::span<const ALuint> buffers;
        std::span<const Clip> clips;
    };
    void update(const Clips& clips, const glm::vec3& listener, std::span<const Emitter> emitters,
                std::span<const OneShot> shots, double now_s);

    void setEnclosure(float enclosure) { effects_.setEnclosure(enclosure); } // 0 to 1
    void setSilent(bool silent) { effects_.setSilent(silent); } // no echo; the listener's gain does the rest
    void setPaused(bool paused);
    int sounding() const;

  private:
    enum class Use { Free, OneShot, Emitter, Ending };
    struct Voice {
        ALuint source = 0; // 0: the device has no more
        ALuint filter = 0;
        Use use = Use::Free;
        uint32_t id = 0;    // of the emitter
        OneShot shot;       // what plays, of an emitter likewise
        double since_s = 0; // when it started, or began to end
        float loudness = 0; // gain at the ear
    };

    void release(Voice& voice);
    void place(Voice& voice, const glm::vec3& listener, double age_s);
    void start(Voice& voice, const Clips& clips, bool loop);
    Voice* voiceFor(float loudness);
    static float loudnessOf(const OneShot& shot, const glm::vec3& listener);

    UnderwaterEffects effects_;
    std::array<Voice, Audio::kSources> voices_{};
};

} // namespace shoal::audio
