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

// Where `drawn` has the point at `metres` from `camera` along dir: pixels, and the distance it should have
// there.
struct Place {
    vec2 pixel{0};
    float away = 0;
};

Place placeIn(const Drawn& drawn, const vec3& camera, const vec3& dir, float metres) {
    const vec3 d = camera + dir * metres - drawn.camera;
    const float away = glm::length(d);
    return {latLongFromDirection(d / away) * vec2(drawn.radianceLin.width, drawn.radianceLin.height) - 0.5f,
            away};
}

struct Seen {
    vec3 radiance{0};
    float mismatch = 0; // of the distance found from that expected, relative
};

Seen seen(const Drawn& drawn, const vec2& pixel, float away) {
    const int width = drawn.radianceLin.width, height = drawn.radianceLin.height;
    const vec2 base = glm::floor(pixel), f = pixel - base;
    const int x0 = (static_cast<int>(base.x) + width) % width, x1 = (x0 + 1) % width;
    const int y0 = std::clamp(static_cast<int>(base.y), 0, height - 1), y1 = std::min(y0 + 1, height - 1);
    const float w[4] = {(1 - f.x) * (1 - f.y), f.x * (1 - f.y), (1 - f.x) * f.y, f.x * f.y};
    const int at[4] = {y0 * width + x0, y0 * width + x1, y1 * width + x0, y1 * width + x1};
    Seen out;
    for (int i = 0; i < 4; ++i) {
        const float* c = drawn.radianceLin.pixels.data() + 3 * at[i];
        out.radiance += w[i] * vec3(c[0], c[1], c[2]);
    }
    const float found = drawn.distance[static_cast<size_t>(at[(f.y < 0.5f ? 0 : 2) + (f.x < 0.5f ? 0 : 1)])];
    out.mismatch = std::fabs(found - away) / away;
    return out;
}

} // namespace

// Four neighbours go together: where one of them lies is found, the others lie beside it.
Drawn Filming::between(const Drawn& a, const Drawn& b, float share, float turn) const {
    const int width = a.radianceLin.width, height = a.radianceLin.height;
    Drawn out{ImageRgbF(width, height), share < 0.5f ? a.distance : b.distance, route_.at(turn)};
#pragma omp parallel for schedule(static)
    for (int y = 0; y < height; y += 2)
        for (int x = 0; x < width; x += 2) {
            const auto index = [&](int part) { return (y + part / 2) * width + x + part % 2; };
            float metres = 1e9f;
            for (int part = 0; part < 4; ++part)
                metres = std::min(metres, out.distance[static_cast<size_t>(index(part))]);
            const vec2 middle(static_cast<float>(x) + 1, static_cast<float>(y) + 1);
            Place first{middle - 0.5f, metres}, second = first;
            if (metres < kStill) {
                const vec3 dir = directionFromLatLong(middle / vec2(width, height));
                first = placeIn(a, out.camera, dir, metres);
                second = placeIn(b, out.camera, dir, metres);
            }
            for (int part = 0; part < 4; ++part) {
                const vec2 beside(static_cast<float>(part % 2) - 0.5f, static_cast<float>(part / 2) - 0.5f);
                const Seen from = seen(a, first.pixel + beside, first.away),
                           to = seen(b, second.pixel + beside, second.away);
                const float wa = (1 - share) / (0.03f + from.mismatch), wb = share / (0.03f + to.mismatch);
                const vec3 mixed = (from.radiance * wa + to.radiance * wb) / (wa + wb);
                for (int c = 0; c < 3; ++c)
                    out.radianceLin.pixels[static_cast<size_t>(3 * index(part) + c)] = mixed[c];
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
