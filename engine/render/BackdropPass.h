// Draws the surround behind everything. Pairs with shaders/render/Backdrop.
#pragma once

#include "engine/gl/Variants.h"
#include "engine/render/BackdropSampler.h"
#include "engine/render/SurroundGpu.h"
#include "engine/render/View.h"

#include <array>
#include <optional>
#include <vector>

namespace shoal::render {

class BackdropPass {
  public:
    static Result<BackdropPass> make();

    // The surround's frame where the processor can read it, and the tiles into whose texels objects will be
    // painted; null: nowhere.
    struct InMemory {
        CodedFrame frame;
        const FrameTiles* tiles = nullptr;
    };

    // Whether drawFromMemory() can do it: the context draws on the processor anyway, the frame is shown as it
    // is coded, and the bound framebuffer's colours are a texture's.
    bool canDrawFromMemory(const SurroundGpu& surround, const Exposure& exposure) const;

    // Samples what drawFromMemory() will want of this view, beside what the caller does until then; a hint.
    // size: of the picture, in pixels. The frame and tiles must live until that.
    void begin(const SurroundGpu& surround, const View& view, const glm::mat3& envFromWorld,
               const Exposure& exposure, const glm::ivec2& size, const InMemory& inMemory);

    // Over the whole picture, before the objects: depth is neither asked nor changed, and need not be there.
    // The program for a curve that is new is compiled first.
    Status draw(const SurroundGpu& surround, const View& view, const glm::mat3& envFromWorld,
                const Exposure& exposure);
    // The same of the frame in memory, with what is painted into its tiles; null where there are none.
    Status drawFromMemory(const SurroundGpu& surround, const View& view, const glm::mat3& envFromWorld,
                          const InMemory& inMemory, const TexelPaint* paint);

  private:
    struct Corner {
        glm::vec2 place, uv;
    };
    enum Kind { kPlain, kPolar, kPaintedPlain, kPaintedPolar, kKinds };

    void clearCorners();
    void addCorners(const BackdropCell& cell, bool painted, const glm::ivec2& size);
    Status drawCorners(const SurroundGpu& surround, const View& view, const glm::mat3& envFromRay,
                       const Exposure& exposure);
    void putPicture(GLuint texture, const glm::ivec2& size) const;
    void putPainted(const CodedFrame& frame);

    gl::Variants programs_;
    gl::VertexArray vertexArray_;
    gl::Buffer vertices_, indices_; // indices: of as many cells as there have been, the same for all
    size_t indexedCells_ = 0;
    BackdropCells cells_; // scratch
    std::array<std::vector<Corner>, kKinds> corners_;
    std::optional<BackdropSampler> sampler_; // none: nothing is sampled here
    gl::Texture painted_;                    // of cells that the sampler leaves; once there is one
    glm::ivec2 paintedSize_{0};
};

} // namespace shoal::render
