// How far off what the film shows is: no light is needed for it.
#pragma once

#include "content/make/video/World.h"

#include "engine/media/DepthTrack.h"

namespace shoal::reef {

// Moves the world to that time. rays: for each texel, a square number; its median counts, which belongs to
// one surface where a mean would lie between two. stepsPerOctave: see media::depthCode().
media::DepthFrame traceDepth(World& world, const Route& route, float turn, int width, int rays,
                             int stepsPerOctave);

} // namespace shoal::reef
