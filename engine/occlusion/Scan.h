// Rasterises a triangle onto a square grid of samples, orthographically.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

namespace shoal::occlusion {

// Calls found(x, y, b) for every sample that the triangle covers in a width x height grid with samples at
// half integers; b: barycentric weights, sum 1. Corners are snapped to 1/256 of a sample. Of two triangles
// that share an edge exactly one owns the samples on it, whichever way they face: a closed body has as many
// front-facing as back-facing layers. corners: xy in samples, within +-2^20.
template <class Found>
void scanTriangle(const std::array<glm::vec3, 3>& corners, int width, int height, Found&& found) {
    constexpr int64_t kOne = 256, kHalf = kOne / 2;
    std::array<int64_t, 3> x, y;
    for (size_t k = 0; k < 3; ++k) {
        x[k] = std::llround(static_cast<double>(corners[k].x) * kOne);
        y[k] = std::llround(static_cast<double>(corners[k].y) * kOne);
    }
    int64_t area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    if (area == 0) return; // edge-on or collapsed: covers no sample
    // Corners b and c are exchanged if the triangle runs clockwise.
    const size_t b = area > 0 ? 1 : 2, c = 3 - b;
    area = std::abs(area);

    const auto [lowX, highX] = std::minmax({x[0], x[1], x[2]});
    const auto [lowY, highY] = std::minmax({y[0], y[1], y[2]});
    const auto first = [&](int64_t low) { return std::max<int64_t>(0, (low - kHalf + kOne - 1) >> 8); };
    const auto last = [&](int64_t high, int size) {
        return std::min<int64_t>(size - 1, (high - kHalf) >> 8);
    };

    struct Edge {
        int64_t value, perX, perY, minimum;
    };
    const int64_t startX = first(lowX) * kOne + kHalf, startY = first(lowY) * kOne + kHalf;
    const auto edge = [&](size_t from, size_t to) {
        const int64_t dx = x[to] - x[from], dy = y[to] - y[from];
        const bool owned = dy < 0 || (dy == 0 && dx > 0); // otherwise the neighbour owns the edge
        return Edge{dx * (startY - y[from]) - dy * (startX - x[from]), -dy * kOne, dx * kOne, owned ? 0 : 1};
    };
    std::array<Edge, 3> opposite; // the edge opposite of each corner
    opposite[0] = edge(b, c), opposite[b] = edge(c, 0), opposite[c] = edge(0, b);
    const double perArea = 1.0 / static_cast<double>(area);
    for (int64_t j = first(lowY), endY = last(highY, height), endX = last(highX, width); j <= endY; ++j) {
        std::array<Edge, 3> here = opposite;
        for (int64_t i = first(lowX); i <= endX; ++i) {
            if (std::ranges::all_of(here, [](const Edge& e) { return e.value >= e.minimum; })) {
                glm::vec3 weights;
                for (int k = 0; k < 3; ++k)
                    weights[k] = static_cast<float>(static_cast<double>(here[k].value) * perArea);
                found(static_cast<int>(i), static_cast<int>(j), weights);
            }
            for (Edge& e : here) e.value += e.perX;
        }
        for (Edge& e : opposite) e.value += e.perY;
    }
}

} // namespace shoal::occlusion
