// Tiles of a lat-long frame: tells which of them may show objects.
#pragma once

#include "engine/math/LatLong.h"
#include "engine/scene/Model.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace shoal::render {

class FrameTiles {
  public:
    // Tiles of a frame; at 2048 x 1024, 16 x 16 texels each. Within a tile a row's rays depart from a line
    // by sin(2 latitude) / 16 times the square of the tile's width in radians: a twentieth of a texel.
    static constexpr glm::ivec2 kCount{128, 64};
    static constexpr size_t kAll = size_t{128} * 64;

    // Returns the index of a tile, row by row; columns repeat.
    static size_t indexOf(int x, int y) {
        return static_cast<size_t>(y * kCount.x + (x + 2 * kCount.x) % kCount.x);
    }

    void clear(const glm::ivec2& frameSize) {
        frameSize_ = frameSize;
        chosen_.assign(kAll, false);
    }
    void choose(const glm::ivec2& tile) { chosen_[indexOf(tile.x, tile.y)] = true; }
    // Calls visit(tile) for each tile in which the frame's camera may see a sphere or a margin around it.
    template <class Visit> void eachOfSphere(const glm::vec3& centreEnv, float radius, Visit&& visit) const {
        constexpr float kPi = std::numbers::pi_v<float>;
        const float distance = glm::length(centreEnv);
        // A sphere around the camera covers every tile.
        const float halfAngle = distance > radius ? std::asin(radius / distance) : kPi;
        constexpr float kMargin = 2; // texels by which a layer's filter spreads an object
        const float margin = kMargin * kPi / static_cast<float>(frameSize_.y);
        const CellRange range =
            cellsOfCap(kCount, distance > 0 ? centreEnv / distance : glm::vec3(0, 0, -1), halfAngle + margin);
        for (int y = range.first.y; y <= range.last.y; ++y)
            for (int x = range.first.x; x <= range.last.x; ++x)
                visit(glm::ivec2((x + 2 * kCount.x) % kCount.x, y));
    }

    // Chooses the tiles in which these spheres, or a margin around them, may appear to the eye.
    void choose(const glm::ivec2& frameSize, const glm::mat3& envFromWorld,
                std::span<const scene::Sphere> spheres, const glm::vec3& eyeWorld) {
        clear(frameSize);
        for (const scene::Sphere& sphere : spheres)
            eachOfSphere(envFromWorld * (sphere.centre - eyeWorld), sphere.radius,
                         [&](const glm::ivec2& tile) { choose(tile); });
    }

    const glm::ivec2& frameSize() const { return frameSize_; }
    const std::vector<bool>& chosen() const { return chosen_; } // row by row; empty before choose()

    // Returns a tile's first texel; for kCount, the end of the last tile.
    glm::ivec2 lowOf(const glm::ivec2& tile) const { return lowOf(tile, frameSize_); }
    static glm::ivec2 lowOf(const glm::ivec2& tile, const glm::ivec2& frameSize) {
        return tile * frameSize / kCount;
    }

    // Calls visit(tile) for each marked tile. marked: row by row.
    template <class Visit> static void eachOf(const std::vector<bool>& marked, Visit&& visit) {
        for (int y = 0; y < kCount.y; ++y)
            for (int x = 0; x < kCount.x; ++x)
                if (marked[indexOf(x, y)]) visit(glm::ivec2(x, y));
    }

    // Returns the tiles that reach into a rectangle between coordinates of the map, widened by a texel.
    static CellRange between(const glm::vec2& low, const glm::vec2& high, const glm::ivec2& frameSize) {
        constexpr int kAhead = 2; // maps to the left that keep numbers positive: truncation then rounds down
        const glm::vec2 texel = 1.0f / glm::vec2(frameSize);
        const auto tileOf = [](const glm::vec2& uv) {
            return glm::ivec2((uv + static_cast<float>(kAhead)) * glm::vec2(kCount)) - kAhead * kCount;
        };
        const glm::ivec2 first = tileOf(low - texel), last = tileOf(high + texel);
        return {{first.x, std::max(first.y, 0)}, {last.x, std::min(last.y, kCount.y - 1)}};
    }

    // Returns whether any of these tiles has been chosen.
    bool isChosen(const CellRange& tiles) const {
        if (chosen_.empty()) return false;
        for (int y = tiles.first.y; y <= tiles.last.y; ++y)
            for (int x = tiles.first.x; x <= tiles.last.x; ++x)
                if (chosen_[indexOf(x, y)]) return true;
        return false;
    }

  private:
    glm::ivec2 frameSize_{0};
    std::vector<bool> chosen_;
};

} // namespace shoal::render
