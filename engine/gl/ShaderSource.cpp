#include "engine/gl/ShaderSource.h"

#include "engine/core/Files.h"

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
        // GLSL before 4.20 continues no lines.
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

} // namespace

Result<ShaderSource> readShader(const std::string& name, const std::vector<std::string>& defines, int glsl) {
    ShaderSource source;
    std::string body;
    if (Status status = appendSource(name, body, source.files, 0); !status) return status.error();
    // GLSL ES has no noperspective. It is a hint of ours: what carries it is drawn with w = 1, where both
    // agree.
    source.text = glsl == kGlslEs300 ? "#version 300 es\nprecision highp float;\nprecision highp int;\n"
                                       "precision highp sampler2D;\n#define noperspective\n"
                                     : "#version " + std::to_string(glsl) + " core\n";
    for (const std::string& define : defines) source.text += "#define " + define + " 1\n";
    source.text += "#line 1 0\n" + body;
    return source;
}

} // namespace shoal::gl
