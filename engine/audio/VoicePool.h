// Fixed pool of OpenAL sources, their assignment to sounds, and the effects of the water on them:
// attenuation, low-pass filtering, reverberation. Internal to this folder. All calls require the OpenAL
// context to be current.
#pragma once

#include "engine/audio/Audio.h"

#include <AL/al.h>

#include <array>

namespace shoal::audio {

class VoicePool {
  public:
    // Makes kSources voices, fewer if the device has fewer.
    void setUp();
    void tearDown();

    // Clips and their OpenAL buffers, indexed by Sound::clip. update() is called once a frame; now_s: the
    // device's clock, minus the time paused.
    struct Clips {
        std::span<const ALuint> buffers;
        std::span<const Clip> clips;
    };
    void update(const Clips& clips, const glm::vec3& listener, std::span<const Sound> emitters,
                std::span<const Sound> shots, double now_s);

    // Set the reverberation. enclosure: from 0, open water where only ground and surface reflect, to 1, a
    // tunnel. silent: no reverberation; the listener's gain silences the rest.
    void setEnclosure(float enclosure);
    void setSilent(bool silent);
    void setPaused(bool paused);
    int sounding() const;

  private:
    enum class Use { Free, OneShot, Emitter, Ending };
    struct Voice {
        ALuint source = 0; // 0: the device has no more sources
        ALuint filter = 0; // its low-pass
        Use use = Use::Free;
        Sound sound;
        double since_s = 0; // when it started, or began to end
        float loudness = 0; // gain at the ear
    };

    void release(Voice& voice);
    void place(Voice& voice, const glm::vec3& listener, double age_s);
    void start(Voice& voice, const Clips& clips, bool loop);
    Voice* voiceFor(float loudness);
    void applyReverbGain() const;
    void applyWater(const Voice& voice, float distance_m) const;

    ALuint reverb_ = 0, slot_ = 0;
    float enclosure_ = 0;
    bool silent_ = false;
    std::array<Voice, Audio::kSources> voices_{};
};

} // namespace shoal::audio
