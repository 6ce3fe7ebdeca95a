// Attenuation, low-pass filtering and reverberation of sound in water, as OpenAL effects. Internal to this
// folder. All calls require the OpenAL context to be current.
#pragma once

#include <AL/al.h>
#include <AL/efx.h>

namespace shoal::audio {

// Chosen by ear: over the distances of this game real sea water would be inaudible.
constexpr float kReference_m = 0.7f; // within this a sound keeps its level; beyond, it falls as 1 / distance
constexpr float kHighNear = 0.6f;    // gain above 5 kHz at distance 0
constexpr float kHighFade_m = 4;     // distance over which that falls to 1/e
// Lower bound of that gain: frequencies above 5 kHz carry the directional cues of front and back, above and
// below, which an equal filter on both ears leaves intact as long as they are audible.
constexpr float kHighMin = 0.16f; // -16 dB

// Gain above 5 kHz at a distance, 0 to 1.
float highGain(float distance_m);

// Gain of a sound at a distance: OpenAL's AL_INVERSE_DISTANCE_CLAMPED with a roll-off of 1.
float distanceGain(float distance_m);

class UnderwaterEffects {
  public:
    // Speed of sound, distances, doppler (times water's own), and one reverberation, in open water. Without
    // OpenAL's effects extension it sounds like air, but it sounds.
    void setUp(float doppler);

    // Reverberation: 0 open water, where only ground and surface reflect, to 1 a tunnel.
    void setEnclosure(float enclosure);

    void setSilent(bool silent); // mutes the reverberation

    // A filter for one source; 0 without effects.
    ALuint makeFilter() const;

    // Applies to a source at a distance. Ambient sounds (everywhere) were recorded under water already.
    void place(ALuint source, ALuint filter, float distance_m, bool everywhere) const;

    void tearDown(); // after the sources are gone
    void removeFilter(ALuint filter) const;

  private:
    LPALGENFILTERS genFilters_ = nullptr;
    LPALFILTERI filteri_ = nullptr;
    LPALFILTERF filterf_ = nullptr;
    LPALDELETEFILTERS deleteFilters_ = nullptr;
    LPALAUXILIARYEFFECTSLOTF slotf_ = nullptr;
    ALuint reverb_ = 0, slot_ = 0;
    float enclosure_ = 0;
    bool silent_ = false;
    void applyReverbGain() const;
};

} // namespace shoal::audio
