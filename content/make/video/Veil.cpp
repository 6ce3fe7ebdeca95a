#include "content/make/video/Veil.h"

#include "content/make/video/Light.h"
#include "content/make/video/Noise.h"
#include "engine/math/LatLong.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace shoal::reef {

// Returns the near distance of a slice, metres: edges grow evenly at first, then by a constant ratio.
float Veil::edge(int slice) { return kNearest * (std::exp(static_cast<float>(slice) * kRatio) - 1) / kFirst; }

namespace {
constexpr vec3 kSpread[8] = {{1, 0.2f, 0.1f},       {-0.9f, -0.3f, 0.3f}, {0.2f, 1, -0.2f},
                             {-0.1f, -0.9f, -0.4f}, {0.3f, -0.2f, 1},     {-0.3f, 0.3f, -0.9f},
                             {0.6f, -0.6f, 0.5f},   {-0.6f, 0.6f, -0.4f}};
}

void Veil::fill(const Scene& scene, const World& world, const Caustics& caustics, const vec3& camera,
                int width) {
    width_ = std::min(static_cast<int>(std::bit_floor(static_cast<unsigned>(width))), kFinest);
    height_ = width_ / 2;
    cells_.resize(static_cast<size_t>(width_) * height_ * kSlices);
    const Water& water = scene.water;
    // The march ends at the surface seen in a direction, or at the farthest one seen beside it.
    std::vector<float> seen(static_cast<size_t>(width_) * height_);
#pragma omp parallel for schedule(dynamic, 2)
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            Hit hit;
            const vec3 dir = directionFromLatLong((vec2(x, y) + 0.5f) / vec2(width_, height_));
            const bool met = world.trace(camera, dir, edge(kSlices), hit);
            seen[static_cast<size_t>(y) * width_ + x] = met ? hit.distance : edge(kSlices);
        }
    const auto furthest = [&](int x, int y, int step) {
        float distance = 0;
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height_ - 1); ++j)
            for (int i = x - 1; i <= x + step; ++i)
                distance =
                    std::max(distance, seen[static_cast<size_t>(j) * width_ + ((i + width_) & (width_ - 1))]);
        return distance;
    };
#pragma omp parallel for schedule(dynamic, 2)
    for (int y = 0; y < height_; ++y) {
        // Columns lie close together near the poles: only every n-th is marched, and the rest repeat it.
        const float ring =
            std::cos((0.5f - (static_cast<float>(y) + 0.5f) / static_cast<float>(height_)) * 3.14159265f);
        const int step = 1 << std::clamp(static_cast<int>(-std::log2(ring)), 0, 5);
        for (int x = 0; x < width_; x += step) {
            const vec2 uv((static_cast<float>(x) + 0.5f * static_cast<float>(step)) /
                              static_cast<float>(width_),
                          (static_cast<float>(y) + 0.5f) / static_cast<float>(height_));
            const vec3 dir = directionFromLatLong(uv);
            const float turned = water.phase(glm::dot(scene.sun.toSunWater, dir));
            const float above = dir.y > 0.001f ? -camera.y / dir.y : 1e9f;
            const float wanted = furthest(x, y, step);
            const float jitter = unitFrom(hash(static_cast<uint32_t>(x), static_cast<uint32_t>(y), 77));
            vec3 sum(0), through(1);
            vec3* out = cells_.data() + (static_cast<size_t>(y) * width_ + x) * kSlices;
            float from = 0;
            for (int i = 0; i < kSlices; ++i) {
                const float to = edge(i + 1),
                            length = from > wanted ? 0.0f : std::max(std::min(to, above) - from, 0.0f);
                if (length > 0) {
                    // A ray near the sun's direction stays within one beam: sample the whole cell there.
                    const bool beams = i > 6 && turned > 0.25f;
                    const int parts = beams ? 8 : i <= 6 || i > 20 ? 1 : scene.lamps.empty() ? 2 : 4;
                    vec3 source(0);
                    for (int k = 0; k < parts; ++k) {
                        const vec3 aside =
                            beams ? kSpread[k] * (9.0f / static_cast<float>(kFinest)) : vec3(0);
                        const vec3 p =
                            camera +
                            (dir + aside) * (from + length * (static_cast<float>(k) + 0.15f + 0.7f * jitter) /
                                                        static_cast<float>(parts));
                        const float lit = world.sunlit(p);
                        if (lit > 0) source += sunAtDepth(scene, -p.y) * (lit * turned * caustics.at(p));
                        source += world.ambient(p);
                        for (const Lamps::Arriving& light : world.lamps().at(p))
                            source += light.irradiance * water.phase(glm::dot(light.toLamp, dir));
                    }
                    const vec3 passed = water.transmittance(length);
                    sum += through * (1.0f - passed) * water.scattered * source / static_cast<float>(parts);
                    through *= passed;
                }
                from = to;
                for (int s = 0; s < step; ++s) out[s * kSlices + i] = sum;
            }
        }
    }
    smooth();
}

// Smooths by weights 1 2 1 along rows and columns. The jittered starts of the march leave noise, which would
// look like an encoder's blocks in even water.
void Veil::smooth() {
    std::vector<vec3> was;
    for (const bool alongRows : {true, false}) {
        was = cells_;
#pragma omp parallel for schedule(static)
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                const auto from = [&](int step) {
                    const int i = alongRows ? (x + step) & (width_ - 1) : x,
                              j = alongRows ? y : std::clamp(y + step, 0, height_ - 1);
                    return was.data() + (static_cast<size_t>(j) * width_ + i) * kSlices;
                };
                const vec3 *a = from(-1), *b = from(0), *c = from(1);
                vec3* to = cells_.data() + (static_cast<size_t>(y) * width_ + x) * kSlices;
                for (int slice = 0; slice < kSlices; ++slice)
                    to[slice] = 0.25f * (a[slice] + c[slice]) + 0.5f * b[slice];
            }
    }
}

vec3 Veil::at(const vec2& uv, float distance) const {
    const vec2 p = uv * vec2(width_, height_) - 0.5f, base = glm::floor(p), f = p - base;
    const int x0 = (static_cast<int>(base.x) + width_) & (width_ - 1), x1 = (x0 + 1) & (width_ - 1);
    const int y0 = std::clamp(static_cast<int>(base.y), 0, height_ - 1),
              y1 = std::min(static_cast<int>(base.y) + 1, height_ - 1);
    const float slice =
        std::clamp(std::log(distance * kFirst / kNearest + 1) / kRatio - 1, -1.0f, kSlices - 1.001f);
    const float floorSlice = std::floor(slice), g = slice - floorSlice;
    const int s = static_cast<int>(floorSlice);
    const auto look = [&](int x, int y) {
        const vec3* cell = cells_.data() + (static_cast<size_t>(y) * width_ + x) * kSlices;
        return s < 0 ? cell[0] * g : cell[s] * (1 - g) + cell[s + 1] * g;
    };
    return (look(x0, y0) * (1 - f.x) + look(x1, y0) * f.x) * (1 - f.y) +
           (look(x0, y1) * (1 - f.x) + look(x1, y1) * f.x) * f.y;
}

} // namespace shoal::reef
