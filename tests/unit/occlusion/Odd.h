// Bodies with corners and edges.
#pragma once

#include "Bodies.h"

namespace shoal::occlusion {

inline Body box(const glm::vec3& half) {
    Body body;
    for (int face = 0; face < 6; ++face) {
        const int a = face / 2, b = (a + 1) % 3, c = (a + 2) % 3;
        const float side = face % 2 ? -1.0f : 1.0f;
        const auto first = static_cast<uint32_t>(body.positions.size());
        for (int k = 0; k < 4; ++k) {
            glm::vec3 p;
            p[a] = side * half[a];
            p[b] = (k == 1 || k == 2 ? 1.0f : -1.0f) * half[b];
            p[c] = (k >= 2 ? 1.0f : -1.0f) * half[c];
            body.positions.push_back(p);
            glm::vec3 n(0);
            n[a] = side;
            body.normals.push_back(n);
        }
        const uint32_t i = first + (side > 0 ? 1 : 3), j = first + (side > 0 ? 3 : 1);
        body.triangles.emplace_back(first, i, first + 2);
        body.triangles.emplace_back(first, first + 2, j);
    }
    return body;
}

inline Body oneTriangle() {
    Body body;
    body.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    body.triangles = {{0, 1, 2}};
    addNormals(body);
    return body;
}

} // namespace shoal::occlusion
