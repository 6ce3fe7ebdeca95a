// A sound that goes along with something seen: read piece by piece while it plays, and held to the picture's
// time. Internal to this room. All calls want the context current.
//
// How it is held: where the sound is (what has left the device, by its own clock) is compared with where the
// picture is, once a frame. A small distance is closed by playing a little quicker or slower, by half a per
// cent at most, which is 9 cents and is not heard; a large one by starting anew at the right place.
#pragma once

#include "engine/audio/Audio.h"

#include <AL/al.h>
#include <AL/alext.h>

#include <array>
#include <vector>

namespace shoal::audio {

// How quick to play, 1 as it is, when the sound is that much ahead of the picture.
double rateFor(double ahead_s);

class Along {
  public:
    void setUp();
    void tearDown();

    // Of the sound; see Audio::accompany.
    void update(const Accompaniment& sound, double position_s, float gain, bool paused);
    void stop();

    double ahead_s() const { return ahead_s_; } // of the picture, smoothed; 0 while silent

  private:
    static constexpr int kBuffers = 16, kPieceFrames = 1024; // together 0.34 s: a frame may take so long
    enum class State { Stopped, Waiting, Playing };

    void begin(const Accompaniment& sound, double position_s);
    void prime(const Accompaniment& sound, double position_s);
    void refill(const Accompaniment& sound);
    bool queue(const Accompaniment& sound);
    void queueSilence(int64_t frames);
    double heard_s() const;

    ALuint source_ = 0;
    std::array<ALuint, kBuffers> buffers_{};
    std::array<ALuint, kBuffers> spare_{}; // those not queued
    int spares_ = 0;
    LPALGETSOURCEI64VSOFT getOffset_ = nullptr;
    State state_ = State::Stopped;
    std::vector<int16_t> piece_ = std::vector<int16_t>(2 * kPieceFrames);
    int64_t queueBegins_ = 0; // position of the first frame still queued; may be negative: leading silence
    int64_t next_ = 0;        // position of the next frame to be read
    double ahead_s_ = 0;
    bool paused_ = false;
};

} // namespace shoal::audio
