// Streaming source that is kept in step with a video. Internal to this folder. All calls require the OpenAL
// context to be current.
//
// Once a frame the position of the sound (what has left the device, by its own clock) is compared with the
// picture's. A small offset is corrected by the playback rate, by half a per cent at most, which is 9 cents
// and inaudible; a large one by restarting at the right position.
#pragma once

#include "engine/audio/Audio.h"

#include <AL/al.h>
#include <AL/alext.h>

#include <array>
#include <vector>

namespace shoal::audio {

// Returns the playback rate that corrects this offset; 1: none.
double rateFor(double ahead_s);

class StreamedTrack {
  public:
    void setUp();
    void tearDown();

    // See Audio::syncTrack().
    void update(const TrackSource& sound, double position_s, float gain, bool paused);
    void stop();

    double ahead_s() const { return ahead_s_; } // offset to the picture, smoothed; 0 while silent

  private:
    static constexpr int kBuffers = 16, kPieceFrames = 1024; // 0.34 s in all, for a slow frame
    enum class State { Stopped, Waiting, Playing };

    void begin(const TrackSource& sound, double position_s);
    void prime(const TrackSource& sound, double position_s);
    void refill(const TrackSource& sound);
    bool queue(const TrackSource& sound);
    void queuePiece(int64_t frames);
    void queueSilence(int64_t frames);
    double heard_s() const;

    ALuint source_ = 0;
    std::array<ALuint, kBuffers> buffers_{};
    std::array<ALuint, kBuffers> spare_{}; // the first spares_ of them are not queued
    int spares_ = 0;
    State state_ = State::Stopped;
    std::vector<int16_t> piece_ = std::vector<int16_t>(2 * kPieceFrames);
    int64_t queueBegins_ = 0; // position of the first frame still queued; may be negative: leading silence
    int64_t next_ = 0;        // position of the next frame to be read
    double ahead_s_ = 0;
    bool paused_ = false;
};

} // namespace shoal::audio
