// Samples the background's picture from a frame in memory, with objects in the frame's texels. Cells without
// objects are sampled first, on helper threads, while OpenGL still draws the objects. Called by one thread.
#pragma once

#include "engine/core/ThreadPool.h"
#include "engine/render/BackgroundCells.h"
#include "engine/render/DisplayFrame.h"
#include "engine/render/FrameTiles.h"
#include "engine/render/software/FrameSampler.h"
#include "engine/render/software/PaintTexels.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace shoal::render {

// A copy of a frame in memory with objects in its texels, of which only the tiles asked for are written.

class PaintedFrame {
  public:
    struct Run {                         // of wanted tiles,
        int row = 0, first = 0, end = 0; // of columns, as FrameTiles counts them
        glm::ivec2 low{0}, high{0};      // and in texels
    };

    // wanted: tiles as FrameTiles counts them. Those of them that are chosen are painted, others copied. By
    // one thread, with the thread pool's help. Nothing allocates once it has been as large.
    void paint(const DisplayFrame& frame, const FrameTiles& tiles, const std::vector<bool>& wanted,
               const TexelPaint& paint, ThreadPool& threadPool);

    // All of it as it lies in memory, where only tiles that were wanted mean anything. Those beyond were
    // perhaps never written.
    DisplayFrame frame() const { return {pixels(), size_.x, size_.y, size_.x}; }
    std::span<const Run> runs() const { return runs_; }

  private:
    const uint8_t* pixels() const { return reinterpret_cast<const uint8_t*>(texels_.get()); }

    glm::ivec2 size_{0};
    // Not a vector, which would touch all of its memory: objects are in few places.
    std::unique_ptr<uint32_t[]> texels_;
    std::vector<Run> runs_;
};

// A frame and the view of it.
struct SampledView {
    DisplayFrame frame;
    uint64_t frameNumber = 0;          // differs between frames whose pixels differ
    const FrameTiles* tiles = nullptr; // those chosen may hold objects; null: none does
    View view;
    glm::mat3 envFromRay{1}; // rotates a ray (x, y, -1) of the image plane
    glm::ivec2 size{0};      // of the picture, in pixels
};

class BackgroundSampler {
  public:
    explicit BackgroundSampler(int helpers) : threadPool_(helpers) {} // threads beside the one that calls

    // The frame must live until finish(). Cells without objects are kept from an earlier picture of the same
    // frame and view: a second eye's picture differs by objects only.
    void start(const SampledView& seen);
    // Returns when the picture is complete. paint: the layer of objects; null where start() had no tiles.
    void finish(const TexelPaint* paint);
    bool started() const { return started_; }

    // Of the picture: rows from the bottom.
    const uint32_t* picture() const { return picture_.data(); }
    int stride() const { return seen_.size.x; }

    // Cells that are not sampled, for OpenGL to draw: polar ones, and those at the frame's edges.
    std::span<const CellToDraw> left() const { return left_; }
    bool sampledAny() const { return left_.size() < cells_.all().size(); }
    const PaintedFrame& painted() const { return painted_; }

  private:
    struct State {
        SampledCell sampled;
        bool here = false;    // not left to others
        bool clean = false;   // in the picture, without objects
        bool painted = false; // there may be objects
    };
    struct SampleRow { // of cells
        BackgroundSampler* sampler;
        DisplayFrame frame;
        void operator()(int row) const;
    };
    void classify();
    template <class Due> void collect(Due&& due);

    SampledView seen_;
    bool started_ = false;
    BackgroundCells cells_;
    std::vector<State> states_; // of cells
    std::vector<uint32_t> picture_;
    std::vector<size_t> due_;    // cells to be sampled
    std::vector<size_t> dueRow_; // where in them each row of cells begins, and their end
    std::vector<CellToDraw> left_;
    std::vector<bool> wanted_; // tiles
    PaintedFrame painted_;
    SampleRow sampleRow_{};
    ThreadPool threadPool_; // last, so that it ends before what it reads
};

} // namespace shoal::render
