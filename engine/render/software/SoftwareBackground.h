// Samples the background, and paints objects into the frame's texels, on the processor: what llvmpipe takes 6
// ns a pixel for takes 1 ns here. OpenGL draws the cells that this leaves (at the poles and the frame's
// edges), and whole pictures that it cannot sample: HDR frames, other exposures or tone curves, multisampled
// canvases, hidden areas.
#pragma once

#include "engine/render/BackgroundPass.h"
#include "engine/render/software/BackgroundSampler.h"

#include <cstdint>
#include <vector>

namespace shoal::render {

class SoftwareBackground final : public BackgroundPass {
  public:
    static Result<std::unique_ptr<BackgroundPass>> make(bool withLayers);

    void prepare(const EyePicture& picture, const FrameTiles* tiles) override;
    Status draw(const EyePicture& picture, const TexelLayer* layer) override;

  private:
    SoftwareBackground();
    void finish(const EyePicture& picture, const TexelLayer& layer);
    void uploadPainted();

    BackgroundSampler sampler_;
    std::vector<uint32_t> layer_; // scratch: the layer's pixels
    std::vector<uint8_t> grain_;  // once something is filmed
    gl::Texture painted_;         // of cells that the sampler leaves; once there is one
    glm::ivec2 paintedSize_{0};
};

} // namespace shoal::render
