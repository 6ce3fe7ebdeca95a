// Identification of the renderer that draws.
#pragma once

namespace shoal::gl {

// Returns whether the current context draws on the processor (Mesa's llvmpipe and softpipe, SwiftShader).
bool rendersInSoftware();

// Returns the antialiasing samples of a pixel: 4, or 1 where the driver renders on the processor: four would
// cost as much as two frames, and outlines are smoothed instead.
inline int defaultSamples() { return rendersInSoftware() ? 1 : 4; }

// Binds llvmpipe's threads to one processor core each, if there are as many as cores that this process may
// use. Unbound, two threads now and then share a core for milliseconds under Linux, and the slowest thread
// ends a frame. Needs a context; does nothing with other renderers.
void spreadRasterThreads();

} // namespace shoal::gl
