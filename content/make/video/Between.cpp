// What is quick once a frame is drawn: the time between two, and the snow.
#include "content/make/video/Frame.h"

#include "content/make/video/Light.h"
#include "engine/math/LatLong.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::reef {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Beyond it neighbouring frames' parallax is a fraction of a pixel.
constexpr float kStill = 12;

struct Seen {
    vec3 radiance{0};
    float mismatch = 0; // of the distance found from that expected, relative
};

// What `drawn` holds of the point at `metres` from `camera` along dir.
Seen seen(const Drawn& drawn, const vec3& camera, const vec3& dir, float metres) {
    const int width = drawn.radianceLin.width, height = drawn.radianceLin.height;
    const vec3 d = camera + dir * metres - drawn.camera;
    const float away = glm::length(d);
    const vec2 p = latLongFromDirection(d / away) * vec2(width, height) - 0.5f, base = glm::floor(p),
               f = p - base;
    const int x0 = (static_cast<int>(base.x) + width) % width, x1 = (x0 + 1) % width;
    const int y0 = std::clamp(static_cast<int>(base.y), 0, height - 1), y1 = std::min(y0 + 1, height - 1);
    const auto look = [&](int x, int y) {
        const float* c = drawn.radianceLin.at(x, y);
        return vec3(c[0], c[1], c[2]);
    };
    const float found =
        drawn.distance[static_cast<size_t>((f.y < 0.5f ? y0 : y1) * width + (f.x < 0.5f ? x0 : x1))];
    return {(look(x0, y0) * (1 - f.x) + look(x1, y0) * f.x) * (1 - f.y) +
                (look(x0, y1) * (1 - f.x) + look(x1, y1) * f.x) * f.y,
            std::fabs(found - away) / away};
}

} // namespace

Drawn Filming::between(const Drawn& a, const Drawn& b, float share, float turn) const {
    const int width = a.radianceLin.width, height = a.radianceLin.height;
    Drawn out{ImageRgbF(width, height), share < 0.5f ? a.distance : b.distance, route_.at(turn)};
#pragma omp parallel for schedule(static)
    for (int y = 0; y < height; ++y) {
        const float latitude = (0.5f - (static_cast<float>(y) + 0.5f) / static_cast<float>(height)) * kPi;
        for (int x = 0; x < width; ++x) {
            const size_t i = static_cast<size_t>(y * width + x);
            const float *from = a.radianceLin.at(x, y), *to = b.radianceLin.at(x, y);
            float* into = out.radianceLin.at(x, y);
            if (a.distance[i] > kStill && b.distance[i] > kStill) {
                for (int c = 0; c < 3; ++c) into[c] = from[c] * (1 - share) + to[c] * share;
                continue;
            }
            const float longitude =
                            ((static_cast<float>(x) + 0.5f) / static_cast<float>(width) - 0.5f) * 2 * kPi,
                        ring = std::cos(latitude);
            const vec3 dir(ring * std::sin(longitude), std::sin(latitude), -ring * std::cos(longitude));
            const float metres = share < 0.5f ? a.distance[i] : b.distance[i];
            const Seen first = seen(a, out.camera, dir, metres), second = seen(b, out.camera, dir, metres);
            const float wa = (1 - share) / (0.03f + first.mismatch), wb = share / (0.03f + second.mismatch);
            const vec3 mixed = (first.radiance * wa + second.radiance * wb) / (wa + wb);
            for (int c = 0; c < 3; ++c) into[c] = mixed[c];
        }
    }
    return out;
}

// Specks that drift in a box around the camera which repeats in space, so that there are always as many. Each
// is a soft spot of its own size; the near ones are out of focus and faint.
void Filming::addSnow(Drawn& drawn, float turn) const {
    ImageRgbF& image = drawn.radianceLin;
    constexpr float kBox = 5;
    const int width = image.width, height = image.height;
    for (uint32_t i = 0; i < static_cast<uint32_t>(scene_.camera.snow); ++i) {
        const auto chance = [&](uint32_t k) { return unitFrom(hash(i, k, 991)); };
        const auto swing = [&](uint32_t k) {
            return std::sin(2 * kPi * (std::floor(2 + 9 * chance(k)) * turn + chance(k + 1)));
        };
        vec3 p = vec3(chance(0), chance(1), chance(2)) * kBox;
        p += vec3(0.10f * swing(10), 0.05f * swing(12), 0.10f * swing(14)) +
             vec3(0.05f * std::sin(2 * kPi * 11 * turn), 0, 0.03f * std::sin(2 * kPi * 11 * turn));
        vec3 d = p - drawn.camera;
        d -= kBox * glm::floor(d / kBox + 0.5f);
        const float away = glm::length(d);
        if (away < 0.12f || away > 0.5f * kBox) continue;
        const vec2 uv = latLongFromDirection(d / away);
        const float cx = uv.x * static_cast<float>(width), cy = uv.y * static_cast<float>(height);
        const float pixel = kPi / static_cast<float>(height);
        const float size = 0.0004f + 0.0011f * chance(4) * chance(5) * chance(5); // metres
        const float blur = 0.55f * pixel + 0.0007f / away,
                    radius = std::sqrt(size * size / (away * away) + blur * blur); // radians
        const vec3 at = drawn.camera + d;
        const vec3 light =
            sunAtDepth(scene_, -at.y) *
                (world_.sunlit(at) *
                 (0.10f + 0.6f * scene_.water.phase(glm::dot(d / away, scene_.sun.toSunWater)))) +
            world_.ambient(at) * 0.9f;
        const float strength = 0.75f * std::min(size * size / (away * away) / (radius * radius), 1.0f) *
                               std::min(1.0f, (0.5f * kBox - away) * 1.5f);
        if (strength < 0.002f) continue;
        const float ring = std::max(std::cos((0.5f - uv.y) * kPi), 0.03f), spread = radius / pixel;
        const int wide = static_cast<int>(2.5f * spread / ring) + 1,
                  high = static_cast<int>(2.5f * spread) + 1;
        for (int y = std::max(0, static_cast<int>(cy) - high);
             y <= std::min(height - 1, static_cast<int>(cy) + high); ++y)
            for (int x = static_cast<int>(cx) - wide; x <= static_cast<int>(cx) + wide; ++x) {
                const int column = ((x % width) + width) % width;
                if (drawn.distance[static_cast<size_t>(y * width + column)] < away) continue;
                const float dx = (static_cast<float>(x) + 0.5f - cx) * ring / spread,
                            dy = (static_cast<float>(y) + 0.5f - cy) / spread;
                const float cover = strength * std::exp(-(dx * dx + dy * dy));
                float* c = image.at(column, y);
                for (int k = 0; k < 3; ++k) c[k] += cover * (0.7f * light[k] - 0.35f * c[k]);
            }
    }
}

} // namespace shoal::reef
