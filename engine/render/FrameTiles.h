// Tiles of a lat-long frame's texels: in which of them objects may be.
#pragma once

#include "engine/math/LatLongCap.h"
#include "engine/scene/Model.h"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace shoal::render {

class FrameTiles {
  public:
    // Of the frame: 16 x 16 texels of a 2048 x 1024 one. A row of texels bends by sin(2 latitude) / 16 of the
    // square of a tile's longitude from the straight line that its rays are drawn on: a twentieth of a texel.
    static constexpr glm::ivec2 kCount{128, 64};
    static constexpr size_t kAll = size_t{128} * 64;

    // Row by row; columns repeat.
    static size_t indexOf(int x, int y) {
        return static_cast<size_t>(y * kCount.x + (x + 2 * kCount.x) % kCount.x);
    }

    // None.
    void clear(const glm::ivec2& frameSize);
    void choose(const glm::ivec2& tile) { chosen_[indexOf(tile.x, tile.y)] = true; }
    // visit(tile) of each of the cap behind which a sphere stands, seen from the frame's camera, and of a
    // margin about it.
    template <class Visit> void eachOfSphere(const glm::vec3& centreEnv, float radius, Visit&& visit) const {
        const CellRange range = cellsOf(centreEnv, radius);
        for (int y = range.first.y; y <= range.last.y; ++y)
            for (int x = range.first.x; x <= range.last.x; ++x)
                visit(glm::ivec2((x + 2 * kCount.x) % kCount.x, y));
    }

    // The tiles of the caps behind which these spheres stand, and a margin about them.
    void choose(const glm::ivec2& frameSize, const glm::mat3& envFromWorld,
                std::span<const scene::Sphere> spheres, const glm::vec3& eyeWorld);

    const glm::ivec2& frameSize() const { return frameSize_; }
    const std::vector<bool>& chosen() const { return chosen_; } // row by row; empty before choose()

    // Where a tile begins, in texels; kCount: where the last ends.
    glm::ivec2 lowOf(const glm::ivec2& tile) const { return lowOf(tile, frameSize_); }
    static glm::ivec2 lowOf(const glm::ivec2& tile, const glm::ivec2& frameSize) {
        return tile * frameSize / kCount;
    }

    // visit(tile) of each that is chosen.
    template <class Visit> void eachChosen(Visit&& visit) const {
        for (int y = 0; y < kCount.y; ++y)
            for (int x = 0; x < kCount.x; ++x)
                if (chosen_[indexOf(x, y)]) visit(glm::ivec2(x, y));
    }

    // touch(index) of each tile that has a texel between these coordinates of the map, or beside one. Columns
    // repeat: the seam is none.
    template <class Touch>
    void eachBetween(const glm::vec2& low, const glm::vec2& high, Touch&& touch) const {
        const glm::vec2 texel = 1.0f / glm::vec2(frameSize_);
        const glm::ivec2 first(glm::floor((low - texel) * glm::vec2(kCount)));
        const glm::ivec2 last(glm::floor((high + texel) * glm::vec2(kCount)));
        for (int y = std::max(first.y, 0); y <= std::min(last.y, kCount.y - 1); ++y)
            for (int x = first.x; x <= last.x; ++x) touch(indexOf(x, y));
    }

    // Whether any of those has been chosen.
    bool isChosen(const glm::vec2& low, const glm::vec2& high) const {
        if (chosen_.empty()) return false;
        bool found = false;
        eachBetween(low, high, [&](size_t tile) { found = found || chosen_[tile]; });
        return found;
    }

  private:
    CellRange cellsOf(const glm::vec3& centreEnv, float radius) const;

    glm::ivec2 frameSize_{0};
    std::vector<bool> chosen_;
};

} // namespace shoal::render
