#include "engine/gl/Objects.h"

namespace shoal::gl::detail {

GLuint create(Kind kind) {
    GLuint name = 0;
    switch (kind) {
    case Kind::Buffer:
        glGenBuffers(1, &name);
        break;
    case Kind::VertexArray:
        glGenVertexArrays(1, &name);
        break;
    case Kind::Texture:
        glGenTextures(1, &name);
        break;
    case Kind::Framebuffer:
        glGenFramebuffers(1, &name);
        break;
    case Kind::Renderbuffer:
        glGenRenderbuffers(1, &name);
        break;
    case Kind::Query:
        glGenQueries(1, &name);
        break;
    case Kind::Program:
        name = glCreateProgram();
        break;
    }
    return name;
}

void destroy(Kind kind, GLuint name) {
    switch (kind) {
    case Kind::Buffer:
        glDeleteBuffers(1, &name);
        break;
    case Kind::VertexArray:
        glDeleteVertexArrays(1, &name);
        break;
    case Kind::Texture:
        glDeleteTextures(1, &name);
        break;
    case Kind::Framebuffer:
        glDeleteFramebuffers(1, &name);
        break;
    case Kind::Renderbuffer:
        glDeleteRenderbuffers(1, &name);
        break;
    case Kind::Query:
        glDeleteQueries(1, &name);
        break;
    case Kind::Program:
        glDeleteProgram(name);
        break;
    }
}

} // namespace shoal::gl::detail
