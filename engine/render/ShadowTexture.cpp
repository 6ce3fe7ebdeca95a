#include "engine/render/ShadowTexture.h"

#include "engine/render/EnvironmentGpu.h"

namespace shoal::render {

GLuint ShadowTexture::update(const FilmShadows& shadows) {
    if (shown_ == shadows.version()) return texture_.name();
    shown_ = shadows.version();
    const Image<uint8_t, 4>& left = shadows.left();
    const glm::ivec2 size(left.width, left.height);
    if (size != size_) texture_ = makeLatLongTexture();
    glBindTexture(GL_TEXTURE_2D, texture_.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    if (size != size_)
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, size.x, size.y, 0, GL_BGRA, GL_UNSIGNED_BYTE,
                     left.pixels.data());
    else
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.x, size.y, GL_BGRA, GL_UNSIGNED_BYTE,
                        left.pixels.data());
    size_ = size;
    return texture_.name();
}

} // namespace shoal::render
