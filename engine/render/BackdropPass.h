// Draws the surround behind everything. Pairs with shaders/render/Backdrop.
#pragma once

#include "engine/core/Crew.h"
#include "engine/gl/Variants.h"
#include "engine/render/FrameSampler.h"
#include "engine/render/SurroundGpu.h"
#include "engine/render/View.h"

#include <optional>
#include <vector>

namespace shoal::render {

class LatLongPass;

class BackdropPass {
  public:
    static Result<BackdropPass> make();

    // The surround's frame where the processor can read it, and what has been painted into the texture since;
    // null: nothing.
    struct InMemory {
        CodedFrame frame;
        const LatLongPass* painted = nullptr;
    };

    // Samples what draw() will want of this view, beside what the caller does until then; more than a hint
    // only where the context draws on the processor. size: of the picture, in pixels. The frame must live
    // until draw(), and what is painted be known, if not painted, by now.
    void begin(const SurroundGpu& surround, const View& view, const glm::mat3& envFromWorld,
               const Exposure& exposure, const glm::ivec2& size, const InMemory& inMemory);

    // Over the whole picture, before the objects: depth is neither asked nor changed, and need not be there.
    // The program for a curve that is new is compiled first. inMemory: where the context draws on the
    // processor anyway, most of a coded frame is sampled there without it; the framebuffer's colour is then a
    // texture.
    Status draw(const SurroundGpu& surround, const View& view, const glm::mat3& envFromWorld,
                const Exposure& exposure, const InMemory* inMemory = nullptr);

  private:
    struct Cell {
        glm::ivec2 low{0}, high{0};          // of the picture's pixels
        glm::vec2 first{0}, right{0}, up{0}; // of the map: at the corner, and from there to the next ones
        enum DrawnAs { Plain, Polar, Sampled } drawnAs = Plain;
    };
    struct Corner {
        glm::vec2 place, uv;
    };

    void makeCells(const View& view, const glm::mat3& envFromRay, const glm::ivec2& size);
    // Those of cells_ that can be, into picture_; marks them.
    void startSampling(const InMemory& inMemory, const glm::ivec2& size);
    void finishSampling();
    void putPicture(const glm::ivec2& size, GLuint texture) const;

    struct SampleRow { // of cells
        BackdropPass* pass;
        void operator()(int row) const;
    };

    gl::Variants programs_;
    gl::VertexArray vertexArray_;
    gl::Buffer vertices_, indices_; // indices: of as many cells as there have been, the same for all
    size_t indexedCells_ = 0;
    SampleRow sampleRow_{};
    CodedFrame sampledFrame_;
    int stride_ = 0; // of picture_
    bool begun_ = false;
    // Scratch:
    std::vector<int> columns_, rows_; // the grid's edges, in pixels
    std::vector<glm::vec2> uvs_;      // of its corners
    std::vector<Cell> cells_;         // row by row
    std::vector<Corner> corners_;
    std::vector<SampledCell> sampled_;
    std::vector<size_t> sampledRows_; // where in them each of the grid's rows begins, and their end
    std::vector<uint32_t> picture_;
    std::optional<Crew> crew_; // last, so that it ends before what it reads; empty: nothing is sampled here
};

} // namespace shoal::render
