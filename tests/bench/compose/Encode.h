// Encodes frames to a video file as the dive's own film was, by the program ffmpeg.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/core/Result.h"

#include <span>

namespace shoal::bench {

// Frames: all of one size, red first. Uses the dive's encoder at its rate (3.9 Mbit/s at 24 frames a second).
Status encode(const Path& file, std::span<const ImageRgb8> frames, int fps);

} // namespace shoal::bench
