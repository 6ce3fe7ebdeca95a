// OpenGL objects as move-only values: empty until make(), deleted by the destructor. All calls must be on the
// thread that owns the context, which must outlive them.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <utility>

namespace shoal::gl {

// kMake, kDelete: OpenGL's functions for names of one kind.
template <auto& kMake, auto& kDelete> class Object {
  public:
    Object() = default;
    static Object make() {
        GLuint name = 0;
        kMake(1, &name);
        return Object(name);
    }
    explicit Object(GLuint name) : name_(name) {}
    Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~Object() {
        if (name_) kDelete(1, &name_);
    }

    GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

  private:
    GLuint name_ = 0;
};

using Buffer = Object<glGenBuffers, glDeleteBuffers>;
using VertexArray = Object<glGenVertexArrays, glDeleteVertexArrays>;
using Texture = Object<glGenTextures, glDeleteTextures>;
using Framebuffer = Object<glGenFramebuffers, glDeleteFramebuffers>;
using Renderbuffer = Object<glGenRenderbuffers, glDeleteRenderbuffers>;
using Query = Object<glGenQueries, glDeleteQueries>;

inline void makeProgram(GLsizei, GLuint* name) { *name = glCreateProgram(); }
inline void deleteProgram(GLsizei, const GLuint* name) { glDeleteProgram(*name); }
using ProgramName = Object<makeProgram, deleteProgram>;

inline void setEnabled(GLenum capability, bool on) { on ? glEnable(capability) : glDisable(capability); }

// Returns a bound 2D texture without storage.
Texture makeTexture(GLint minFilter, GLint magFilter, GLint wrapS, GLint wrapT);

// Enables an attribute of the bound vertex array: `count` floats in each vertex of the bound buffer. stride,
// offset: in bytes.
void setAttribute(GLuint location, GLint count, size_t stride, size_t offset);

} // namespace shoal::gl
