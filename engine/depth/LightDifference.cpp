#include "engine/depth/LightDifference.h"

#include "engine/light/Lookup.h"
#include "engine/math/Octahedron.h"
#include "engine/math/SphericalHarmonics.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace shoal::depth {

namespace {

// Cells along a side of octahedral maps (math/Octahedron.h): of rays and radiance, and of distances.
constexpr int kCoarse = 12, kFine = 48, kRatio = kFine / kCoarse;

int coarseOf(int fine) { return fine / kFine / kRatio * kCoarse + fine % kFine / kRatio; }

struct Ray {
    glm::vec3 dir;
    std::array<float, 9> basis; // times the ray's solid angle
};

// A cell at a distance d from the octahedron's centre covers a solid angle proportional to 1 / d^3.
std::array<Ray, kCoarse * kCoarse> makeRays() {
    std::array<Ray, kCoarse * kCoarse> rays;
    std::array<double, kCoarse * kCoarse> shares;
    double all = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        rays[i].dir = math::octahedralDirection(static_cast<int>(i), kCoarse);
        const auto sum =
            static_cast<double>(std::abs(rays[i].dir.x) + std::abs(rays[i].dir.y) + std::abs(rays[i].dir.z));
        all += shares[i] = sum * sum * sum;
    }
    for (size_t i = 0; i < rays.size(); ++i) {
        const math::ShBasis basis = math::shBasis(glm::dvec3(rays[i].dir));
        for (size_t k = 0; k < 9; ++k)
            rays[i].basis[k] = static_cast<float>(basis[k] * 4 * std::numbers::pi * shares[i] / all);
    }
    return rays;
}

} // namespace

void LightDifference::make(const ImageRgbF& radianceLin, const DepthMap& map) {
    inverse_perM_.resize(kFine * kFine);
    radiance_.assign(kCoarse * kCoarse, glm::vec3(0));
    for (int cell = 0; cell < kFine * kFine; ++cell) {
        const glm::vec3 dir = math::octahedralDirection(cell, kFine);
        inverse_perM_[cell] = map.inverse_perM(dir);
        radiance_[coarseOf(cell)] += light::lookUp(radianceLin, dir) * (1.0f / (kRatio * kRatio));
    }
}

// Steps grow with the distance from the place; the step that passes the surface is halved repeatedly.
int LightDifference::firstHit(const glm::vec3& place, const glm::vec3& dir) const {
    const auto isBehindSurface = [&](float t, int& cell) {
        const glm::vec3 there = place + dir * t;
        const float square = glm::dot(there, there);
        if (square == 0) return false; // at the camera
        cell = math::octahedralCell(there, kFine);
        const float inverse = inverse_perM_[cell];
        return square * inverse * inverse >= 1 && inverse > 1 / kFar_m;
    };
    constexpr int kHalvings = 3;
    int cell = 0, hit = -1;
    float low = 0, high = 0.1f;
    for (; high < 1.5f * kFar_m; low = high, high = 1.35f * high + 0.05f)
        if (isBehindSurface(high, hit)) break;
    if (high >= 1.5f * kFar_m) return -1;
    for (int i = 0; i < kHalvings; ++i) {
        const float middle = 0.5f * (low + high);
        if (isBehindSurface(middle, cell))
            high = middle, hit = cell;
        else
            low = middle;
    }
    return hit;
}

LightHarmonics LightDifference::at(const glm::vec3& placeEnv) const {
    LightHarmonics difference{};
    const float fade = 1 - glm::smoothstep(kFar_m, 1.5f * kFar_m, glm::length(placeEnv));
    if (radiance_.empty() || fade == 0) return difference;
    static const auto rays = makeRays();
    for (size_t i = 0; i < rays.size(); ++i) {
        const int hit = firstHit(placeEnv, rays[i].dir);
        if (hit < 0) continue;
        const float nearness = glm::smoothstep(1 / kFar_m, 2 / kFar_m, inverse_perM_[hit]);
        const glm::vec3 change = (radiance_[coarseOf(hit)] - radiance_[i]) * (fade * nearness);
        for (size_t k = 0; k < difference.size(); ++k) difference[k] += rays[i].basis[k] * change;
    }
    return difference;
}

} // namespace shoal::depth
