#include "engine/render/SurroundGpu.h"

#include "shaders/render/Attributes.glsl"

#include <algorithm>
#include <array>
#include <cassert>

namespace shoal::render {

namespace {

constexpr int kMaxGlossyLevels = 8; // the array in shaders/light/Environment.glsl

void latLongSampling(const gl::Texture& texture, bool mipmapped) {
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, mipmapped ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
}

// Replaces level `level` of the bound texture; `fresh` makes new storage.
void putLevel(int level, const ImageRgbF& image, bool fresh) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    if (fresh)
        glTexImage2D(GL_TEXTURE_2D, level, GL_RGB16F, image.width, image.height, 0, GL_RGB, GL_FLOAT,
                     image.pixels.data());
    else
        glTexSubImage2D(GL_TEXTURE_2D, level, 0, 0, image.width, image.height, GL_RGB, GL_FLOAT,
                        image.pixels.data());
}

void bindTo(int unit, const gl::Texture& texture, const gl::Program& program, const char* name) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, texture.name());
    program.set(name, unit);
}

} // namespace

SurroundGpu::SurroundGpu()
    : frame_(gl::Texture::make()), diffuse_(gl::Texture::make()), glossy_(gl::Texture::make()),
      pyramid_(gl::Texture::make()) {
    latLongSampling(frame_, false);
    latLongSampling(diffuse_, false);
    latLongSampling(glossy_, true);
    latLongSampling(pyramid_, true);
}

void SurroundGpu::uploadFrame(const CodedFrame& frame) {
    glBindTexture(GL_TEXTURE_2D, frame_.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, frame.rowPixels);
    const GLenum order = frame.bgr ? GL_BGR : GL_RGB;
    if (!coded_ || frame.width != frameWidth_ || frame.height != frameHeight_)
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, frame.width, frame.height, 0, order, GL_UNSIGNED_BYTE,
                     frame.pixels);
    else
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, frame.width, frame.height, order, GL_UNSIGNED_BYTE,
                        frame.pixels);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    coded_ = true;
    frameWidth_ = frame.width;
    frameHeight_ = frame.height;
}

void SurroundGpu::uploadFrame(const ImageRgbF& radianceLin) {
    glBindTexture(GL_TEXTURE_2D, frame_.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    // 32 bits: a real sun lies above the largest half float.
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, radianceLin.width, radianceLin.height, 0, GL_RGB, GL_FLOAT,
                 radianceLin.pixels.data());
    coded_ = false;
    frameWidth_ = radianceLin.width;
    frameHeight_ = radianceLin.height;
}

void SurroundGpu::uploadLight(const light::EnvironmentLight& light) {
    glBindTexture(GL_TEXTURE_2D, diffuse_.name());
    putLevel(0, light.diffuse, light.diffuse.width != diffuseWidth_);
    diffuseWidth_ = light.diffuse.width;

    const int levels = std::min<int>(static_cast<int>(light.glossy.size()), kMaxGlossyLevels);
    assert(levels > 0);
    const auto imageOf = [&](int k) -> const ImageRgbF& {
        const ImageRgbF& own = light.glossy[static_cast<size_t>(k)].radianceLin;
        return own.empty() ? light.radiance.levels[static_cast<size_t>(k)] : own;
    };
    glBindTexture(GL_TEXTURE_2D, glossy_.name());
    const bool fresh = imageOf(0).width != glossyWidth_ || levels != static_cast<int>(roughness_.size());
    roughness_.resize(static_cast<size_t>(levels));
    for (int k = 0; k < levels; ++k) {
        putLevel(k, imageOf(k), fresh);
        roughness_[static_cast<size_t>(k)] = light.glossy[static_cast<size_t>(k)].roughness;
    }
    if (fresh) glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, levels - 1);
    glossyWidth_ = imageOf(0).width;
}

void SurroundGpu::uploadPyramid(const light::RadiancePyramid& pyramid) {
    glBindTexture(GL_TEXTURE_2D, pyramid_.name());
    const bool fresh = pyramid.levels[0].width != pyramidWidth_;
    for (size_t k = 0; k < pyramid.levels.size(); ++k)
        putLevel(static_cast<int>(k), pyramid.levels[k], fresh);
    if (fresh)
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(pyramid.levels.size()) - 1);
    pyramidWidth_ = pyramid.levels[0].width;
}

void SurroundGpu::bindFrame(const gl::Program& program) const {
    bindTo(UNIT_FRAME, frame_, program, "frame");
    program.set("frameIsCoded", coded_ ? 1 : 0);
}

void SurroundGpu::bindLight(const gl::Program& program) const {
    bindTo(UNIT_DIFFUSE, diffuse_, program, "diffuseMap");
    bindTo(UNIT_GLOSSY, glossy_, program, "glossyMap");
    program.set("glossyLevels", static_cast<int>(roughness_.size()));
    program.setArray("glossyRoughness[0]", roughness_);
    if (pyramidWidth_) {
        bindTo(UNIT_RADIANCE, pyramid_, program, "radianceMap");
        program.set("radianceWidth", static_cast<float>(pyramidWidth_));
    }
}

} // namespace shoal::render
