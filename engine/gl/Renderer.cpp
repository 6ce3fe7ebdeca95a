#include "engine/gl/Renderer.h"

#include <epoxy/gl.h>

#include <string_view>

namespace shoal::gl {

bool rendersInSoftware() {
    const std::string_view name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    for (const std::string_view part : {"llvmpipe", "softpipe", "SwiftShader", "GDI Generic"})
        if (name.find(part) != std::string_view::npos) return true;
    return false;
}

} // namespace shoal::gl
