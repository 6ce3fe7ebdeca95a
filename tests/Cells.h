// Meshes of cells, for tests.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace shoal::tests {

// Adds columns x rows cells at place(u, v), u and v from 0 to 1, of two triangles each.
template <class Place>
void addCells(std::vector<glm::vec3>& positions, std::vector<uint32_t>& indices, uint32_t columns,
              uint32_t rows, const Place& place) {
    const auto first = static_cast<uint32_t>(positions.size());
    for (uint32_t y = 0; y <= rows; ++y)
        for (uint32_t x = 0; x <= columns; ++x)
            positions.push_back(place(static_cast<float>(x) / static_cast<float>(columns),
                                      static_cast<float>(y) / static_cast<float>(rows)));
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            const uint32_t a = first + y * (columns + 1) + x, b = a + columns + 1;
            indices.insert(indices.end(), {a, a + 1, b, a + 1, b + 1, b});
        }
}

} // namespace shoal::tests
