#include "engine/render/software/BackgroundSampler.h"

#include "engine/render/TriangleBatch.h"

#include <algorithm>

namespace shoal::render {

namespace {

bool showTheSame(const SampledView& a, const SampledView& b) {
    return a.frame.pixels == b.frame.pixels && a.frameNumber == b.frameNumber &&
           a.frame.width == b.frame.width && a.frame.height == b.frame.height &&
           a.view.halfExtent() == b.view.halfExtent() && a.view.shift == b.view.shift &&
           a.envFromRay == b.envFromRay && a.size == b.size;
}

} // namespace

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

void BackgroundSampler::SampleRow::operator()(int row) const {
    const auto r = static_cast<size_t>(row);
    for (size_t k = sampler->dueRow_[r]; k < sampler->dueRow_[r + 1]; ++k)
        sampleCell(frame, sampler->states_[sampler->due_[k]].sampled, sampler->picture_.data(),
                   sampler->stride());
}

void BackgroundSampler::classify() {
    cells_.make(seen_.view, seen_.envFromRay, seen_.size);
    const glm::vec2 texels(seen_.frame.width, seen_.frame.height);
    states_.clear();
    for (const BackgroundCell& cell : cells_.all()) {
        const glm::vec2 right = cell.right * texels / static_cast<float>(cell.high.x - cell.low.x);
        const glm::vec2 up = cell.up * texels / static_cast<float>(cell.high.y - cell.low.y);
        const SampledCell sampled{cell.low, cell.high, cell.first * texels + 0.5f * (right + up) - 0.5f,
                                  right, up};
        states_.push_back({sampled, !cell.polar && isWithin(seen_.frame, sampled)});
    }
    picture_.resize(static_cast<size_t>(seen_.size.x) * static_cast<size_t>(seen_.size.y));
}

// due(state): whether that cell is to be sampled next.
template <class Due> void BackgroundSampler::collect(Due&& due) {
    due_.clear();
    dueRow_.clear();
    for (size_t k = 0; k < states_.size(); ++k) {
        if (cells_.all()[k].low.x == 0) dueRow_.push_back(due_.size());
        if (due(states_[k])) due_.push_back(k);
    }
    dueRow_.push_back(due_.size());
}

void BackgroundSampler::start(const SampledView& seen) {
    if (started_) finish(nullptr); // of a picture that nobody wanted
    const bool same = !states_.empty() && showTheSame(seen, seen_);
    seen_ = seen;
    if (!same) classify();
    for (size_t k = 0; k < states_.size(); ++k) {
        const BackgroundCell& cell = cells_.all()[k];
        states_[k].painted = seen.tiles && seen.tiles->isChosen(cell.mapLow(), cell.mapHigh());
    }
    collect([](State& s) {
        const bool due = s.here && !s.painted && !s.clean;
        s.clean = s.here && !s.painted;
        return due;
    });
    sampleRow_ = {this, seen.frame};
    threadPool_.start(static_cast<int>(dueRow_.size()) - 1, sampleRow_);
    started_ = true;
}

void BackgroundSampler::finish(const TexelPaint* paint) {
    threadPool_.finish();
    started_ = false;
    left_.clear();
    for (size_t k = 0; k < states_.size(); ++k)
        if (!states_[k].here) left_.push_back({&cells_.all()[k], paint && states_[k].painted});
    if (!paint) return;
    wanted_.assign(static_cast<size_t>(FrameTiles::kCount.x * FrameTiles::kCount.y), false);
    bool any = false;
    for (size_t k = 0; k < states_.size(); ++k) {
        if (!states_[k].painted) continue;
        const BackgroundCell& cell = cells_.all()[k];
        seen_.tiles->eachBetween(cell.mapLow(), cell.mapHigh(), [&](size_t tile) { wanted_[tile] = true; });
        any = true;
    }
    if (!any) return;
    painted_.paint(seen_.frame, *seen_.tiles, wanted_, *paint, threadPool_);
    collect([](const State& s) { return s.here && s.painted; });
    threadPool_.parallelFor(static_cast<int>(dueRow_.size()) - 1, SampleRow{this, painted_.frame()});
}

} // namespace shoal::render
