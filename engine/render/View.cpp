#include "engine/render/View.h"

namespace shoal::render {

bool sees(const View& view, const Sphere& sphere) {
    const glm::vec3 inEye = glm::conjugate(view.worldFromEye) * (sphere.centre - view.eyeWorld);
    if (-inEye.z < view.near_m - sphere.radius || -inEye.z > view.far_m + sphere.radius) return false;
    const glm::vec2 half = view.halfExtent();
    const auto beyond = [&](float across,
                            float slope) { // distance outside of the plane across = slope * ahead
        return (across + slope * inEye.z) / std::sqrt(1 + slope * slope) > sphere.radius;
    };
    return !(beyond(inEye.x, half.x + view.shift.x) || beyond(-inEye.x, half.x - view.shift.x) ||
             beyond(inEye.y, half.y + view.shift.y) || beyond(-inEye.y, half.y - view.shift.y));
}

} // namespace shoal::render
