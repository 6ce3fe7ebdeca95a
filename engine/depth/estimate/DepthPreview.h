// A picture of a frame and its depth, side by side. Near is bright; what is not known well is blue.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"
#include "engine/light/FrameView.h"
#include "engine/media/DepthTrack.h"

namespace shoal::depth {

Status writePreview(const Path& file, const light::FrameView& film, const media::DepthFrame& depth);

} // namespace shoal::depth
