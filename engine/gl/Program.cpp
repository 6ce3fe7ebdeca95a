#include "engine/gl/Program.h"

#include "engine/core/Files.h"

#include <array>
#include <sstream>

namespace shoal::gl {

namespace {

constexpr int kMaxIncludeDepth = 8;

// Appends the file's lines to out, includes resolved, with #line marks that number the files as in `names`.
Status appendSource(const std::string& name, std::string& out, std::vector<std::string>& names, int depth) {
    if (depth > kMaxIncludeDepth) return Error{name, "includes nest too deeply"};
    auto text = readText(dataRoot() / "shaders" / name);
    if (!text) return text.error();
    const size_t index = names.size();
    names.push_back(name);
    std::istringstream lines(*text);
    std::string line;
    int number = 0;
    const auto mark = [&](int next) {
        out += "#line " + std::to_string(next) + " " + std::to_string(index) + "\n";
    };
    if (depth > 0) mark(1);
    while (std::getline(lines, line)) {
        ++number;
        const int first = number;
        // Joins continued lines: GLSL before 4.20 has none.
        for (std::string next; line.ends_with('\\') && std::getline(lines, next); ++number) {
            line.pop_back();
            line += next;
        }
        constexpr std::string_view kInclude = "#include \"";
        if (line.starts_with(kInclude) && line.ends_with('"')) {
            const std::string included = line.substr(kInclude.size(), line.size() - kInclude.size() - 1);
            Status status = appendSource(included, out, names, depth + 1);
            if (!status) return status;
            mark(number + 1);
        } else {
            out += line + '\n';
            if (number != first) mark(number + 1);
        }
    }
    return Done{};
}

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

Result<ShaderSource> readShader(const std::string& name, const std::vector<std::string>& defines, int glsl) {
    ShaderSource source;
    std::string body;
    if (Status status = appendSource(name, body, source.files, 0); !status) return status.error();
    source.text = "#version " + std::to_string(glsl) + " core\n";
    for (const std::string& define : defines) source.text += "#define " + define + " 1\n";
    source.text += "#line 1 0\n" + body;
    return source;
}

Result<Program> Program::load(const std::string& stem, const std::vector<std::string>& defines, int glsl) {
    Program result;
    result.program_ = ProgramName::make();
    const GLuint program = result.program_.name();
    for (const auto& [stage, ending] :
         {std::pair{GL_VERTEX_SHADER, ".vert"}, std::pair{GL_FRAGMENT_SHADER, ".frag"}}) {
        const auto shader = compile(stage, stem + ending, defines, glsl);
        if (!shader) return shader.error();
        glAttachShader(program, *shader);
        glDeleteShader(*shader); // it lives as long as the program
    }
    glLinkProgram(program);
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
        result.locations_[name.data()] = glGetUniformLocation(program, name.data());
    }
    return result;
}

GLint Program::location(const char* name) const {
    const auto found = locations_.find(name);
    return found == locations_.end() ? -1 : found->second;
}

void Program::setTexture(const char* name, GLuint unit, GLuint texture) const {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, texture);
    set(name, static_cast<int>(unit));
}

void Program::bindBlock(const char* name, GLuint binding) const {
    const GLuint index = glGetUniformBlockIndex(program_.name(), name);
    if (index != GL_INVALID_INDEX) glUniformBlockBinding(program_.name(), index, binding);
}

} // namespace shoal::gl
