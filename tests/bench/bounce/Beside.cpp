#include "tests/bench/bounce/Beside.h"

#include "engine/math/LatLong.h"
#include "engine/math/SphericalHarmonics.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::bench {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kEndless_perM = 1e-3f;

void addTo(depth::LightHarmonics& sum, const glm::vec3& dir, const glm::vec3& flux) {
    const math::ShBasis basis = math::shBasis(glm::dvec3(dir));
    for (size_t i = 0; i < sum.size(); ++i) sum[i] += static_cast<float>(basis[i]) * flux;
}

void scale(depth::LightHarmonics& all, float factor) {
    for (glm::vec3& one : all) one *= factor;
}

} // namespace

glm::vec3 Patches::direction(int x, int y) const { return texelDirection(x, y, width_, height_); }

Patches::Patches(const ImageRgbF& radianceLin, const media::DepthFrame& depth, float far_m)
    : width_(radianceLin.width), height_(radianceLin.height) {
    const int side = depth.width / width_;
    std::vector<float> within, inverse; // 1 / m
    std::vector<glm::vec3> radiance;
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            within.clear();
            for (int j = 0; j < side; ++j)
                for (int i = 0; i < side; ++i)
                    within.push_back(depth.inverse_perM(x * side + i, y * side + j));
            const auto middle = within.begin() + static_cast<ptrdiff_t>(within.size() / 2);
            std::nth_element(within.begin(), middle, within.end());
            const float near = glm::smoothstep(1 / far_m, 2 / far_m, *middle);
            inverse.push_back(near > 0 ? *middle : kEndless_perM);
            const float* texel = radianceLin.at(x, y);
            radiance.emplace_back(texel[0], texel[1], texel[2]);
        }
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            const size_t here = static_cast<size_t>(y) * width_ + x;
            const glm::vec3 dir = direction(x, y);
            const float distance = 1 / inverse[here];
            const auto solidAngle = static_cast<float>(texelSolidAngle(y, width_, height_));
            // Normal of the surface through its neighbours, if they lie on one.
            glm::vec3 normal = -dir;
            const int left = (x + width_ - 1) % width_, right = (x + 1) % width_;
            const int up = std::max(y - 1, 0), down = std::min(y + 1, height_ - 1);
            const auto at = [&](int i, int j) {
                return direction(i, j) / inverse[static_cast<size_t>(j) * width_ + i];
            };
            const auto joined = [&](int i, int j) {
                const float ratio = inverse[static_cast<size_t>(j) * width_ + i] / inverse[here];
                return ratio < 1.5f && ratio > 1 / 1.5f;
            };
            if (joined(left, y) && joined(right, y) && joined(x, up) && joined(x, down)) {
                const glm::vec3 across = glm::cross(at(right, y) - at(left, y), at(x, up) - at(x, down));
                if (glm::dot(across, across) > 0) normal = glm::normalize(across);
                if (glm::dot(normal, dir) > 0) normal = -normal;
            }
            const float facing = std::max(-glm::dot(normal, dir), 0.15f);
            const float discArea = solidAngle * distance * distance, area = discArea / facing;
            patches_.push_back({dir * distance, normal, radiance[here], area, discArea});
            addTo(camera_, dir, radiance[here] * solidAngle);
        }
}

depth::LightHarmonics Patches::discs(const glm::vec3& place) const {
    depth::LightHarmonics sum{};
    float all = 0;
    for (const Patch& patch : patches_) {
        const glm::vec3 to = patch.place - place;
        const float square = glm::dot(to, to),
                    solidAngle = patch.facingArea / (square + patch.facingArea / kPi);
        addTo(sum, to / std::sqrt(square), patch.radiance * solidAngle);
        all += solidAngle;
    }
    scale(sum, 4 * kPi / all);
    return sum;
}

depth::LightHarmonics Patches::surface(const glm::vec3& place) const {
    depth::LightHarmonics sum{};
    float all = 0;
    for (const Patch& patch : patches_) {
        const glm::vec3 to = patch.place - place;
        const float square = glm::dot(to, to), inverse = 1 / std::sqrt(square);
        const float facing = std::max(-glm::dot(to, patch.normal) * inverse, 0.0f);
        const float solidAngle = patch.area * facing / (square + patch.area / kPi);
        addTo(sum, to * inverse, patch.radiance * solidAngle);
        all += solidAngle;
    }
    scale(sum, 4 * kPi / all);
    return sum;
}

} // namespace shoal::bench
