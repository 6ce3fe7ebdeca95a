#include "engine/render/BackgroundCells.h"

#include "engine/math/LatLong.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace shoal::render {

namespace {

// Largest side of a cell on the image plane at distance 1. Coordinates in a 2048 wide video are wrong by at
// most 0.1 texels up to 45 degrees of latitude, 0.2 where polar cells begin.
constexpr float kCell = 0.04f;
// A cell of a film with distances is divided if the direction in its middle differs by more than this (half a
// texel of a 2048 wide video) from the mean of its corners'; kSmallCell: side of the parts, pixels.
constexpr float kCrooked_rad = 1.5e-3f;
constexpr int kSmallCell = 8;
// Corners whose parallaxes differ by more than this (two texels) lie on both sides of a depth edge of the
// film. Between them pieces of kPiece pixels show what is seen in their middles, so that nothing is stretched
// across the edge and no line of the film is drawn twice.
constexpr float kTorn_rad = 6e-3f;
constexpr int kPiece = 2;
constexpr float kPolarV = 0.3234f; // of the map's height, from its middle: the latitude whose sine is 0.85

// Finds the cells' edges: whole pixels; in larger pictures multiples of 8, which are sampled together.
void findEdges(float halfExtent, int pixels, std::vector<int>& edges) {
    const int wanted = std::clamp(static_cast<int>(std::ceil(2 * halfExtent / kCell)), 1, 256);
    const int cells = std::clamp(wanted, 1, std::max(pixels, 1)), step = pixels / cells >= 16 ? 8 : 1;
    edges.clear();
    for (int k = 0; k < cells; ++k)
        edges.push_back(static_cast<int>(int64_t{k} * pixels / cells) / step * step);
    edges.push_back(pixels);
}

// Rounds to 1/1024 texel of a 2048 wide video, so coarse that sums of a few coordinates are exact: corners
// then lie in one plane to the last bit, by which llvmpipe recognises a rectangle.
glm::vec2 rounded(const glm::vec2& uv) {
    constexpr float kSteps = 1 << 21;
    return glm::round(uv * kSteps) / kSteps;
}

} // namespace

glm::vec3 BackgroundCells::Rays::direction(const glm::vec2& pixel) const {
    return envFromRay * glm::vec3((2.0f * pixel / size - 1.0f) * half + shift, -1);
}

BackgroundCells::Corner BackgroundCells::Rays::at(const glm::vec2& pixel) const {
    const glm::vec3 towards = direction(pixel);
    const float length = glm::length(towards);
    if (!film.depth) return {towards, latLongFromDirection(towards / length)};
    const glm::vec3 seen = depth::searchAlong(*film.depth, film.eyeInFilm, towards / length).dirEnv;
    return {seen * length, latLongFromDirection(seen), seen * length - towards};
}

BackgroundCells::Corner BackgroundCells::Rays::at(const glm::vec2& pixel, const glm::vec3& parallax) const {
    const glm::vec3 towards = direction(pixel) + parallax;
    return {towards, latLongFromDirection(glm::normalize(towards)), parallax};
}

BackgroundCell BackgroundCells::cellOf(const Corners& corners, glm::ivec2 low, glm::ivec2 high) {
    BackgroundCell cell{low, high};
    std::array<glm::vec2, 4> uv;
    for (size_t i = 0; i < 4; ++i) {
        cell.directions[i] = corners[i].directionEnv;
        uv[i] = corners[i].uv;
        uv[i].x += std::round(uv[0].x - uv[i].x); // the map repeats: all corners on one side of the seam
    }
    cell.right = rounded(0.5f * (uv[1] - uv[0] + uv[3] - uv[2]));
    cell.up = rounded(0.5f * (uv[2] - uv[0] + uv[3] - uv[1]));
    cell.first = rounded(0.25f * (uv[0] + uv[1] + uv[2] + uv[3]) - 0.5f * (cell.right + cell.up));
    cell.polar = std::abs(uv[0].y - 0.5f) > kPolarV;
    return cell;
}

