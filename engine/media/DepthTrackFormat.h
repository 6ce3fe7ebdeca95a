// Constants of the file of a depth track, shared by its reader and its writer (content/make/depth).
#pragma once

#include "engine/media/DepthTrack.h"
#include "engine/media/Ffmpeg.h"

#include <algorithm>
#include <bit>

namespace shoal::media {

// Plane Y is the inverse distance, Cb the confidence; Cr is 512 throughout.
constexpr AVPixelFormat kDepthPixels = AV_PIX_FMT_YUV420P10LE;

// Tags of the file, and the values of those that never change.
namespace depth_tags {
constexpr const char* kVersion = "SHOAL_DEPTH";
constexpr const char* kVersionValue = "1";
constexpr const char* kFrames = "SHOAL_FRAMES";
constexpr const char* kDuration = "SHOAL_DURATION"; // of the film, seconds
constexpr const char* kLayout = "SHOAL_LAYOUT";
constexpr const char* kLayoutValue = "equirectangular mono";
constexpr const char* kFilms = "SHOAL_FILMS"; // identities of films, with blanks between them
} // namespace depth_tags

// Returns whether a track can have this size, frame count and duration. Widths are powers of two, so that a
// texel fills a whole number of texels in maps of distances.
inline bool isDepthTrack(const DepthTrackInfo& info) {
    constexpr int kMinWidth = 16, kMaxWidth = 4096;
    constexpr double kMaxFps = 240; // frames need time stamps of their own, which are whole milliseconds
    constexpr double kMaxDuration_s = 1e6;
    const bool fits = info.width >= kMinWidth && info.width <= kMaxWidth && info.height == info.width / 2;
    return fits && std::has_single_bit(static_cast<unsigned>(info.width)) && info.frameCount > 0 &&
           info.duration_s > 0 && info.duration_s <= kMaxDuration_s &&
           info.frameCount <= std::max(info.duration_s * kMaxFps, 1.0);
}

} // namespace shoal::media
