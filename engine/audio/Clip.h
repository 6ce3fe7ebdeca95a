// A sound in memory.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <cstdint>
#include <vector>

namespace shoal::audio {

struct Clip {
    int rate_Hz = 48000;
    int channels = 1;             // 1 or 2; only mono sounds have a place in space
    std::vector<int16_t> samples; // interleaved
};

constexpr int kMaxClip_s = 60;

// WAV, FLAC, Ogg Vorbis and what else libsndfile reads; at most kMaxClip_s long, 1 or 2 channels, 8 to 192
// kHz. What the file's head claims is checked before memory is taken.
Result<Clip> readClip(const Path& file);

} // namespace shoal::audio
