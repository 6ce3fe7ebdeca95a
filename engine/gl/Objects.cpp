#include "engine/gl/Objects.h"

#include <array>

namespace shoal::gl {

// The table is made in each call, because libepoxy finds functions when they are first called.
GLuint detail::create(Kind kind) {
    if (kind == Kind::Program) return glCreateProgram();
    const std::array make = {glGenBuffers,      glGenVertexArrays,  glGenTextures,
                             glGenFramebuffers, glGenRenderbuffers, glGenQueries};
    GLuint name = 0;
    make[static_cast<size_t>(kind)](1, &name);
    return name;
}

void detail::destroy(Kind kind, GLuint name) {
    if (kind == Kind::Program) return glDeleteProgram(name);
    const std::array destroy = {glDeleteBuffers,      glDeleteVertexArrays,  glDeleteTextures,
                                glDeleteFramebuffers, glDeleteRenderbuffers, glDeleteQueries};
    destroy[static_cast<size_t>(kind)](1, &name);
}

Texture makeTexture(GLint minFilter, GLint magFilter, GLint wrapS, GLint wrapT) {
    Texture texture = Texture::make();
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minFilter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, magFilter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrapS);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrapT);
    return texture;
}

void setAttribute(GLuint location, GLint count, size_t stride, size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, count, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                          reinterpret_cast<const void*>(offset));
}

} // namespace shoal::gl
