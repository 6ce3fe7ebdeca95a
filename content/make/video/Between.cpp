// The quick steps after frames are traced: frames between two traced ones, marine snow and plankton.
#include "content/make/video/Frame.h"

#include "content/make/video/Light.h"
#include "engine/math/LatLong.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::reef {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Distance in metres beyond which the parallax between neighbouring frames is a fraction of a pixel.
constexpr float kStill = 12;

// Position of a point in `drawn`: its pixel, and the distance that it should have there. The point lies
// `metres` from `camera` along dir.
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
    float mismatch = 0; // relative difference of the distance found from the expected one
};

// Catmull and Rom's cubic weights. Bilinear weights would blur whatever moves by half a pixel.
vec4 cubicWeights(float f) {
    return {f * (-0.5f + f * (1 - 0.5f * f)), 1 + f * f * (-2.5f + 1.5f * f), f * (0.5f + f * (2 - 1.5f * f)),
            f * f * (-0.5f + 0.5f * f)};
}

Seen seen(const Drawn& drawn, const vec2& pixel, float away) {
    const int width = drawn.radianceLin.width, height = drawn.radianceLin.height;
    const vec2 base = glm::floor(pixel), f = pixel - base;
    const vec4 wx = cubicWeights(f.x), wy = cubicWeights(f.y);
    int columns[4], rows[4];
    for (int i = 0; i < 4; ++i) {
        columns[i] = (static_cast<int>(base.x) + i - 1 + width) % width;
        rows[i] = std::clamp(static_cast<int>(base.y) + i - 1, 0, height - 1);
    }
    vec3 sum(0), low(1e9f), high(0);
    for (int j = 0; j < 4; ++j) {
        vec3 along(0);
        for (int i = 0; i < 4; ++i) {
            const float* c =
                drawn.radianceLin.pixels.data() + 3 * (static_cast<ptrdiff_t>(rows[j]) * width + columns[i]);
            const vec3 here(c[0], c[1], c[2]);
            along += wx[i] * here;
            if (i % 3 && j % 3) low = glm::min(low, here), high = glm::max(high, here);
        }
        sum += wy[j] * along;
    }
    const float found =
        drawn.distance[static_cast<size_t>(rows[f.y < 0.5f ? 1 : 2]) * width + columns[f.x < 0.5f ? 1 : 2]];
    return {glm::clamp(sum, low, high), std::fabs(found - away) / away};
}

} // namespace

// Reprojects blocks of 2 x 2 pixels: finds the place of their nearest point, and the others lie beside it.
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

namespace {

// Specks drift in a box that repeats in space around the camera, so that their number stays the same.
struct Speck {
    vec3 towards{0}; // unit
    float away = 0;  // metres
    float size = 0;  // metres, radius
};

Speck speck(uint32_t number, uint32_t kind, float box, const vec3& camera, float turn) {
    const auto chance = [&](uint32_t k) { return unitFrom(hash(number, k, kind)); };
    const auto swing = [&](uint32_t k) {
        return std::sin(2 * kPi * (std::floor(2 + 9 * chance(k)) * turn + chance(k + 1)));
    };
    vec3 p = vec3(chance(0), chance(1), chance(2)) * box;
    p += vec3(0.10f * swing(10), 0.05f * swing(12), 0.10f * swing(14)) +
         vec3(0.05f * std::sin(2 * kPi * 11 * turn), 0, 0.03f * std::sin(2 * kPi * 11 * turn));
    vec3 d = p - camera;
    d -= box * glm::floor(d / box + 0.5f);
    const float away = glm::length(d);
    return {d / away, away, 0.0004f + 0.0011f * chance(4) * chance(5) * chance(5)};
}

// Draws a speck as a soft spot. radius: radians; cover: coverage in the spot's middle, by which `light` is
// added and the picture behind is reduced to the share `kept`.
void addSpot(Drawn& drawn, const Speck& speck, float radius, float cover, const vec3& light, float kept) {
    ImageRgbF& image = drawn.radianceLin;
    const int width = image.width, height = image.height;
    const vec2 uv = latLongFromDirection(speck.towards);
    const float cx = uv.x * static_cast<float>(width), cy = uv.y * static_cast<float>(height);
    const float ring = std::max(std::cos((0.5f - uv.y) * kPi), 0.03f),
                spread = radius * static_cast<float>(height) / kPi;
    const int wide = static_cast<int>(2.5f * spread / ring) + 1, high = static_cast<int>(2.5f * spread) + 1;
    for (int y = std::max(0, static_cast<int>(cy) - high);
         y <= std::min(height - 1, static_cast<int>(cy) + high); ++y)
        for (int x = static_cast<int>(cx) - wide; x <= static_cast<int>(cx) + wide; ++x) {
            const int column = ((x % width) + width) % width;
            if (drawn.distance[static_cast<size_t>(y * width + column)] < speck.away) continue;
            const float dx = (static_cast<float>(x) + 0.5f - cx) * ring / spread,
                        dy = (static_cast<float>(y) + 0.5f - cy) / spread;
            const float here = cover * std::exp(-(dx * dx + dy * dy));
            float* c = image.at(column, y);
            for (int k = 0; k < 3; ++k) c[k] += here * (light[k] - (1 - kept) * c[k]);
        }
}

} // namespace

