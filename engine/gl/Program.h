// A shader pair shaders/<stem>.vert and .frag, compiled and linked.
#pragma once

#include "engine/core/Result.h"
#include "engine/gl/Objects.h"

#include <glm/glm.hpp>

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace shoal::gl {

class Program {
  public:
    // stem: below shaders/, without ending ("render/Object"). Lines `#include "light/Environment.glsl"`
    // (paths below shaders/) are replaced by the file. defines: names set to 1. Errors carry file name and
    // line of the source. glsl: the language's version; above 330 the caller has checked its support.
    static Result<Program> load(const std::string& stem, const std::vector<std::string>& defines = {},
                                int glsl = 330);

    void use() const { glUseProgram(program_.name()); }

    // Sets a uniform of the program in use; a name that the compiler has removed is ignored.
    template <class Value> void set(const char* name, const Value& value) const {
        put(location(name), 1, &value);
    }

    // Sets a uniform array of the program in use. name: that of the first element, such as "lights[0]".
    // values: a contiguous range.
    template <class Values> void setArray(const char* name, const Values& values) const {
        put(location(name), static_cast<GLsizei>(std::size(values)), std::data(values));
    }

    // Binds a 2D texture to a unit, for the sampler of that name.
    void setTexture(const char* name, GLuint unit, GLuint texture) const;

    // Binds a uniform block of this program to a binding point; ignored if the program has none of that name.
    void bindBlock(const char* name, GLuint binding) const;

  private:
    GLint location(const char* name) const;
    static void put(GLint at, GLsizei n, const int* v) { glUniform1iv(at, n, v); }
    static void put(GLint at, GLsizei n, const float* v) { glUniform1fv(at, n, v); }
    static void put(GLint at, GLsizei n, const glm::ivec2* v) { glUniform2iv(at, n, &v->x); }
    static void put(GLint at, GLsizei n, const glm::vec2* v) { glUniform2fv(at, n, &v->x); }
    static void put(GLint at, GLsizei n, const glm::vec3* v) { glUniform3fv(at, n, &v->x); }
    static void put(GLint at, GLsizei n, const glm::vec4* v) { glUniform4fv(at, n, &v->x); }
    static void put(GLint at, GLsizei n, const glm::mat3* m) { glUniformMatrix3fv(at, n, false, &m[0][0].x); }
    static void put(GLint at, GLsizei n, const glm::mat4x3* m) {
        glUniformMatrix4x3fv(at, n, false, &m[0][0].x);
    }
    static void put(GLint at, GLsizei n, const glm::mat4* m) { glUniformMatrix4fv(at, n, false, &m[0][0].x); }

    ProgramName program_;
    std::map<std::string, GLint, std::less<>> locations_; // of every active uniform
};

// GLSL text of one shader stage: the file with its includes resolved, below the version and the defines.
// Needs no context.
struct ShaderSource {
    std::string text;
    std::vector<std::string> files; // in the order of #line's numbers
};

// name: below shaders/, with ending ("render/Object.vert"). defines: names set to 1. glsl: at least 330.
Result<ShaderSource> readShader(const std::string& name, const std::vector<std::string>& defines, int glsl);

// One shader pair compiled with different sets of features. Software renderers run both sides of every
// branch, and graphics cards reserve registers for both, so the preprocessor makes the choices that are known
// before a draw.
class Variants {
  public:
    Variants() = default;
    // names: the features' names in the order of their bits; must outlive this. Compiles nothing yet.
    Variants(std::string stem, std::span<const char* const> names) : stem_(std::move(stem)), names_(names) {}

    // Returns a program, compiled on the first call; the pointer stays valid. glsl: as in Program::load().
    Result<const Program*> get(unsigned features, int glsl = 330) {
        if (const auto found = programs_.find(features); found != programs_.end()) return &found->second;
        std::vector<std::string> defines;
        for (size_t bit = 0; bit < names_.size(); ++bit)
            if (features & (1u << bit)) defines.emplace_back(names_[bit]);
        auto program = Program::load(stem_, defines, glsl);
        if (!program) return program.error();
        return &programs_.emplace(features, std::move(*program)).first->second;
    }

    bool has(unsigned features) const { return programs_.contains(features); }
    size_t count() const { return programs_.size(); } // compiled so far

  private:
    std::string stem_;
    std::span<const char* const> names_;
    std::map<unsigned, Program> programs_;
};

} // namespace shoal::gl
