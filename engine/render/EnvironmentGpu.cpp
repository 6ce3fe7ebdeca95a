#include "engine/render/EnvironmentGpu.h"

#include "shaders/render/Attributes.glsl"

#include <cassert>

namespace shoal::render {

namespace {

constexpr size_t kMaxMaps = 17, kMaxMirrors = 6; // array sizes in shaders/light/Environment.glsl

template <class T, int kChannels>
void putTexels(const gl::Texture& texture, int level, GLint internalFormat, GLenum format, GLenum type,
               const Image<T, kChannels>& image) {
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, level, internalFormat, image.width, image.height, 0, format, type,
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

Result<PlanesPass> PlanesPass::make() {
    PlanesPass pass;
    if (Status s = gl::Program::load("render/Planes").moveTo(pass.program_); !s) return s.error();
    pass.framebuffer_ = gl::Framebuffer::make();
    pass.codes_ = gl::Buffer::make();
    for (gl::Texture& texture : pass.textures_)
        texture = gl::makeTexture(GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
    return pass;
}

void PlanesPass::upload() {
    const media::Planes& from = *frame_;
    const bool isWide = from.bytes == 2;
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, codes_.name());
    for (size_t i = 0; i < 3; ++i) {
        const glm::ivec2 size = i == 0 ? from.size : -(-from.size >> from.chromaShift); // rounded up
        // Allocates new memory, because the graphics card may still read the last frame's.
        glBufferData(GL_PIXEL_UNPACK_BUFFER, ptrdiff_t{size.y - 1} * from.rowBytes[i] + size.x * from.bytes,
                     from.codes[i], GL_STREAM_DRAW);
        glPixelStorei(GL_UNPACK_ROW_LENGTH, from.rowBytes[i] / from.bytes);
        glBindTexture(GL_TEXTURE_2D, textures_[i].name());
        glTexImage2D(GL_TEXTURE_2D, 0, isWide ? GL_R16UI : GL_R8UI, size.x, size.y, 0, GL_RED_INTEGER,
                     isWide ? GL_UNSIGNED_SHORT : GL_UNSIGNED_BYTE, nullptr);
    }
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glBindTexture(GL_TEXTURE_2D, textures_[3].name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, 128, media::kLightCodes / 128, 0, GL_RED, GL_FLOAT,
                 from.lightByCode);
    uploaded_ = true;
}

void PlanesPass::draw(const DisplayFrame& part, const gl::Texture& texture, glm::ivec2& size) {
    if (!uploaded_) upload();
    const glm::ivec2 newSize(part.width, part.height);
    glBindTexture(GL_TEXTURE_2D, texture.name());
    if (newSize != size)
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB10_A2, newSize.x, newSize.y, 0, GL_RGBA,
                     GL_UNSIGNED_INT_2_10_10_10_REV, nullptr);
    size = newSize;
    GLint framebuffer = 0;
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
    glViewport(0, 0, size.x, size.y);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    program_.use();
    const std::array names = {"luma", "blueDifference", "redDifference", "lightByCode"};
    for (GLuint i = 0; i < names.size(); ++i) program_.setTexture(names[i], i, textures_[i].name());
    program_.set("first", part.first);
    program_.set("chromaShift", frame_->chromaShift);
    program_.set("rgbFromCodes", frame_->rgbFromCodes);
    program_.set("isCoded", frame_->lightByCode ? 0 : 1);
    program_.set("isHlg", frame_->isHlg ? 1 : 0);
    program_.set("toRec709", frame_->toRec709);
    whole_.draw();
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(framebuffer));
    glViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
}

void EnvironmentGpu::setFrame(const DisplayFrame& frame) {
    if (!frame.planes != !displayFrame_.planes) codedSize_ = {0, 0}; // planes have another internal format
    displayFrame_ = frame;
    uploaded_ = false;
    ++frameNumber_;
}

// Uploads or converts the frame if this has not been done since setFrame().
GLuint EnvironmentGpu::frameTexture() const {
    if (!uploaded_ && displayFrame_.planes)
        displayFrame_.planes->draw(displayFrame_, frame_, codedSize_);
    else if (!uploaded_)
        uploadTexels(frame_, displayFrame_, codedSize_);
    uploaded_ = true;
    return frame_.name();
}

void EnvironmentGpu::setFrame(const ImageRgbF& radianceLin) {
    uploaded_ = true;
    codedSize_ = {0, 0};
    // 32-bit floats, because the radiance of a real sun exceeds the largest half float, 65504.
    putTexels(frame_, 0, GL_RGB32F, GL_RGB, GL_FLOAT, radianceLin);
    displayFrame_ = {.width = radianceLin.width, .height = radianceLin.height};
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