void Filming::addSnow(Drawn& drawn, float turn) const {
    constexpr float kBox = 5;
    const float pixel = kPi / static_cast<float>(drawn.radianceLin.height);
    for (uint32_t i = 0; i < static_cast<uint32_t>(scene_.camera.snow); ++i) {
        const Speck mote = speck(i, 991, kBox, drawn.camera, turn);
        if (mote.away < 0.12f || mote.away > 0.5f * kBox) continue;
        const float blur = 0.55f * pixel + 0.0007f / mote.away, angle = mote.size / mote.away; // radians
        const float radius = std::sqrt(angle * angle + blur * blur);
        const float strength = 0.75f * std::min(angle * angle / (radius * radius), 1.0f) *
                               std::min(1.0f, (0.5f * kBox - mote.away) * 1.5f);
        if (strength < 0.002f) continue;
        const vec3 at = drawn.camera + mote.towards * mote.away;
        const auto turned = [&](const vec3& toLight) {
            return 0.10f + 0.6f * scene_.water.phase(glm::dot(mote.towards, toLight));
        };
        vec3 light = sunAtDepth(scene_, -at.y) * (world_.sunlit(at) * turned(scene_.sun.toSunWater)) +
                     world_.ambient(at) * 0.9f;
        for (const Lamps::Arriving& lamp : world_.lamps().at(at))
            light += lamp.irradiance * turned(lamp.toLamp);
        addSpot(drawn, mote, radius, strength, 0.7f * light, 0.65f);
    }
}

// Each speck of plankton flashes for about a third of a second, a few times in the film.
void Filming::addPlankton(Drawn& drawn, float turn) const {
    constexpr float kBox = 9;
    const float pixel = kPi / static_cast<float>(drawn.radianceLin.height);
    for (uint32_t i = 0; i < static_cast<uint32_t>(scene_.plankton.count); ++i) {
        const Speck mote = speck(i, 443, kBox, drawn.camera, turn);
        if (mote.away < 0.3f || mote.away > 0.5f * kBox) continue;
        const float phase =
            std::floor(3 + 5 * unitFrom(hash(i, 20, 443))) * turn + unitFrom(hash(i, 21, 443));
        const float flash = std::pow(0.5f + 0.5f * std::sin(2 * kPi * phase), 14.0f);
        if (flash < 0.02f) continue;
        const float blur = 0.7f * pixel + 0.0005f / mote.away, angle = 2 * mote.size / mote.away;
        const float radius = std::sqrt(angle * angle + blur * blur);
        const float strength = flash * std::min(1.0f, (0.5f * kBox - mote.away) * 0.8f) * (0.001f * 0.001f) /
                               (mote.away * mote.away * radius * radius);
        addSpot(drawn, mote, radius, 1,
                scene_.plankton.radiance * scene_.water.transmittance(mote.away) * strength, 1);
    }
}

} // namespace shoal::reef
