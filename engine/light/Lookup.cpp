#include "engine/light/Lookup.h"

#include "engine/math/Brdf.h"
#include "engine/math/LatLong.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::light {

using std::numbers::pi;

glm::vec3 lookUp(const ImageRgbF& map, const glm::vec3& dir) {
    const glm::vec2 uv = latLongFromDirection(dir);
    const float x = uv.x * static_cast<float>(map.width) - 0.5f;
    const float y = uv.y * static_cast<float>(map.height) - 0.5f;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const auto texel = [&](int column, int row) {
        const int known = rowOnSphere(row, map.height);
        if (known != row) column += map.width / 2;
        return glm::make_vec3(map.at((column % map.width + map.width) % map.width, known));
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

float lodFromRoughness(const std::vector<GlossyLevel>& levels, float roughness) {
    constexpr float kMin = 1e-6f;
    const float alpha = std::max(roughness * roughness, kMin);
    float lod = 0;
    for (size_t k = 0; k + 1 < levels.size(); ++k) {
        const float low = std::max(levels[k].roughness * levels[k].roughness, kMin);
        const float high = levels[k + 1].roughness * levels[k + 1].roughness;
        lod += std::clamp((alpha - low) * high / (alpha * (high - low)), 0.0f, 1.0f);
    }
    return lod;
}

const ImageRgbF& glossyImage(const EnvironmentLight& light, size_t k) {
    const ImageRgbF& own = light.glossy[k].radianceLin;
    return own.empty() ? light.radiance.levels[k] : own;
}

glm::vec3 lookUpGlossy(const EnvironmentLight& light, const glm::vec3& dir, float roughness) {
    return mixed(lodFromRoughness(light.glossy, roughness), light.glossy.size(), dir,
                 [&](size_t k) -> const ImageRgbF& { return glossyImage(light, k); });
}

// The lobe cos(t)^n has the share cos(t)^(n + 1) of its energy outside the angle t. It is half its peak at
// cos(t) = 2^(-1/n), so the share 2^-((n + 1) / n) of the energy lies outside that angle.
std::array<PhongRing, kPhongRings> phongRings(double roughness) {
    const double exponent = math::phongExponentFromRoughness(roughness);
    const double outside = std::exp2(-(exponent + 1) / exponent);
    std::array<PhongRing, kPhongRings> rings;
    for (int i = 0; i < kPhongRings; ++i) {
        const double part = (i % 3 + 0.5) / 3;
        const double left = i < 3 ? 1 - part * (1 - outside) : (1 - part) * outside;
        rings[i] = {std::acos(std::pow(left, 1 / (exponent + 1))), (i < 3 ? 1 - outside : outside) / 3};
    }
    return rings;
}

glm::vec3 phongRingsRadiance(const RadiancePyramid& pyramid, const glm::vec3& mirror, double roughness) {
    const glm::vec3 helper = std::abs(mirror.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 side = glm::normalize(glm::cross(mirror, helper));
    const glm::vec3 up = glm::cross(side, mirror);
    const auto rings = phongRings(roughness);
    glm::vec3 sum(0);
    for (size_t r = 0; r < rings.size(); ++r) {
        const double angle = rings[r].angle;
        const double spacing = std::max(2 * pi * std::sin(angle) / kSamplesPerRing, 1e-4);
        const double lod = std::max(0.0, std::log2(spacing * pyramid.levels[0].width / (2 * pi)));
        glm::vec3 ring(0);
        for (int i = 0; i < kSamplesPerRing; ++i) {
            const double turn = (i + (r % 2 ? 0.5 : 0.0)) * (2 * pi / kSamplesPerRing);
            const glm::vec3 aside =
                side * static_cast<float>(std::cos(turn)) + up * static_cast<float>(std::sin(turn));
            const glm::vec3 dir =
                mirror * static_cast<float>(std::cos(angle)) + aside * static_cast<float>(std::sin(angle));
            ring += lookUp(pyramid, dir, static_cast<float>(lod));
        }
        sum += ring * static_cast<float>(rings[r].weight / kSamplesPerRing);
    }
    return sum;
}

} // namespace shoal::light
