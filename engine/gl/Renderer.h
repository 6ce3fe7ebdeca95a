// What draws.
#pragma once

namespace shoal::gl {

// Whether the current context draws on the processor (Mesa's llvmpipe and softpipe, SwiftShader, Windows'
// fallback).
bool rendersInSoftware();

// Binds the software rasteriser's threads to a processor core each, where it has one for each of the cores
// that this process may use: left to itself, Linux puts two of them onto one core for milliseconds now and
// then, and a frame ends with its slowest thread. Once there is a context; does nothing elsewhere.
void spreadRasterThreads();

} // namespace shoal::gl
