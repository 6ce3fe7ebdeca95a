// Puts a layer of objects, as an eye sees them, into a copy of the frame's tiles, which the background then
// shows instead of the frame. Each texel takes what the layer shows in the direction of its middle, so that
// seam and poles need no care. Pairs with shaders/render/EquirectComposite.
//
// Objects are painted as the video's own camera would have filmed them: where they cover a part of a texel,
// light is mixed, not coded values; port and lens scatter the light around onto them; then come levels,
// shared colours and the frame's own grain.
#pragma once

#include "engine/camera/CameraResponse.h"
#include "engine/gl/Program.h"
#include "engine/render/EnvironmentGpu.h"
#include "engine/render/FrameTiles.h"
#include "engine/render/TriangleBatch.h"
#include "engine/render/View.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace shoal::render {

// Returns how many texels of the video a pixel of the layer spans so that objects' edges are as soft as the
// film's.
//
// Variances in texels^2: between a layer's pixels of k texels values are interpolated linearly, k^2 / 6; with
// several samples each pixel is a mean over its square, k^2 / 12; the video's own texels are such means, 1 /
// 12, and its camera's blur^2 is added. With one sample a pixel, as software renderers draw, a layer is never
// finer than the video: twice the pixels made the error against filmed objects only a fifth smaller.
float layerTexels(const camera::CameraResponse& response, int samples);

// The noise of films: 256 x 256 texels that repeat, two bytes each, for single texels and for squares of 2 x
// 2; 0.5 is none, the standard deviation is kGrainDeviation.
constexpr float kGrainDeviation = 0.125f;
constexpr int kGrainSize = 256;
const std::vector<uint8_t>& grains();

// The response of a frame's camera, which is applied to what is painted into the frame.
struct FilmedFrame {
    camera::CameraResponse response;
    int64_t index = 0; // number of the frame, which selects its grain
};

// The same response as uniforms of shaders/render/EquirectComposite.
struct CameraUniforms {
    glm::vec3 black{0}, range{1};
    float glare = 0;
    glm::vec2 shares{0};
    std::array<float, camera::kBrightnesses> fineNoise{}, coarseNoise{};
    glm::ivec2 grainShift{0};
    float perGrain = 0; // 0: no grain
};
CameraUniforms cameraUniforms(const FilmedFrame& filmed);

class EquirectComposite {
  public:
    static Result<EquirectComposite> make();

    // Writes the wanted tiles (indices as FrameTiles counts them). layer: a texture of display values,
    // premultiplied, seen by layerView; only the chosen tiles have objects in it. Leaves another framebuffer
    // bound. Display-coded frames only. shadows: a texture of FilmShadows::left(); 0: none. filmed: null
    // paints the layer unchanged.
    void paint(const EnvironmentGpu& environment, const FrameTiles& tiles, const std::vector<bool>& wanted,
               GLuint layer, const View& layerView, const glm::mat3& envFromWorld,
               const FilmedFrame* filmed = nullptr, GLuint shadows = 0);

    GLuint texture() const { return frame_.name(); } // undefined outside the tiles painted last

  private:
    std::array<gl::Program, 4> programs_; // indexed by features
    gl::Texture grain_;
    TriangleBatch drawn_;
    gl::Texture frame_;
    gl::Framebuffer framebuffer_;
    glm::ivec2 size_{0};
    std::vector<glm::vec2> corners_; // scratch: of the tiles' triangles, uv
};

} // namespace shoal::render
