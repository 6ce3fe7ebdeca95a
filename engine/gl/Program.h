// A shader pair shaders/<stem>.vert and .frag, compiled and linked.
#pragma once

#include "engine/core/Result.h"
#include "engine/gl/Objects.h"

#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shoal::gl {

class Program {
  public:
    Program() = default;

    // stem: below shaders/, without ending ("render/Object"). Lines `#include "light/Environment.glsl"`
    // (paths below shaders/) are replaced by the file. defines: names set to 1. Errors carry file name and
    // line of the source. glsl: the language's version; above 330 the caller has made sure that it is there.
    static Result<Program> load(const std::string& stem, const std::vector<std::string>& defines = {},
                                int glsl = 330);

    void use() const { glUseProgram(program_.name()); }

    // The program must be in use. A name that the compiler has removed is ignored.
    void set(const char* name, int value) const { glUniform1i(location(name), value); }
    void set(const char* name, float value) const { glUniform1f(location(name), value); }
    void set(const char* name, const glm::ivec2& v) const { glUniform2iv(location(name), 1, &v.x); }
    void set(const char* name, const glm::vec2& v) const { glUniform2fv(location(name), 1, &v.x); }
    void set(const char* name, const glm::vec3& v) const { glUniform3fv(location(name), 1, &v.x); }
    void set(const char* name, const glm::vec4& v) const { glUniform4fv(location(name), 1, &v.x); }
    void set(const char* name, const glm::mat3& m) const {
        glUniformMatrix3fv(location(name), 1, GL_FALSE, &m[0][0]);
    }
    void set(const char* name, const glm::mat4x3& m) const {
        glUniformMatrix4x3fv(location(name), 1, GL_FALSE, &m[0][0]);
    }
    void set(const char* name, const glm::mat4& m) const {
        glUniformMatrix4fv(location(name), 1, GL_FALSE, &m[0][0]);
    }

    // name: with "[0]".
    void setArray(const char* name, std::span<const float> values) const {
        glUniform1fv(location(name), static_cast<GLsizei>(values.size()), values.data());
    }
    void setArray(const char* name, std::span<const glm::vec2> values) const {
        glUniform2fv(location(name), static_cast<GLsizei>(values.size()), &values.data()->x);
    }
    void setArray(const char* name, std::span<const glm::vec3> values) const {
        glUniform3fv(location(name), static_cast<GLsizei>(values.size()), &values.data()->x);
    }
    void setArray(const char* name, std::span<const glm::vec4> values) const {
        glUniform4fv(location(name), static_cast<GLsizei>(values.size()), &values.data()->x);
    }

    // Binds a uniform block of this program to a binding point; ignored if the program has none of that name.
    void bindBlock(const char* name, GLuint binding) const;

  private:
    GLint location(const char* name) const;

    struct Slot {
        std::string name;
        GLint location;
    };
    Object<Kind::Program> program_;
    std::vector<Slot> slots_; // every active uniform
};

} // namespace shoal::gl
