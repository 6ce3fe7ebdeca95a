// The sound of a video, decoded on a thread of its own and read as plain samples. FFmpeg's libraries do the
// work, apart from the picture's.
//
// Time: positions are frames of sound at 48 kHz since the first picture of the video. What the file lacks
// (a sound that begins late, has holes, or ends early) is silence. Behind the last frame of a pass the first
// follows.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <cstdint>
#include <memory>
#include <span>

namespace shoal::media {

constexpr int kSoundRate_Hz = 48000;
constexpr int kSoundAhead = kSoundRate_Hz; // frames decoded ahead at most, 192 kB

class SoundTrack {
  public:
    // passLength_s: of the video; 0: as long as the file says that it is. Fails where the file has no sound
    // that can be decoded; nothing is trusted that the file says of itself.
    static Result<SoundTrack> open(const Path& file, double passLength_s);
    SoundTrack(SoundTrack&&) noexcept;
    SoundTrack& operator=(SoundTrack&&) noexcept;
    ~SoundTrack(); // ends the thread after at most the packet in work

    int64_t passLength() const; // frames

    // The next frame to be read is this one (modulo the pass's length). Does not wait.
    void seek(int64_t frame);

    // The next frames, left and right in turn; how many there were: fewer than asked for where the thread is
    // not so far yet, unless told to wait for it. Once the file proves damaged, all further is silence.
    size_t read(std::span<int16_t> stereo, bool wait = false);

  private:
    struct Impl;
    explicit SoundTrack(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace shoal::media
