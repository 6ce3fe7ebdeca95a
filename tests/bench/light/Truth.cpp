#include "tests/bench/light/Truth.h"

namespace shoal::bench {

std::vector<glm::dvec3> chartDirections(int spread) {
    std::vector<glm::dvec3> dirs;
    for (int i = 0; i < spread; ++i) {
        const double y = 1 - (2 * i + 1.0) / spread, turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
        const double ring = std::sqrt(1 - y * y);
        dirs.emplace_back(ring * std::cos(turn), y, ring * std::sin(turn));
    }
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            glm::dvec3 dir(0);
            dir[axis] = sign;
            dirs.push_back(dir);
        }
    return dirs;
}

Truth integrals(const ImageRgbF& radianceLin, std::span<const glm::dvec3> dirs,
                std::span<const light::Lobe> lobes) {
    Truth truth(dirs.size());
    onAllCores(dirs.size(),
               [&](size_t k) { truth[k] = light::referenceRadiance(radianceLin, dirs[k], lobes); });
    return truth;
}

Truth truthOf(const ImageRgbF& radianceLin, std::span<const glm::dvec3> dirs) {
    std::vector<light::Lobe> lobes = {light::diffuseLobe()};
    for (const float roughness : kRoughnesses) lobes.push_back(light::glossyLobe(roughness));
    return integrals(radianceLin, dirs, lobes);
}

} // namespace shoal::bench
