#include "tests/baselines/occlusion/LayeredDepth.h"

#include <algorithm>

namespace shoal::occlusion::baselines {

LayeredDepth::LayeredDepth(std::span<const Triangles> bodies, int size) {
    const Sphere sphere = boundingSphereOf(bodies);
    struct Layer {
        float depth = 0;
        int enters = 0; // 1, or -1 where it leaves
    };
    for (int axis = 0; axis < 3; ++axis) {
        View& out = views_[static_cast<size_t>(axis)];
        glm::vec3 along(0);
        along[axis] = 1;
        out.view = viewAlong(along, sphere.centre, sphere.radius, size);
        std::vector<std::vector<Layer>> pixels(static_cast<size_t>(size) * size);
        for (const Triangles& body : bodies)
            rasterise(out.view, body, [&](int pixel, float depth, bool front) {
                pixels[static_cast<size_t>(pixel)].push_back({depth, front ? 1 : -1});
            });
        for (auto& layers : pixels) {
            out.first.push_back(static_cast<uint32_t>(out.solid.size()));
            std::ranges::sort(layers, {}, &Layer::depth);
            int inside = 0;
            for (const Layer& layer : layers) {
                const int now = std::max(0, inside + layer.enters);
                if ((inside == 0) != (now == 0)) out.solid.push_back(layer.depth);
                inside = now;
            }
            if ((out.solid.size() - out.first.back()) % 2) out.solid.pop_back(); // never left: a hole
        }
        out.first.push_back(static_cast<uint32_t>(out.solid.size()));
    }
}

bool LayeredDepth::occluded(const glm::vec3& origin, const glm::vec3& direction, float nearest) const {
    const glm::vec3 size = glm::abs(direction);
    const View& at = views_[size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2)];
    const float scale = at.view.pixelsPerMetre();
    const glm::vec3 from = at.view.toView(origin + nearest * direction);
    const glm::vec2 step =
        scale * glm::vec2(glm::dot(direction, at.view.right), glm::dot(direction, at.view.up));
    const float rise = glm::dot(direction, at.view.along);
    glm::ivec2 pixel(glm::floor(glm::vec2(from)));
    const glm::ivec2 turn(step.x < 0 ? -1 : 1, step.y < 0 ? -1 : 1);
    const auto border = [&](int axis) { // distance along the ray at which it leaves the pixel
        if (std::abs(step[axis]) < 1e-9f) return 1e30f;
        return (static_cast<float>(pixel[axis] + (turn[axis] > 0)) - from[axis]) / step[axis];
    };
    for (float t = 0;;) {
        if (pixel.x < 0 || pixel.y < 0 || pixel.x >= at.view.size || pixel.y >= at.view.size) return false;
        const float tx = border(0), ty = border(1), end = std::min({tx, ty, 1e6f});
        const float a = from.z + rise * t, b = from.z + rise * end;
        const auto [low, high] = std::minmax(a, b);
        const auto index = static_cast<size_t>(pixel.y) * at.view.size + pixel.x;
        for (uint32_t i = at.first[index]; i < at.first[index + 1]; i += 2)
            if (at.solid[i] <= high && at.solid[i + 1] >= low) return true;
        if (end >= 1e6f) return false;
        pixel[tx < ty ? 0 : 1] += turn[tx < ty ? 0 : 1];
        t = end;
        if (std::abs(from.z + rise * t) > at.view.radius * 1.5f && rise * (from.z + rise * t) > 0)
            return false;
    }
}

std::size_t LayeredDepth::bytes() const {
    std::size_t sum = 0;
    for (const View& view : views_) sum += (view.first.size() + view.solid.size()) * 4;
    return sum;
}

} // namespace shoal::occlusion::baselines
