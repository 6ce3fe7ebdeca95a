// Tracing of a film's true distances, which needs no light.
#pragma once

#include "content/make/video/World.h"

#include "content/make/depth/DepthTrackWriter.h"

namespace shoal::reef {

// Moves the world to that time and traces it. rays: number for each texel, a square number; their median
// counts, which belongs to one surface where a mean would lie between two. stepsPerOctave: see
// media::depthCode().
media::DepthFrame traceDepth(World& world, const Route& route, float turn, int width, int rays,
                             int stepsPerOctave);

} // namespace shoal::reef
