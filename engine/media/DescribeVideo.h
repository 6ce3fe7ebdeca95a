// Internal to this room.
#pragma once

#include "engine/media/VideoInfo.h"
#include "engine/media/VideoSource.h"

namespace shoal::media {

// info: the source's, with its layout. Leaves the source at its beginning. False if a frame had to be looked
// at and could not be decoded.
bool resolveLayout(VideoSource& source, Layout wish, VideoInfo& info);

} // namespace shoal::media
