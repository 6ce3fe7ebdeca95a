// What draws.
#pragma once

namespace shoal::gl {

// Whether the current context draws on the processor (Mesa's llvmpipe and softpipe, SwiftShader, Windows'
// fallback).
bool rendersInSoftware();

} // namespace shoal::gl
