// How objects are painted into a video's texels so that they look filmed by its own camera.
//
// Where they cover a part of a texel, light is mixed, not coded values; port and lens scatter the light of
// what is around onto them; then come levels, shared colours and the frame's own grain.
#pragma once

#include "engine/camera/FilmLook.h"
#include "engine/gl/Program.h"

namespace shoal::render {

// Texels of the video to a pixel of the layer, so that painting it leaves objects' edges as soft as the
// film's.
//
// Variances in texels^2: between a layer's pixels of k texels values are drawn straight, k^2 / 6, and where
// it has several samples a pixel each is a mean over its square, k^2 / 12; the video's own texels are such
// means, 1 / 12, and its camera's blur^2 comes on top. With one sample a pixel, as software renderers draw,
// never finer than the video: twice the pixels took only a fifth off the distance to what is filmed.
float layerTexels(const camera::FilmLook& look, int samples);

// The noise that films have: 256 x 256 texels that repeat; red: of single texels, green: of squares of 2 x 2;
// 0.5 is none, a standard deviation is kGrainDeviation.
gl::Texture makeGrain();
constexpr float kGrainDeviation = 0.125f;
constexpr int kGrainSize = 256;

// What of a film shows, as bits for shaders/render/LatLong.
enum FilmedFeature : unsigned { kFilmed = 1u << 0, kGrainy = 1u << 1, kSharesColour = 1u << 2 };
unsigned filmedFeatures(const camera::FilmLook& look);

// index: of the frame, whose grain is its own. The program must be in use.
void setFilmed(const gl::Program& program, const camera::FilmLook& look, int64_t index);

} // namespace shoal::render
