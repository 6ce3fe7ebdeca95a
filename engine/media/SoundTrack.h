// The sound of a video file, decoded on a thread of its own, read as samples, looping: stereo or first-order
// ambisonics in FuMa B-format (W, X, Y, Z; X points to the picture's middle, Y left, Z up).
//
// Time: positions are frames of sound at 48 kHz since the first picture of the video. Where the file has no
// sound (it begins late, has gaps, or ends early) there is silence.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Hidden.h"
#include "engine/core/Result.h"

#include <cstdint>
#include <span>

namespace shoal::media {

constexpr int kSoundRate_Hz = 48000;
constexpr int kSoundAhead = kSoundRate_Hz; // frames decoded ahead at most

class SoundTrack {
  public:
    // Opens a video file's sound. passLength_s: length of the video, after which it loops; 0: the file's own.
    // Fails if the file has no sound that can be decoded.
    static Result<SoundTrack> open(const Path& file, double passLength_s);

    int64_t passLength() const; // frames
    int channels() const;       // 2: stereo; 4: B-format

    // Makes this frame (modulo the pass's length) the next to be read. Does not wait.
    void seek(int64_t frame);

    // Reads the next frames, interleaved, and returns their number: fewer than asked for where the thread has
    // not decoded them yet. After damage in the file the rest is silence. Does not wait.
    size_t read(std::span<int16_t> samples);

  private:
    struct Impl;
    explicit SoundTrack(Hidden<Impl> impl) : impl_(std::move(impl)) {}
    Hidden<Impl> impl_; // its destructor ends the thread
};

} // namespace shoal::media
