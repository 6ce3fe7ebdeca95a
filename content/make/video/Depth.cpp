#include "content/make/video/Depth.h"

#include "engine/math/LatLong.h"

#include <algorithm>
#include <cmath>

namespace shoal::reef {

namespace {

constexpr float kFurthest = 45; // metres: no water is as clear

float inverseDistance(const World& world, const vec3& camera, const vec3& dir) {
    const float surface = dir.y > 0 ? -camera.y / dir.y : kFurthest;
    const float furthest = std::min(surface, kFurthest);
    Hit hit;
    const float metres = world.trace(camera, dir, furthest, hit) ? hit.distance : furthest;
    return metres < kFurthest ? 1 / metres : 0;
}

} // namespace

media::DepthFrame traceDepth(World& world, const Route& route, float turn, int width, int rays,
                             int stepsPerOctave) {
    const vec3 camera = route.at(turn);
    world.advance(turn, camera);
    const int height = width / 2, side = static_cast<int>(std::lround(std::sqrt(rays)));
    media::DepthFrame depth{
        width, height, std::vector<uint16_t>(static_cast<size_t>(width) * height),
        std::vector<uint16_t>(static_cast<size_t>(width / 2) * (height / 2), media::kMaxDepthCode)};
#pragma omp parallel for schedule(dynamic, 4)
    for (int y = 0; y < height; ++y) {
        std::vector<float> found;
        for (int x = 0; x < width; ++x) {
            found.clear();
            for (int ray = 0; ray < side * side; ++ray) {
                const vec2 within((static_cast<float>(ray % side) + 0.5f) / static_cast<float>(side),
                                  (static_cast<float>(ray / side) + 0.5f) / static_cast<float>(side));
                const vec2 uv = (vec2(x, y) + within) / vec2(width, height);
                found.push_back(inverseDistance(world, camera, directionFromLatLong(uv)));
            }
            const auto middle = found.begin() + static_cast<ptrdiff_t>(found.size() / 2);
            std::nth_element(found.begin(), middle, found.end());
            depth.inverse[static_cast<size_t>(y) * width + x] = media::depthCode(*middle, stepsPerOctave);
        }
    }
    return depth;
}

} // namespace shoal::reef
