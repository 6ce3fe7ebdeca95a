// Streaming source, kept in step with a video; part of Audio.cpp. All calls require a current OpenAL context.
//
// Once a frame the position of the sound (what has left the device, by its own clock) is compared with the
// picture's. A small offset is corrected by the playback rate, by half a per cent at most, which is 9 cents
// and inaudible; a large one by restarting at the right position.
#pragma once

#include "engine/audio/Audio.h"

#include <AL/alext.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace shoal::audio {

// Returns the playback rate that corrects this offset; 1: none.
inline double rateFor(double ahead_s) {
    constexpr double kMaxBend = 0.005, kCorrection_s = 2; // time constant
    return 1 - std::clamp(ahead_s / kCorrection_s, -kMaxBend, kMaxBend);
}

// Returns a frame's directions ahead and up, as AL_ORIENTATION wants them.
inline std::array<ALfloat, 6> orientationOf(const glm::quat& rotation) {
    const glm::vec3 ahead = rotation * glm::vec3(0, 0, -1), up = rotation * glm::vec3(0, 1, 0);
    return {ahead.x, ahead.y, ahead.z, up.x, up.y, up.z};
}

class StreamedTrack {
  public:
    // Makes the source and its buffers in a new context; they end with it.
    void setUp() {
        source_ = 0; // stays so if the device has no more
        alGenSources(1, &source_);
        alGenBuffers(kBuffers, buffers_.data());
        alSourcei(source_, AL_SOURCE_RELATIVE, AL_TRUE);
        alSourcei(source_, AL_DIRECT_CHANNELS_SOFT, AL_TRUE);
        stop();
    }

    // Turns B-format by the source's orientation (AL_EXT_BFORMAT, which OpenAL Soft has had since 1.15).
    void turn(const glm::quat& headFromTrack) const {
        if (source_) alSourcefv(source_, AL_ORIENTATION, orientationOf(headFromTrack).data());
    }

    // See Audio::syncTrack().
    void update(const TrackSource& sound, double position_s, float gain, bool paused) {
        if (!source_) return;
        // Before pausing, the gain goes to 0, to which OpenAL fades without a click.
        alSourcef(source_, AL_GAIN, paused ? 0 : std::clamp(gain, 0.0f, 1.0f));
        if (paused) {
            if (paused_ && state_ == State::Playing) alSourcePause(source_);
            paused_ = true;
            return;
        }
        ALint state = AL_STOPPED;
        alGetSourcei(source_, AL_SOURCE_STATE, &state);
        if (paused_ && state == AL_PAUSED) alSourcePlay(source_);
        const bool ranDry = state_ == State::Playing && state == AL_STOPPED;
        paused_ = false;
        if (state_ == State::Stopped || ranDry) begin(sound, position_s);
        if (state_ == State::Waiting) return prime(sound, position_s);
        refill(sound);
        const double ahead_s = wrapped(heard_s() - position_s, sound);
        if (std::abs(ahead_s) > kJump_s) return begin(sound, position_s);
        ahead_s_ += kSmoothing * (ahead_s - ahead_s_);
        alSourcef(source_, AL_PITCH, static_cast<ALfloat>(rateFor(ahead_s_)));
    }

    void stop() {
        alSourceStop(source_);
        alSourcei(source_, AL_BUFFER, 0); // releases all queued buffers
        spare_.assign(buffers_.begin(), buffers_.end());
        ahead_s_ = 0;
        state_ = State::Stopped;
    }

    double ahead_s() const { return ahead_s_; } // offset to the picture, smoothed; 0 while silent

  private:
    static constexpr int kRate_Hz = 48000;
    static constexpr double kJump_s = 0.08;      // larger offsets, which would be seen, restart it
    static constexpr double kLead_s = 0.05;      // starts reading so far ahead, because reading takes time
    static constexpr double kSmoothing = 0.1;    // weight of each new measurement of the offset
    static constexpr int kMinPieces = 4;         // number of pieces queued before it starts
    static constexpr double kMaxSilence_s = 0.1; // longest silence queued in front of its first samples
    static constexpr int kBuffers = 16, kPieceFrames = 1024; // 0.34 s in all, for a slow frame
    enum class State { Stopped, Waiting, Playing };

    static int64_t frameBytes(const TrackSource& sound) {
        return sound.channels * static_cast<int64_t>(sizeof(int16_t));
    }
    static int64_t framesOf(double seconds) { return std::llround(seconds * kRate_Hz); }

