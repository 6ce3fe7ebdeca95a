// Makes the dive's film as if the game's objects had stood before its camera: their picture, at several times
// the film's resolution, goes through the film's own steps (content/make/video/Camera.cpp and make_video):
// means over its texels, lens, noise, tone and sharpening. The encoder follows (Encode.h).
#pragma once

#include "engine/render/View.h"
#include "tests/bench/Bench.h"

namespace shoal::bench {

// objects: seen by `view`, display-coded, premultiplied by coverage; at least three pixels a texel of the
// film. takes: a frame of the film each, 2048 x 1024, red first, into which they are put with
// noise of its own.
void filmInto(std::span<ImageRgb8* const> takes, const ImageRgba8& objects, const render::View& view,
              const glm::mat3& envFromWorld, uint32_t seed);

} // namespace shoal::bench
