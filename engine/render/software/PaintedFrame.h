// A copy of a frame in memory with objects in its texels, of which only the tiles asked for are written.
#pragma once

#include "engine/core/ThreadPool.h"
#include "engine/render/DisplayFrame.h"
#include "engine/render/FrameTiles.h"
#include "engine/render/software/PaintTexels.h"

#include <memory>
#include <span>
#include <vector>

namespace shoal::render {

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

} // namespace shoal::render