// Returns whether the direction that the film gives in the cell's middle is the mean of its corners'.
bool BackgroundCells::isStraight(const BackgroundCell& cell, const Rays& rays) const {
    const glm::vec3 expected =
        0.25f * (cell.directions[0] + cell.directions[1] + cell.directions[2] + cell.directions[3]);
    const glm::vec3 found = rays.at(0.5f * glm::vec2(cell.low + cell.high)).directionEnv;
    return glm::distance(expected, found) < kCrooked_rad;
}

void BackgroundCells::divide(const BackgroundCell& cell, const Rays& rays) {
    const glm::ivec2 size = cell.high - cell.low, parts = glm::max((size + kSmallCell - 1) / kSmallCell, 1);
    const auto edge = [&](int i, int axis) {
        return std::min(cell.low[axis] + i * kSmallCell, cell.high[axis]);
    };
    within_.clear();
    for (int y = 0; y <= parts.y; ++y)
        for (int x = 0; x <= parts.x; ++x) within_.push_back(rays.at({edge(x, 0), edge(y, 1)}));
    for (int y = 0; y < parts.y; ++y)
        for (int x = 0; x < parts.x; ++x) {
            const size_t at = static_cast<size_t>(y * (parts.x + 1) + x),
                         above = at + static_cast<size_t>(parts.x) + 1;
            const Corners corners{within_[at], within_[at + 1], within_[above], within_[above + 1]};
            const glm::ivec2 low(edge(x, 0), edge(y, 1)), high(edge(x + 1, 0), edge(y + 1, 1));
            const bool torn = std::ranges::any_of(corners, [&](const Corner& corner) {
                return glm::distance(corner.parallax, corners[0].parallax) > kTorn_rad;
            });
            if (torn)
                addPieces(low, high, rays);
            else
                cells_.push_back(cellOf(corners, low, high));
        }
}

void BackgroundCells::addPieces(glm::ivec2 low, glm::ivec2 high, const Rays& rays) {
    for (int y = low.y; y < high.y; y += kPiece)
        for (int x = low.x; x < high.x; x += kPiece) {
            const glm::ivec2 end = glm::min(glm::ivec2(x, y) + kPiece, high);
            const glm::vec3 parallax = rays.at(0.5f * glm::vec2(x + end.x, y + end.y)).parallax;
            const auto corner = [&](int cx, int cy) { return rays.at({cx, cy}, parallax); };
            cells_.push_back(cellOf({corner(x, y), corner(end.x, y), corner(x, end.y), corner(end.x, end.y)},
                                    {x, y}, end));
        }
}

void BackgroundCells::make(const View& view, const glm::mat3& envFromRay, const glm::ivec2& size,
                           const FilmParallax& film) {
    const Rays rays{view.halfExtent(), view.shift, envFromRay, size, film};
    findEdges(rays.half.x, size.x, columns_);
    findEdges(rays.half.y, size.y, rows_);
    corners_.clear();
    for (const int y : rows_)
        for (const int x : columns_) corners_.push_back(rays.at({x, y}));
    cells_.clear();
    rowBegins_.clear();
    for (size_t y = 0; y + 1 < rows_.size(); ++y) {
        rowBegins_.push_back(cells_.size());
        for (size_t x = 0; x + 1 < columns_.size(); ++x) {
            const size_t at = y * columns_.size() + x, above = at + columns_.size();
            const BackgroundCell cell =
                cellOf({corners_[at], corners_[at + 1], corners_[above], corners_[above + 1]},
                       {columns_[x], rows_[y]}, {columns_[x + 1], rows_[y + 1]});
            if (film.depth && !isStraight(cell, rays))
                divide(cell, rays);
            else
                cells_.push_back(cell);
        }
    }
    rowBegins_.push_back(cells_.size());
}

} // namespace shoal::render
