// The environment on the GPU: the picture behind all objects, and the light made from it.
#pragma once

#include "engine/core/Image.h"
#include "engine/depth/DepthMap.h"
#include "engine/gl/Program.h"
#include "engine/light/PackedLight.h"
#include "engine/media/VideoFrame.h"
#include "engine/occlusion/SmoothLight.h"
#include "engine/render/TriangleBatch.h"
#include "engine/render/View.h"

#include <array>
#include <cstdint>
#include <vector>

namespace shoal::render {

// Returns a bound texture without storage for a lat-long map: repeats in x, clamps in y.
gl::Texture makeLatLongTexture();
// Uploads texels to such a texture. size: current size of its storage, which is reallocated if it differs.
void uploadTexels(const gl::Texture& texture, const DisplayFrame& texels, glm::ivec2& size);

// Converts the YCbCr planes of a film's frame to an RGB picture with 10 bits a channel, as
// media::FrameConverter does on the processor with 8 bits.
class PlanesPass {
  public:
    static Result<PlanesPass> make();

    // Sets the frame, which must live until the next is set. It is uploaded when it is first drawn.
    void setFrame(const media::Planes& planes) { frame_ = &planes, uploaded_ = false; }

    // Draws a part of the frame; size: as in uploadTexels(). Restores framebuffer and viewport, nothing else.
    void draw(const DisplayFrame& part, const gl::Texture& texture, glm::ivec2& size);

  private:
    void upload();

    gl::Program program_;
    gl::Framebuffer framebuffer_;
    gl::Buffer codes_;
    std::array<gl::Texture, 4> textures_; // luma, blue and red difference, Planes::lightByCode
    WholePicture whole_;
    const media::Planes* frame_ = nullptr;
    bool uploaded_ = false;
};

// Distances from the camera to the surfaces in a film's frame; null: unknown.
struct FilmDistances {
    const depth::DepthMap* map = nullptr;
    const depth::DepthMap* widened = nullptr; // after depth::widenNear(), for an eye beside the film's camera
    const depth::DepthRange* range = nullptr;
};

class EnvironmentGpu {
  public:
    // Sets the frame. Its pixels must live until the next is set or this object ends, because only
    // frameTexture() uploads them; the software background samples them in memory and rarely calls it.
    void setFrame(const DisplayFrame& frame);
    void setFrame(const ImageRgbF& radianceLin); // HDR environments; copied
    // smooth: reduced light for the occlusion between bodies, env frame.
    void uploadLight(const light::PackedLight& light, const occlusion::SmoothLight& smooth = {});

    // Uploads the light that port and lens scatter over the frame: squares of display values, lat-long.
    void uploadScattered(const ImageRgbF& light);

    // Sets the distances, which must live until the next frame.
    void setDepth(const FilmDistances& depth);
    const FilmDistances& depth() const { return depth_; }
    // Binds the distances for shaders/render/FilmDepth.glsl. eyeInFilm: env frame, from the film's camera.
    void bindDepth(const gl::Program& program, const glm::vec3& eyeInFilm) const;

    bool frameIsCoded() const { return displayFrame_.pixels || displayFrame_.planes; }
    uint64_t frameNumber() const { return frameNumber_; } // number of frames set so far
    GLuint frameTexture() const;
    const DisplayFrame& displayFrame() const { return displayFrame_; } // no pixels: HDR, or from planes

    void bindLight(const gl::Program& program) const;       // the program must be in use
    bool lightIsScaled() const { return lightScale_ != 1; } // programs that use it need SCALED_LIGHT

    GLuint scatteredTexture() const { return scattered_.name(); }
    const ImageRgbF& scatteredLight() const { return scatteredLight_; }

    const occlusion::SmoothLight& smoothLight() const { return smooth_; } // env frame

    // Returns the roughness of the smoothest filtered map; smoother surfaces look up the mirror maps.
    float smoothestFiltered() const { return mirrorRoughness_.empty() ? 0 : mirrorRoughness_.back(); }

  private:
    gl::Texture frame_ = makeLatLongTexture(), light_ = makeLatLongTexture(), mirrors_ = makeLatLongTexture(),
                scattered_ = makeLatLongTexture(), depthMap_ = makeLatLongTexture();
    FilmDistances depth_;
    DisplayFrame displayFrame_;
    mutable bool uploaded_ = true;    // whether frame_ holds the newest frame
    mutable glm::ivec2 codedSize_{0}; // size of frame_ while it holds coded texels
    uint64_t frameNumber_ = 0;
    ImageRgbF scatteredLight_;
    int mirrorWidth_ = 0; // 0: there are no mirror maps
    std::vector<glm::vec4> places_;
    float lightScale_ = 1;
    std::vector<float> mirrorRoughness_;
    occlusion::SmoothLight smooth_;
};

} // namespace shoal::render
