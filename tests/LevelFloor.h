// A level floor for the physics world: two triangles below the box that it asks for.
#pragma once

#include "engine/physics/World.h"

namespace shoal::tests {

inline physics::Ground levelFloor(float height, float friction = 0) {
    const auto triangles = [height](glm::vec3 low, glm::vec3 high, const physics::Ground::Visit& visit) {
        if (low.y > height || high.y < height) return;
        const glm::vec3 a(low.x - 1, height, low.z - 1), b(high.x + 1, height, low.z - 1),
            c(high.x + 1, height, high.z + 1), d(low.x - 1, height, high.z + 1);
        visit(a, c, b);
        visit(a, d, c);
    };
    return {triangles, friction};
}

} // namespace shoal::tests
