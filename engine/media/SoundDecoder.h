// Decoder of a file's sound stream: stereo samples at kSoundRate_Hz with their place in time. Internal to
// this folder; belongs to one thread.
#pragma once

#include "engine/core/Result.h"
#include "engine/media/Ffmpeg.h"

extern "C" {
#include <libswresample/swresample.h>
}

#include <cstdint>
#include <vector>

namespace shoal::media {

class SoundDecoder {
  public:
    static Result<SoundDecoder> open(const Path& file);

    double length_s() const; // as the file says; 0 if it does not

    // To this frame or somewhat before it; false if the file does not let itself be read there.
    bool seek(int64_t frame);

    // Replaces stereo by the next samples, of which the first is the frame returned; -1 at the end, or where
    // nothing more can be decoded. At most some tenths of a second at a time.
    int64_t next(std::vector<int16_t>& stereo);

  private:
    SoundDecoder() = default;
    int64_t convert(std::vector<int16_t>& stereo);

    Input input_;
    Codec codec_;
    std::unique_ptr<SwrContext, FreeAt<swr_free>> converter_{swr_alloc()}; // set up by the block it meets
    Packet packet_ = makePacket();
    Frame block_ = makeFrame(), converted_ = makeFrame();
    int stream_ = -1;
    double begins_s_ = 0;  // the first picture's time stamp
    int64_t follows_ = -1; // the frame that the next samples should begin with; -1: as the time stamp says
    bool draining_ = false;
};

} // namespace shoal::media
