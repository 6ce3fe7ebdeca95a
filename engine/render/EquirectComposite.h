// Puts a layer of objects, as an eye sees them, into a copy of the frame's tiles, which the background then
// shows instead of the frame. Each texel takes the layer's value in the direction of its middle, so that the
// seam and the poles are no special cases. Pairs with shaders/render/EquirectComposite.
//
// Objects are painted as the video's own camera would have filmed them: texels share colours, values take
// the video's levels, the light that port and lens scatter is mixed in, partly covered texels mix light and
// not coded values, and the frame's own grain is added last.
#pragma once

#include "engine/camera/CameraResponse.h"
#include "engine/gl/Program.h"
#include "engine/render/EnvironmentGpu.h"
#include "engine/render/FrameTiles.h"
#include "engine/render/TriangleBatch.h"
#include "engine/render/View.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace shoal::render {

// Returns how many texels of the video a pixel of the layer must span to make objects' edges as soft as the
// film's.
//
// Variances in texels^2 add up. In a layer whose pixels are k texels wide, linear interpolation adds k^2 / 6
// and, with several samples, the mean over a pixel k^2 / 12. In the video, the mean over a texel adds 1 / 12,
// and the camera's blur blur^2. With one sample a pixel, as software renderers draw, a layer is never
// finer than the video: twice the pixels made the error against filmed objects only a fifth smaller.
float layerTexels(const camera::CameraResponse& response, int samples);

// A repeating pattern of film noise: 256 x 256 texels of two bytes, one for single texels and one for squares
// of 2 x 2. With bytes as 0 to 1, 0.5 is no noise, and kGrainDeviation is the standard deviation.
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
    // bound. Display-coded frames only. shadows: a texture of FilmShadows::remaining(); 0: none. filmed: null
    // paints the layer unchanged.
    void paint(const EnvironmentGpu& environment, const FrameTiles& tiles, const std::vector<bool>& wanted,
               GLuint layer, const View& layerView, const glm::mat3& envFromWorld,
               const FilmedFrame* filmed = nullptr, GLuint shadows = 0);

    GLuint texture() const { return frame_.name(); } // undefined outside the tiles painted last

  private:
    gl::Variants programs_;
    gl::Texture grain_;
    TriangleBatch drawn_;
    gl::Texture frame_;
    gl::Framebuffer framebuffer_;
    glm::ivec2 size_{0};
    std::vector<glm::vec2> corners_; // scratch: of the tiles' triangles, uv
};

} // namespace shoal::render
