#include "engine/gl/Program.h"

#include "engine/gl/ShaderSource.h"

#include <array>

namespace shoal::gl {

namespace {

Result<GLuint> compile(GLenum stage, const std::string& name, const std::vector<std::string>& defines,
                       int glsl) {
    auto source = readShader(name, defines, glsl);
    if (!source) return source.error();
    const GLuint shader = glCreateShader(stage);
    const char* text = source->text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        std::array<char, 2048> log{};
        glGetShaderInfoLog(shader, log.size(), nullptr, log.data());
        glDeleteShader(shader);
        std::string files;
        for (size_t i = 0; i < source->files.size(); ++i)
            files += (i ? ", " : "") + std::to_string(i) + " = " + source->files[i];
        return Error{"shaders/" + name, "does not compile (files: " + files + "): " + log.data()};
    }
    return shader;
}

} // namespace

Result<Program> Program::load(const std::string& stem, const std::vector<std::string>& defines, int glsl) {
    auto vertex = compile(GL_VERTEX_SHADER, stem + ".vert", defines, glsl);
    if (!vertex) return vertex.error();
    auto fragment = compile(GL_FRAGMENT_SHADER, stem + ".frag", defines, glsl);
    if (!fragment) {
        glDeleteShader(*vertex);
        return fragment.error();
    }
    Program result;
    result.program_ = Object<Kind::Program>::make();
    const GLuint program = result.program_.name();
    glAttachShader(program, *vertex);
    glAttachShader(program, *fragment);
    glLinkProgram(program);
    glDeleteShader(*vertex);
    glDeleteShader(*fragment);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) {
        std::array<char, 2048> log{};
        glGetProgramInfoLog(program, log.size(), nullptr, log.data());
        return Error{"shaders/" + stem, std::string("does not link: ") + log.data()};
    }
    GLint count = 0;
    glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; ++i) {
        std::array<char, 128> name{};
        GLint size = 0;
        GLenum type = 0;
        glGetActiveUniform(program, static_cast<GLuint>(i), name.size(), nullptr, &size, &type, name.data());
        result.slots_.push_back({name.data(), glGetUniformLocation(program, name.data())});
    }
    return result;
}

GLint Program::location(const char* name) const {
    for (const Slot& slot : slots_)
        if (slot.name == name) return slot.location;
    return -1;
}

void Program::bindBlock(const char* name, GLuint binding) const {
    const GLuint index = glGetUniformBlockIndex(program_.name(), name);
    if (index != GL_INVALID_INDEX) glUniformBlockBinding(program_.name(), index, binding);
}

} // namespace shoal::gl
