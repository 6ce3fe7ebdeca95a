// Picture of a frame beside its depth: near is bright, and blue marks texels of low confidence.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"
#include "engine/light/FrameView.h"
#include "engine/media/DepthTrack.h"

namespace shoal::depth {

Status writePreview(const Path& file, const light::FrameView& film, const media::DepthFrame& depth);

} // namespace shoal::depth
