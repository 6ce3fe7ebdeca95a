#include "engine/render/software/PaintedFrame.h"

#include "engine/render/TriangleBatch.h"

#include <algorithm>

namespace shoal::render {

void PaintedFrame::paint(const DisplayFrame& frame, const FrameTiles& tiles, const std::vector<bool>& wanted,
                         const TexelPaint& paint, ThreadPool& threadPool) {
    const glm::ivec2 size(frame.width, frame.height);
    if (size != size_) {
        size_ = size;
        texels_ = std::make_unique_for_overwrite<uint32_t[]>(static_cast<size_t>(size.x) *
                                                             static_cast<size_t>(size.y));
    }
    runs_.clear();
    eachRun(wanted, FrameTiles::kCount, [&](int first, int end, int row) {
        const glm::ivec2 low = tiles.lowOf({first, row}), high = tiles.lowOf({end, row + 1});
        if (low.x < high.x && low.y < high.y) runs_.push_back({row, first, end, low, high});
    });
    auto paintRun = [&](int index) {
        const Run& run = runs_[static_cast<size_t>(index)];
        for (int column = run.first; column < run.end; ++column) {
            const glm::ivec2 low = tiles.lowOf({column, run.row}),
                             high = tiles.lowOf({column + 1, run.row + 1});
            if (tiles.chosen()[static_cast<size_t>(run.row * FrameTiles::kCount.x + column)]) {
                paintTexels(frame, paint, low, high, texels_.get(), size.x);
                continue;
            }
            const auto* from = reinterpret_cast<const uint32_t*>(frame.pixels);
            for (int y = low.y; y < high.y; ++y)
                std::copy_n(from + ptrdiff_t{y} * frame.rowPixels + low.x, high.x - low.x,
                            texels_.get() + ptrdiff_t{y} * size.x + low.x);
        }
    };
    threadPool.parallelFor(static_cast<int>(runs_.size()), paintRun);
}

} // namespace shoal::render
