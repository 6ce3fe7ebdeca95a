// Reads as many frames as asked for, however long the decoder takes.
#pragma once

#include "engine/media/SoundTrack.h"

#include <thread>

namespace shoal::media::test {

inline size_t readAll(SoundTrack& track, std::span<int16_t> stereo) {
    for (size_t samples = 0; samples < stereo.size(); std::this_thread::yield())
        samples += 2 * track.read(stereo.subspan(samples));
    return stereo.size() / 2;
}

} // namespace shoal::media::test
