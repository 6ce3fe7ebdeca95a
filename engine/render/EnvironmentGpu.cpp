#include "engine/render/EnvironmentGpu.h"

#include "shaders/render/Attributes.glsl"

#include <cassert>

namespace shoal::render {

namespace {

constexpr size_t kMaxMaps = 17, kMaxMirrors = 6; // the arrays in shaders/light/Environment.glsl

template <class T, int kChannels>
void putTexels(const gl::Texture& texture, int level, GLint stored, GLenum format, GLenum type,
               const Image<T, kChannels>& image) {
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, level, stored, image.width, image.height, 0, format, type,
                 image.pixels.data());
}

} // namespace

gl::Texture makeLatLongTexture() {
    return gl::makeTexture(GL_LINEAR, GL_LINEAR, GL_REPEAT, GL_CLAMP_TO_EDGE);
}

void uploadTexels(const gl::Texture& texture, const DisplayFrame& texels, glm::ivec2& size) {
    const glm::ivec2 newSize(texels.width, texels.height);
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, texels.rowPixels);
    if (newSize != size)
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, newSize.x, newSize.y, 0, GL_BGRA, GL_UNSIGNED_BYTE,
                     texels.pixels);
    else
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.x, size.y, GL_BGRA, GL_UNSIGNED_BYTE, texels.pixels);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    size = newSize;
}

void EnvironmentGpu::setFrame(const DisplayFrame& frame) {
    displayFrame_ = frame;
    uploaded_ = false;
    coded_ = true;
    ++frameNumber_;
}

// Uploads a new frame first.
GLuint EnvironmentGpu::frameTexture() const {
    if (!uploaded_) uploadTexels(frame_, displayFrame_, codedSize_);
    uploaded_ = true;
    return frame_.name();
}

void EnvironmentGpu::setFrame(const ImageRgbF& radianceLin) {
    uploaded_ = true;
    codedSize_ = {0, 0};
    // 32 bits: a real sun lies above the largest half float.
    putTexels(frame_, 0, GL_RGB32F, GL_RGB, GL_FLOAT, radianceLin);
    displayFrame_ = {nullptr, radianceLin.width, radianceLin.height, radianceLin.width};
    coded_ = false;
    ++frameNumber_;
}

void EnvironmentGpu::uploadLight(const light::PackedLight& light, const occlusion::SmoothLight& smooth) {
    assert(light.places.size() <= kMaxMaps && light.mirrorRoughness.size() <= kMaxMirrors);
    putTexels(light_, 0, GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, light.atlas);
    places_ = light.places;
    lightScale_ = light.scale;
    mirrorRoughness_ = light.mirrorRoughness;
    smooth_ = smooth;

    if (light.mirrors.empty()) return;
    for (size_t k = 0; k < light.mirrors.size(); ++k)
        putTexels(mirrors_, static_cast<int>(k), GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, light.mirrors[k]);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(light.mirrors.size()) - 1);
    mirrorWidth_ = light.mirrors[0].width;
}

void EnvironmentGpu::uploadScattered(const ImageRgbF& light) {
    putTexels(scattered_, 0, GL_RGB16F, GL_RGB, GL_FLOAT, light);
    scatteredLight_ = light;
}

void EnvironmentGpu::setDepth(const FilmDistances& depth) {
    depth_ = depth;
    if (depth.map) putTexels(depthMap_, 0, GL_R8, GL_RED, GL_UNSIGNED_BYTE, depth.map->inverse);
}

void EnvironmentGpu::bindDepth(const gl::Program& program, const glm::vec3& eyeInFilm) const {
    program.setTexture("filmDepth", UNIT_FILM_DEPTH, depthMap_.name());
    program.set("eyeInFilm", eyeInFilm);
}

void EnvironmentGpu::bindLight(const gl::Program& program) const {
    program.setTexture("lightMap", UNIT_LIGHT, light_.name());
    program.setArray("lightPlaces[0]", places_);
    program.set("lightScale", lightScale_);
    program.set("smoothestMap", static_cast<float>(places_.size() - 1));
    if (mirrorWidth_ == 0) return;
    program.setTexture("radianceMap", UNIT_RADIANCE, mirrors_.name());
    program.set("radianceWidth", static_cast<float>(mirrorWidth_));
    program.set("mirrorLevels", static_cast<int>(mirrorRoughness_.size() - 1));
    program.setArray("mirrorRoughness[0]", mirrorRoughness_);
}

} // namespace shoal::render
