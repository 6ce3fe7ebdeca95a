// How objects are painted into a video's texels so that they look filmed by its own camera.
//
// Where they cover a part of a texel, light is mixed, not coded values; port and lens scatter the light of
// what is around onto them; then come levels, shared colours and the frame's own grain.
#pragma once

#include "engine/camera/CameraResponse.h"
#include "engine/gl/Program.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace shoal::render {

// Texels of the video to a pixel of the layer, so that painting it leaves objects' edges as soft as the
// film's.
//
// Variances in texels^2: between a layer's pixels of k texels values are drawn straight, k^2 / 6, and where
// it has several samples a pixel each is a mean over its square, k^2 / 12; the video's own texels are such
// means, 1 / 12, and its camera's blur^2 comes on top. With one sample a pixel, as software renderers draw,
// never finer than the video: twice the pixels took only a fifth off the distance to what is filmed.
float layerTexels(const camera::CameraResponse& response, int samples);

// The noise that films have: 256 x 256 texels that repeat, two bytes each, of single texels and of squares of
// 2 x 2; 0.5 is none, a standard deviation is kGrainDeviation.
constexpr float kGrainDeviation = 0.125f;
constexpr int kGrainSize = 256;
std::vector<uint8_t> makeGrain();
gl::Texture makeGrainTexture();

// How the frame's camera would have seen what is painted into it.
struct FilmedFrame {
    camera::CameraResponse response;
    int64_t index = 0; // of the frame, whose grain is its own
};

// The same as shaders/render/EquirectComposite calls it.
struct CameraUniforms {
    glm::vec3 black{0}, range{1};
    float glare = 0;
    glm::vec2 shares{0};
    std::array<float, camera::kBrightnesses> fineNoise{}, coarseNoise{};
    glm::ivec2 grainShift{0};
    float perGrain = 0;
};
CameraUniforms cameraUniforms(const FilmedFrame& filmed);

// What of a film shows, as bits for shaders/render/EquirectComposite.
enum CameraFeature : unsigned { kFilmed = 1u << 0, kGrainy = 1u << 1, kSharesColour = 1u << 2 };
unsigned cameraFeatures(const camera::CameraResponse& response);

// The program must be in use.
void setCameraUniforms(const gl::Program& program, const FilmedFrame& filmed);

} // namespace shoal::render
