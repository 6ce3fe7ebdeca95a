// Tiles of a lat-long frame's texels: in which of them objects may be.
#pragma once

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

    // The tiles of the caps behind which these spheres stand, and a margin about them.
    void choose(const glm::ivec2& frameSize, const glm::mat3& envFromWorld,
                std::span<const scene::Sphere> spheres, const glm::vec3& eyeWorld);

    const glm::ivec2& frameSize() const { return frameSize_; }
    const std::vector<bool>& chosen() const { return chosen_; } // row by row; empty before choose()

    // Where a tile begins, in texels; kCount: where the last ends.
    glm::ivec2 lowOf(const glm::ivec2& tile) const { return tile * frameSize_ / kCount; }

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
    static size_t indexOf(int x, int y) {
        return static_cast<size_t>(y * kCount.x + (x + 2 * kCount.x) % kCount.x);
    }
    void chooseCap(const glm::vec3& dirEnv, float halfAngle);

    glm::ivec2 frameSize_{0};
    std::vector<bool> chosen_;
};

} // namespace shoal::render
