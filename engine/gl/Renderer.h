// Identification of the renderer that draws.
#pragma once

namespace shoal::gl {

// Returns whether the current context draws on the processor (Mesa's llvmpipe and softpipe, SwiftShader,
// Windows' fallback).
bool rendersInSoftware();

// Returns the antialiasing samples of a pixel: 4, or 1 where the driver renders on the processor: four would
// cost as much as two frames, and outlines are smoothed instead.
inline int defaultSamples() { return rendersInSoftware() ? 1 : 4; }

// Binds the software rasteriser's threads to one processor core each, if it has one for each core that this
// process may use: otherwise Linux now and then runs two of them on one core for milliseconds, and a frame
// ends with its slowest thread. Needs a context; does nothing with other renderers.
void spreadRasterThreads();

} // namespace shoal::gl
