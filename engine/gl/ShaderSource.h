// GLSL text of one shader stage: the file with its includes resolved, below the version and the defines.
// Needs no context.
#pragma once

#include "engine/core/Result.h"

#include <string>
#include <vector>

namespace shoal::gl {

struct ShaderSource {
    std::string text;
    std::vector<std::string> files; // as #line numbers them
};

constexpr int kGlslEs300 = 300; // OpenGL ES 3.0 and WebGL 2

// name: below shaders/, with ending ("render/Object.vert"). defines: names set to 1. glsl: the version, 330
// or more, or kGlslEs300.
Result<ShaderSource> readShader(const std::string& name, const std::vector<std::string>& defines, int glsl);

} // namespace shoal::gl
