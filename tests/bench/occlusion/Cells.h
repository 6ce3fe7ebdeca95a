// The sphere of directions cut into cells, finer where any of the environments is bright; what each
// environment sends through each cell is exact, so that one ray a cell tells the light of all environments at
// once.
#pragma once

#include "tests/bench/Bench.h"

namespace shoal::bench {

struct Cell {
    glm::vec2 low{0}; // corner in the octahedral square [0, 1]^2
    float side = 0;
    glm::vec3 centre{0}; // unit
    float solidAngle = 0;
};

struct Cells {
    std::vector<Cell> cells;
    size_t environments = 0;
    std::vector<glm::vec3> power; // [cell][environment]: integral of radiance over the cell

    std::vector<uint32_t> byPlace; // of the square at its finest, row by row: the cell there
    size_t cellTowards(const glm::vec3& direction) const;

    std::span<const glm::vec3> of(size_t cell) const {
        return {power.data() + cell * environments, environments};
    }
};

glm::vec3 directionOfSquare(const glm::vec2& at); // [0, 1]^2; math/Octahedron.h

// Radiance summed on a fine square; one an environment.
using Fine = std::vector<glm::vec3>;
Fine fineOf(const ImageRgbF& radianceLin);

Cells cellsOf(std::span<const Fine> environments);

} // namespace shoal::bench
