// From a file's sound stream to stereo samples at kSoundRate_Hz with their place in time. Internal to this
// room; belongs to one thread.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace shoal::media {

class SoundDecoder {
  public:
    static Result<SoundDecoder> open(const Path& file);
    SoundDecoder(SoundDecoder&&) noexcept;
    SoundDecoder& operator=(SoundDecoder&&) noexcept;
    ~SoundDecoder();

    double length_s() const; // as the file says; 0 if it does not

    // To this frame or somewhat before it; false if the file does not let itself be read there.
    bool seek(int64_t frame);

    // Replaces stereo by the next samples, of which the first is the frame returned; -1 at the end, or where
    // nothing more can be decoded. At most some tenths of a second at a time.
    int64_t next(std::vector<int16_t>& stereo);

  private:
    struct Impl;
    explicit SoundDecoder(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace shoal::media
