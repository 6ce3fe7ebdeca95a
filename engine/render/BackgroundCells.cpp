#include "engine/render/BackgroundCells.h"

#include "engine/math/LatLong.h"

#include <algorithm>
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
// Corners whose parallaxes differ by more than this (two texels) lie on two sides of a depth edge. Between
// them, pieces of kPiece pixels take the parallax of their middles, so that nothing is stretched across the
// edge and no line of the film is drawn twice.
constexpr float kTorn_rad = 6e-3f;
constexpr int kPiece = 2;
constexpr float kPolarV = 0.3234f; // share of the map's height from its middle, where latitude has sine 0.85

// Finds the cells' edges in whole pixels; in larger pictures multiples of 8, which are sampled together.
void findEdges(float halfExtent, int pixels, std::vector<int>& edges) {
    const int wanted = static_cast<int>(std::ceil(2 * halfExtent / kCell));
    const int cells = std::clamp(wanted, 1, std::clamp(pixels, 1, 256)), step = pixels / cells >= 16 ? 8 : 1;
    edges.clear();
    for (int k = 0; k < cells; ++k)
        edges.push_back(static_cast<int>(int64_t{k} * pixels / cells) / step * step);
    edges.push_back(pixels);
}

// Rounds a number that fits an int, without a call of the C library.
float nearest(float value) {
    return static_cast<float>(static_cast<int>(value + (value < 0 ? -0.5f : 0.5f)));
}

// Rounds to 1/1024 texel of a 2048 wide video, so that sums of a few coordinates are exact: corners then lie
// in one plane to the last bit, by which llvmpipe recognises a rectangle.
glm::vec2 rounded(const glm::vec2& uv) {
    constexpr float kSteps = 1 << 21;
    return glm::vec2(nearest(uv.x * kSteps), nearest(uv.y * kSteps)) / kSteps;
}

} // namespace

glm::vec3 BackgroundCells::Rays::direction(const glm::vec2& pixel) const {
    return envFromRay * glm::vec3((2.0f * pixel / size - 1.0f) * half + shift, -1);
}

BackgroundCells::Corner BackgroundCells::Rays::at(const glm::vec2& pixel) const {
    const glm::vec3 towards = direction(pixel);
    const float length = glm::length(towards);
    if (!film.depth) return {towards, latLongFromDirection(towards / length)};
    const glm::vec3 seen = depth::filmDirectionSeen(*film.depth, film.eyeInFilm, towards / length);
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
        uv[i].x += nearest(uv[0].x - uv[i].x); // the map repeats: all corners on one side of the seam
    }
    cell.right = rounded(0.5f * (uv[1] - uv[0] + uv[3] - uv[2]));
    cell.up = rounded(0.5f * (uv[2] - uv[0] + uv[3] - uv[1]));
    cell.first = rounded(0.25f * (uv[0] + uv[1] + uv[2] + uv[3]) - 0.5f * (cell.right + cell.up));
    cell.polar = std::abs(uv[0].y - 0.5f) > kPolarV;
    return cell;
}

// Calls visit(corners, low, high) for each cell between these edges, row by row. all: scratch.
template <class Visit>
void BackgroundCells::eachCell(const Edges& edges, const Rays& rays, std::vector<Corner>& all,
                               Visit&& visit) {
    const auto& [columns, rows] = edges;
    all.clear();
    for (const int y : rows)
        for (const int x : columns) all.push_back(rays.at({x, y}));
    for (size_t y = 0; y + 1 < rows.size(); ++y)
        for (size_t x = 0; x + 1 < columns.size(); ++x) {
            const size_t at = y * columns.size() + x, above = at + columns.size();
            visit(Corners{all[at], all[at + 1], all[above], all[above + 1]}, glm::ivec2(columns[x], rows[y]),
                  glm::ivec2(columns[x + 1], rows[y + 1]));
        }
}

void BackgroundCells::divide(const BackgroundCell& cell, const Rays& rays) {
    for (const int axis : {0, 1}) {
        std::vector<int>& edges = parts_[static_cast<size_t>(axis)];
        edges.clear();
        for (int at = cell.low[axis]; at < cell.high[axis]; at += kSmallCell) edges.push_back(at);
        edges.push_back(cell.high[axis]);
    }
    eachCell(parts_, rays, within_, [&](const Corners& corners, glm::ivec2 low, glm::ivec2 high) {
        const bool torn = std::ranges::any_of(corners, [&](const Corner& corner) {
            return glm::distance(corner.parallax, corners[0].parallax) > kTorn_rad;
        });
        if (torn)
            addPieces(low, high, rays);
        else
            cells_.push_back(cellOf(corners, low, high));
    });
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
    findEdges(rays.half.x, size.x, edges_[0]);
    findEdges(rays.half.y, size.y, edges_[1]);
    cells_.clear();
    eachCell(edges_, rays, corners_, [&](const Corners& corners, glm::ivec2 low, glm::ivec2 high) {
        const BackgroundCell cell = cellOf(corners, low, high);
        // A cell is straight if the direction that the film gives in its middle is the mean of its corners'.
        const glm::vec3 mean =
            0.25f * (cell.directions[0] + cell.directions[1] + cell.directions[2] + cell.directions[3]);
        if (film.depth &&
            glm::distance(mean, rays.at(0.5f * glm::vec2(low + high)).directionEnv) >= kCrooked_rad)
            divide(cell, rays);
        else
            cells_.push_back(cell);
    });
}

} // namespace shoal::render
