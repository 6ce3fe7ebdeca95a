// The water between a sound and the ear, as OpenAL effects. Internal to this room. All calls want the
// context current.
#pragma once

#include <AL/al.h>
#include <AL/efx.h>

namespace shoal::audio {

// Set by ear: real sea water is clear to sound over any distance of this game, but would not sound like
// water.
constexpr float kReference_m = 0.7f; // within this a sound keeps its level; beyond, it falls as 1 / distance
constexpr float kHighNear = 0.6f;    // what is left of the tones above 5 kHz at no distance
constexpr float kHighFade_m = 4;     // and over which distance that falls to 1/e
// But never below this: the tones above 5 kHz tell front from back and above from below. The filter takes the
// same from both ears and all directions, so what is left still tells, as long as it can be heard.
constexpr float kHighLeast = 0.16f; // -16 dB

// Gain of the high tones at a distance, 0 to 1.
float highGain(float distance_m);

// Gain of a sound at a distance: OpenAL's AL_INVERSE_DISTANCE_CLAMPED with a roll-off of 1.
float distanceGain(float distance_m);

class Medium {
  public:
    // Speed of sound, distances, doppler (times water's own), and one reverberation, in open water. Without
    // OpenAL's effects extension it sounds like air, but it sounds.
    void setUp(float doppler);

    // How much comes back from the walls: 0 open water, where only the ground and the surface answer, to 1 a
    // tunnel.
    void setShelter(float shelter);

    void setSilent(bool silent); // no echo is heard either

    // A filter for one source; 0 without effects.
    ALuint makeFilter() const;

    // A source at a distance; at ones everywhere (beds) the water is part of the recording.
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
    float shelter_ = 0;
    bool silent_ = false;
    void setEcho() const;
};

} // namespace shoal::audio
