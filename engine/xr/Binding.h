// The session on the OpenGL context that is current. Apart from the rest, because X11's headers define words
// such as Status and None. Only for the sources of this folder.
#pragma once

#include "engine/xr/Instance.h"

namespace shoal::xr {

using SessionHandle = Handle<XrSession, xrDestroySession>;

Result<SessionHandle> createSession(const Instance& instance);

} // namespace shoal::xr
