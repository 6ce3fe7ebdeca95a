// OpenGL objects as move-only values: empty until make(), deleted by the destructor. All calls must be on the
// thread that owns the context, which must outlive them.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <utility>

namespace shoal::gl {

enum class Kind { Buffer, VertexArray, Texture, Framebuffer, Renderbuffer, Query, Program };

namespace detail {
GLuint create(Kind kind);
void destroy(Kind kind, GLuint name);
} // namespace detail

template <Kind kKind> class Object {
  public:
    Object() = default;
    static Object make() { return Object(detail::create(kKind)); }
    explicit Object(GLuint name) : name_(name) {}
    Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~Object() {
        if (name_) detail::destroy(kKind, name_);
    }

    GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

  private:
    GLuint name_ = 0;
};

using Buffer = Object<Kind::Buffer>;
using VertexArray = Object<Kind::VertexArray>;
using Texture = Object<Kind::Texture>;
using Framebuffer = Object<Kind::Framebuffer>;
using Renderbuffer = Object<Kind::Renderbuffer>;
using Query = Object<Kind::Query>;

inline void setEnabled(GLenum capability, bool on) { on ? glEnable(capability) : glDisable(capability); }

// Returns a bound 2D texture without storage.
Texture makeTexture(GLint minFilter, GLint magFilter, GLint wrapS, GLint wrapT);

// Enables an attribute of the bound vertex array: `count` floats in each vertex of the bound buffer. stride,
// offset: in bytes.
void setAttribute(GLuint location, GLint count, size_t stride, size_t offset);

} // namespace shoal::gl
