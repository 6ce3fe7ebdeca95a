// Identification of the renderer that draws.
#pragma once

namespace shoal::gl {

// Returns whether the current context draws on the processor (Mesa's llvmpipe and softpipe, SwiftShader,
// Windows' fallback).
bool rendersInSoftware();

// Binds the software rasteriser's threads to one processor core each, if it has one for each core that this
// process may use: otherwise Linux now and then runs two of them on one core for milliseconds, and a frame
// ends with its slowest thread. Needs a context; does nothing with other renderers.
void spreadRasterThreads();

} // namespace shoal::gl
