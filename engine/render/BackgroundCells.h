// Divides a view of an equirectangular map into rectangular cells. Within a cell the map's coordinates are
// affine to 0.2 texels, so that no pixel needs trigonometry. If the film has distances and the eye is beside
// its camera, the film is searched at the cells' corners, and cells are smaller where distances change.
#pragma once

#include "engine/depth/DepthMap.h"
#include "engine/render/FrameTiles.h"
#include "engine/render/View.h"

#include <glm/glm.hpp>

#include <array>
#include <span>
#include <vector>

namespace shoal::render {

// A film with the distances of what it shows, and the position of the eye that looks at it.
struct FilmParallax {
    const depth::DepthMap* depth = nullptr; // widened (depth::widenNear()); null: infinitely far
    glm::vec3 eyeInFilm{0};                 // env frame, from the film's camera
};

struct BackgroundCell {
    glm::ivec2 low{0}, high{0};          // range of the picture's pixels, rows counted from the bottom
    glm::vec2 first{0}, right{0}, up{0}; // map coordinates at `low`, and the steps to the next corners
    bool polar = false;                  // near a pole: each pixel computes its coordinates from `directions`
    std::array<glm::vec3, 4> directions{}; // env frame: lower left, lower right, upper left, upper right

    // Returns the tiles of a frame of this size that the cell shows.
    CellRange tiles(const glm::ivec2& frameSize) const {
        return FrameTiles::between(first + glm::min(right, 0.0f) + glm::min(up, 0.0f),
                                   first + glm::max(right, 0.0f) + glm::max(up, 0.0f), frameSize);
    }
};

struct CellToDraw {
    const BackgroundCell* cell;
    bool painted; // whether the cell shows the frame with objects in it, not the plain frame
};

class BackgroundCells {
  public:
    // size: in pixels. Allocates only if there are more cells than ever before.
    void make(const View& view, const glm::mat3& envFromRay, const glm::ivec2& size,
              const FilmParallax& film = {});

    std::span<const BackgroundCell> all() const { return cells_; }

  private:
    struct Corner {
        glm::vec3 directionEnv{0}; // reaches from the eye to the image plane
        glm::vec2 uv{0};
        glm::vec3 parallax{0}; // offset of the direction that the film's distance causes
    };
    using Edges = std::array<std::vector<int>, 2>; // edges of the columns and of the rows, in pixels
    using Corners = std::array<Corner, 4>;         // lower left, lower right, upper left, upper right
    struct Rays {                                  // rays of the picture that is divided
        glm::vec2 half{1}, shift{0};
        glm::mat3 envFromRay{1};
        glm::vec2 size{1};
        FilmParallax film;
        glm::vec3 direction(const glm::vec2& pixel) const;
        Corner at(const glm::vec2& pixel) const; // looks up the parallax in the film's distances
        Corner at(const glm::vec2& pixel, const glm::vec3& parallax) const;
    };
    static BackgroundCell cellOf(const Corners& corners, glm::ivec2 low, glm::ivec2 high);
    template <class Visit>
    void eachCell(const Edges& edges, const Rays& rays, std::vector<Corner>& all, Visit&& visit);
    void divide(const BackgroundCell& cell, const Rays& rays);
    void addPieces(glm::ivec2 low, glm::ivec2 high, const Rays& rays);

    std::vector<BackgroundCell> cells_;
    Edges edges_, parts_;                  // edges of the grid's cells, and of a divided cell's parts
    std::vector<Corner> corners_, within_; // scratch: of the grid's corners; of a divided cell's corners
};

} // namespace shoal::render
