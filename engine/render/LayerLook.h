// How a layer of objects is drawn and laid over the backdrop so that it looks filmed by the video's own
// camera.
#pragma once

#include "engine/camera/FilmLook.h"
#include "engine/gl/Program.h"

namespace shoal::render {

// Blur is made where it saves work: the layer is drawn so much coarser than the video that scaling it up,
// with the four taps that round it, leaves just what the film's edges have.
//
// Variances in texels^2: a pixel of k texels is a mean over its square, k^2 / 12, and is scaled up by a tent,
// k^2 / 6; the video's own texels have 1/12 and 1/6, and its camera's blur^2 besides. Four taps, at
// (+-d, +-d) pixels of the layer, add d^2 k^2; at d = 1/2 the least detail that the layer can hold is gone,
// and nothing coarser is turned round.
struct LayerLook {
    float texels = 1; // k
    float tap = 0;    // d
};

LayerLook layerLook(const camera::FilmLook& look);

// The noise that films have: 256 x 256 texels that repeat; red: of single texels, green: of squares of 2 x 2;
// 0.5 is none, a standard deviation is kGrainDeviation.
gl::Texture makeGrain();
constexpr float kGrainDeviation = 0.125f;
constexpr int kGrainSize = 256;

// What layers can show of a film, as bits for shaders/render/Layer.
enum LayerFeature : unsigned { kLayerFilmed = 1u << 0, kLayerGrainy = 1u << 1, kLayerSharesColour = 1u << 2 };
unsigned layerFeatures(const camera::FilmLook& look);

// texels: of the video, across and down the picture; layer: pixels of the layer; frame: of the video, whose
// grain is its own. The program must be in use.
void setLayerLook(const gl::Program& program, const camera::FilmLook& look, const glm::vec2& texels,
                  const glm::vec2& layer, int64_t frame);

} // namespace shoal::render
