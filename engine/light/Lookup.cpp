#include "engine/light/Lookup.h"

#include "engine/light/GlossyLevels.h"
#include "engine/math/LatLong.h"

namespace shoal::light {

glm::vec3 lookUp(const ImageRgbF& map, const glm::vec3& dir) {
    const glm::vec2 uv = latLongFromDirection(dir);
    const float x = uv.x * static_cast<float>(map.width) - 0.5f;
    const float y = uv.y * static_cast<float>(map.height) - 0.5f;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const auto texel = [&](int column, int row) {
        const bool beyond = row < 0 || row >= map.height; // beyond a pole lies the same row, half a turn away
        if (beyond) column += map.width / 2;
        const float* t =
            map.at((column % map.width + map.width) % map.width, row < 0  ? -1 - row
                                                                 : beyond ? 2 * map.height - 1 - row
                                                                          : row);
        return glm::vec3(t[0], t[1], t[2]);
    };
    const glm::vec3 top = texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx;
    const glm::vec3 bottom = texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx;
    return top * (1 - fy) + bottom * fy;
}

namespace {

// Interpolates between the two levels around this level of detail; imageOf(k) returns level k of `count`.
template <class ImageOf>
glm::vec3 mixed(float lod, size_t count, const glm::vec3& dir, const ImageOf& imageOf) {
    const auto low = static_cast<size_t>(lod);
    const float f = lod - static_cast<float>(low);
    return lookUp(imageOf(low), dir) * (1 - f) + lookUp(imageOf(std::min(low + 1, count - 1)), dir) * f;
}

} // namespace

glm::vec3 lookUp(const RadiancePyramid& pyramid, const glm::vec3& dir, float lod) {
    const size_t count = pyramid.levels.size();
    return mixed(std::clamp(lod, 0.0f, static_cast<float>(count - 1)), count, dir,
                 [&](size_t k) -> const ImageRgbF& { return pyramid.levels[k]; });
}

glm::vec3 lookUpGlossy(const EnvironmentLight& light, const glm::vec3& dir, float roughness) {
    return mixed(lodFromRoughness(light.glossy, roughness), light.glossy.size(), dir,
                 [&](size_t k) -> const ImageRgbF& { return glossyImage(light, k); });
}

} // namespace shoal::light