    // Wraps to -half .. half of the track's length.
    static double wrapped(double seconds, const TrackSource& sound) {
        const double length_s = static_cast<double>(sound.length) / kRate_Hz;
        return seconds - length_s * std::round(seconds / length_s);
    }

    void begin(const TrackSource& sound, double position_s) {
        stop();
        next_ = framesOf(position_s + kLead_s);
        sound.seek(next_);
        state_ = State::Waiting;
    }

    // Fills piece_; returns the number of frames, at most `maximum`, that were ready.
    int64_t read(const TrackSource& sound, int64_t maximum) {
        const auto samples = static_cast<size_t>(sound.channels * maximum);
        return static_cast<int64_t>(sound.read(std::span(piece_).first(samples)));
    }

    // Fills and queues the spare buffers for as long as samples are ready; returns their number.
    int queue(const TrackSource& sound) {
        int queued = 0;
        for (; !spare_.empty(); ++queued) {
            const int64_t frames = read(sound, kPieceFrames);
            if (frames == 0) break;
            queuePiece(sound, frames);
            next_ += frames;
        }
        return queued;
    }

    // Queues the first frames of piece_.
    void queuePiece(const TrackSource& sound, int64_t frames) {
        const ALuint buffer = spare_.back();
        spare_.pop_back();
        alBufferData(buffer, sound.channels == 4 ? AL_FORMAT_BFORMAT3D_16 : AL_FORMAT_STEREO16, piece_.data(),
                     static_cast<ALsizei>(frames * frameBytes(sound)), kRate_Hz);
        alSourceQueueBuffers(source_, 1, &buffer);
    }

    void queueSilence(const TrackSource& sound, int64_t frames) {
        std::fill(piece_.begin(), piece_.end(), int16_t{0});
        for (; frames > 0; frames -= kPieceFrames) queuePiece(sound, std::min<int64_t>(frames, kPieceFrames));
    }

    // Starts playing at the right time, exact to the sample.
    void prime(const TrackSource& sound, double position_s) {
        const double ahead_s = wrapped(static_cast<double>(next_) / kRate_Hz - position_s, sound);
        if (std::abs(ahead_s) > 1) return begin(sound, position_s); // the picture has jumped meanwhile
        if (ahead_s > kMaxSilence_s) return;                        // too early to start
        for (int64_t late = framesOf(-ahead_s); late > 0;) { // skips what should have been heard already
            const auto frames = read(sound, std::min<int64_t>(late, kPieceFrames));
            if (frames == 0) return;
            next_ += frames;
            late -= frames;
        }
        const int64_t early = std::max<int64_t>(framesOf(ahead_s), 0);
        queueBegins_ = next_ - early;
        queueSilence(sound, early);
        if (queue(sound) < kMinPieces)
            return begin(sound, position_s); // too little to last until the next frame
        alSourcePlay(source_);
        state_ = State::Playing;
    }

    void refill(const TrackSource& sound) {
        ALint done = 0;
        alGetSourcei(source_, AL_BUFFERS_PROCESSED, &done);
        for (; done > 0; --done) {
            ALuint buffer = 0;
            ALint bytes = 0;
            alSourceUnqueueBuffers(source_, 1, &buffer);
            alGetBufferi(buffer, AL_SIZE, &bytes);
            queueBegins_ += bytes / frameBytes(sound);
            spare_.push_back(buffer);
        }
        queue(sound);
    }

    // Returns the position in the track that leaves the device now.
    double heard_s() const {
        std::array<ALint64SOFT, 2> offset{}; // frames as 32.32, and nanoseconds on the way to the ear
        alGetSourcei64vSOFT(source_, AL_SAMPLE_OFFSET_LATENCY_SOFT, offset.data());
        return static_cast<double>(queueBegins_) / kRate_Hz +
               static_cast<double>(offset[0]) / (4294967296.0 * kRate_Hz) -
               static_cast<double>(offset[1]) * 1e-9;
    }

    ALuint source_ = 0;
    std::array<ALuint, kBuffers> buffers_{};
    std::vector<ALuint> spare_; // those that are not queued
    State state_ = State::Stopped;
    std::vector<int16_t> piece_ = std::vector<int16_t>(4 * kPieceFrames); // enough for B-format
    int64_t queueBegins_ = 0; // position of the first frame still queued; may be negative: leading silence
    int64_t next_ = 0;        // position of the next frame to be read
    double ahead_s_ = 0;
    bool paused_ = false;
};

} // namespace shoal::audio
