// The backdrop's picture on the processor, with objects in the video's texels: where nothing else draws, that
// is the quickest. Cells that show no objects come first, on helper threads, while those are still drawn.
#pragma once

#include "engine/core/Crew.h"
#include "engine/render/BackdropCells.h"
#include "engine/render/FrameSampler.h"
#include "engine/render/PaintedFrame.h"

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::render {

// What is seen of a frame.
struct SampledView {
    CodedFrame frame;
    uint64_t frameNumber = 0;          // those that differ have others
    const FrameTiles* tiles = nullptr; // in which of them there may be objects; null: in none
    View view;
    glm::mat3 envFromRay{1}; // rotates a ray (x, y, -1) of the image plane
    glm::ivec2 size{0};      // of the picture, in pixels
};

class BackdropSampler {
  public:
    explicit BackdropSampler(int helpers) : crew_(helpers) {} // threads beside the one that calls

    // The frame must live until finish(). What an earlier picture showed of the same is kept: a second eye's
    // differs by objects only.
    void start(const SampledView& seen);
    // Returns when all of its picture is there. paint: what objects look like; null: there are no tiles.
    void finish(const TexelPaint* paint);
    bool started() const { return started_; }

    // Of the picture: rows from the bottom.
    const uint32_t* picture() const { return picture_.data(); }
    int stride() const { return seen_.size.x; }

    struct Left {
        const BackdropCell* cell;
        bool painted; // shows what is in painted(), else the frame
    };
    // Cells that are not in the picture: polar ones, and those at the frame's edges.
    std::span<const Left> left() const { return left_; }
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
        BackdropSampler* sampler;
        CodedFrame frame;
        void operator()(int row) const;
    };
    void classify();
    template <class Due> void collect(Due&& due);

    SampledView seen_;
    bool started_ = false;
    BackdropCells cells_;
    std::vector<State> states_; // of cells
    std::vector<uint32_t> picture_;
    std::vector<size_t> due_;    // cells to be sampled
    std::vector<size_t> dueRow_; // where in them each row of cells begins, and their end
    std::vector<Left> left_;
    std::vector<bool> wanted_; // tiles
    PaintedFrame painted_;
    SampleRow sampleRow_{};
    Crew crew_; // last, so that it ends before what it reads
};

} // namespace shoal::render
