// Properties of a video file, read without playing it.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"
#include "engine/media/SphericalMetadata.h"
#include "engine/media/StereoView.h"
#include "engine/media/YuvToBgr.h"

#include <string>

namespace shoal::media {

constexpr int kMaxVideoSide = 8192;
constexpr double kMinFps = 1, kMaxFps = 240, kFallbackFps = 30;

struct VideoInfo {
    int width = 0; // of the whole frame, both eyes
    int height = 0;
    double fps = kFallbackFps; // the container's mean rate; kFallbackFps if not within kMinFps..kMaxFps
    int64_t frameCount = 0;    // as the container says, 0 if it does not; the player counts for itself
    double duration_s = 0;     // frameCount / fps
    std::string codec;         // such as "h264"; empty if the container does not say
    ColourMatrix matrix = ColourMatrix::Bt601; // stated, or by size; frames are decoded with it
    SphericalMetadata metadata;
    Layout layout = Layout::Mono;  // never Auto
    const char* layoutSource = ""; // "asked for", "metadata", "shape", "content"
};

} // namespace shoal::media
