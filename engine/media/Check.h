// One-line descriptions of video, picture and depth files for `shoal check`.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <string>

namespace shoal::media {

// A description ("2048x1024 h264 video, ..."), or the reason why it cannot be used. Decodes up to a second at
// the beginning and the last part, so damage in the middle may go unnoticed.
// Says as well what is known of its depth, where a track lies beside it.
Result<std::string> checkVideo(const Path& file);

// The same for a depth track (DepthTrack.h), of which all frames are decoded.
Result<std::string> checkDepthTrack(const Path& file);

// The same for photos and high dynamic range pictures, which are decoded whole.
Result<std::string> checkPicture(const Path& file);

} // namespace shoal::media
