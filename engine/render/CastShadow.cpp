#include "engine/render/CastShadow.h"

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <optional>

namespace shoal::render {

namespace {

constexpr size_t kMaxParts = 32; // greatest number of a body's ellipsoids that cast shadows

// A part of a line that lies within one or more silhouettes; depth: that of its middle, towards the light.
struct Chord {
    float low = 0, high = 0, depth = 0;
};

// An ellipsoid's silhouette on the plane at right angles to the way to the light: an ellipse.
struct Silhouette {
    glm::vec3 centre{0};          // x and y on the plane, z towards the light
    float xx = 0, xy = 0, yy = 0; // symmetric matrix; its eigenvalues are the squared semi-axes
    float xz = 0;                 // element of the ellipsoid's matrix: how its middle rises along x

    // Returns the part of a line of constant x that lies within the ellipse.
    std::optional<Chord> chordAt(float x) const {
        const float from = x - centre.x, left = 1 - from * from / xx;
        if (!(left > 0)) return {};
        const float middle = centre.y + xy / xx * from,
                    half = std::sqrt(std::max(yy - xy * xy / xx, 0.0f) * left);
        return Chord{middle - half, middle + half, centre.z + xz / xx * from};
    }
};

Silhouette silhouetteOf(const occlusion::Ellipsoid& shape, const glm::vec3& x, const glm::vec3& y) {
    const glm::mat3 planeFromWorld = glm::transpose(glm::mat3(x, y, glm::cross(x, y)));
    Silhouette seen{planeFromWorld * shape.centre};
    for (int k = 0; k < 3; ++k) {
        const glm::vec3 axis = planeFromWorld * (shape.worldFromAxes[k] * shape.semiAxes[k]);
        seen.xx += axis.x * axis.x, seen.xy += axis.x * axis.y, seen.yy += axis.y * axis.y;
        seen.xz += axis.x * axis.z;
    }
    return seen;
}

// Returns the direction between right and up in which the silhouettes extend farthest, by second moments.
glm::vec3 longestAxis(std::span<const occlusion::Ellipsoid> body, const glm::vec3& right,
                      const glm::vec3& up) {
    glm::vec2 middle(0);
    float all = 0, xx = 0, xy = 0, yy = 0;
    const auto each = [&](const auto& visit) {
        for (const occlusion::Ellipsoid& shape : body) {
            const Silhouette seen = silhouetteOf(shape, right, up);
            visit(seen, std::sqrt(std::max(seen.xx * seen.yy - seen.xy * seen.xy, 0.0f)));
        }
    };
    each([&](const Silhouette& seen, float area) { middle += area * glm::vec2(seen.centre), all += area; });
    if (!(all > 0)) return right;
    middle /= all;
    each([&](const Silhouette& seen, float area) {
        const glm::vec2 off = glm::vec2(seen.centre) - middle;
        xx += area * (off.x * off.x + seen.xx / 4);
        xy += area * (off.x * off.y + seen.xy / 4);
        yy += area * (off.y * off.y + seen.yy / 4);
    });
    const float angle = 0.5f * std::atan2(2 * xy, xx - yy);
    return std::cos(angle) * right + std::sin(angle) * up;
}

} // namespace

float CastingLight::raised() const {
    const float level = std::sqrt(std::max(0.0f, 1 - towards.y * towards.y));
    return glm::smoothstep(0.3f, 0.5f, towards.y - tangent * level);
}

// Level ground receives s E from this light and (1 - s) E from other light. Another surface receives s E k
// from this light, where k is the ratio of the cosines.
glm::vec3 CastingLight::shareAt(float cosine) const {
    if (!(towards.y > 0)) return glm::vec3(0);
    const glm::vec3 given = share * (std::max(cosine, 0.0f) / towards.y);
    return given / glm::max(given + 1.0f - share, 1e-6f);
}

CastingLight castingLight(const light::ShadowLight& found, const glm::mat3& worldFromEnv) {
    constexpr float kWidest = 0.75f; // radians; limit of the light's angular radius
    CastingLight light{worldFromEnv * found.light.direction, std::tan(std::min(found.light.radius, kWidest))};
    const glm::vec3 all = glm::max(found.groundIrradiance, 1e-6f);
    light.share = glm::clamp(found.light.irradiance * std::max(light.towards.y, 0.0f) / all, 0.0f, 1.0f);
    light.presence = found.presence * light.raised();
    return light;
}

CastingLight restBeside(const CastingLight& light) {
    return {.towards = {0, 1, 0}, .tangent = 1, .share = 1.0f - light.presence * light.share};
}

void flatten(std::span<const occlusion::Ellipsoid> body, const CastingLight& light,
             std::vector<FlatPiece>& out) {
    out.clear();
    const glm::vec3& towards = light.towards;
    const glm::vec3 right = glm::normalize(
        glm::cross(towards, std::abs(towards.x) < 0.8f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1)));
    const glm::vec3 along = longestAxis(body, right, glm::cross(towards, right));
    const glm::vec3 aside = glm::cross(towards, along);
    std::array<Silhouette, kMaxParts> seen;
    const size_t count = std::min(body.size(), seen.size());
    float low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; ++i) {
        seen[i] = silhouetteOf(body[i], along, aside);
        low = std::min(low, seen[i].centre.x - std::sqrt(seen[i].xx));
        high = std::max(high, seen[i].centre.x + std::sqrt(seen[i].xx));
    }
    const int slices = light.isWide() ? 2 : 8;
    const float slice = (high - low) / static_cast<float>(slices);
    if (!(slice > 1e-6f)) return;
    std::array<Chord, kMaxParts> chords;
    for (int k = 0; k < slices; ++k) {
        const float x = low + (static_cast<float>(k) + 0.5f) * slice;
        size_t met = 0;
        for (size_t i = 0; i < count; ++i)
            if (const auto chord = seen[i].chordAt(x)) chords[met++] = *chord;
        std::sort(chords.begin(), chords.begin() + met,
                  [](const Chord& a, const Chord& b) { return a.low < b.low; });
        for (size_t i = 0; i < met;) {
            Chord all = chords[i++];
            for (; i < met && chords[i].low <= all.high; ++i) {
                all.high = std::max(all.high, chords[i].high);
                all.depth = std::max(all.depth, chords[i].depth); // the nearer to the light hides more
            }
            out.push_back({x * along + 0.5f * (all.low + all.high) * aside + all.depth * towards, along,
                           aside, slice / 2, (all.high - all.low) / 2});
        }
    }
}

float covered(std::span<const FlatPiece> body, const CastingLight& light, const glm::vec3& place) {
    const float tangent = light.discTangent();
    float hidden = 0;
    for (const FlatPiece& piece : body) {
        const glm::vec3 to = piece.middle - place;
        const float disc = tangent * glm::dot(to, light.towards);
        if (disc <= 0) continue;
        const float along = glm::dot(to, piece.along), aside = glm::dot(to, piece.aside);
        if (std::abs(along) >= piece.halfAlong_m + disc || std::abs(aside) >= piece.halfAside_m + disc)
            continue;
        hidden +=
            (discBefore((along + piece.halfAlong_m) / disc) -
             discBefore((along - piece.halfAlong_m) / disc)) *
            (discBefore((aside + piece.halfAside_m) / disc) - discBefore((aside - piece.halfAside_m) / disc));
    }
    return std::min(hidden, 1.0f);
}

// The ray goes on behind a depth edge of the film, where nothing is known. A ray that begins inside the
// surface, for example at a hand that touches it, meets the surface at once.
float fallOf(const FilmSurface& film, const glm::vec3& placeWorld, const CastingLight& light) {
    constexpr float kHit_m = 0.004f; // gap that counts as a hit: less than the map's steps from 0.8 m on
    constexpr float kMinStep_m = 0.1f, kMaxStep_m = 0.5f;
    constexpr float kTouch_m = 0.3f; // greatest depth inside a surface at which a ray begins on it
    // At an edge the gap changes by more than this per metre of ray, as on a surface seen at 4 degrees.
    constexpr float kEdge = 16;
    constexpr int kHalvings = 10;
    const glm::vec3 from = film.envFromWorld * (placeWorld - film.cameraWorld);
    const glm::vec3 dir = film.envFromWorld * -light.towards;
    // Returns by how many metres the surface lies behind the point at s, seen from the film's camera.
    const auto gapAt = [&](float s) {
        const glm::vec3 place = from + s * dir;
        const float distance = glm::length(place);
        return distance > 1e-4f ? 1 / film.map->inverse_perM(place / distance) - distance : INFINITY;
    };
    float before = 0, gapBefore = gapAt(0);
    if (gapBefore <= 0 && gapBefore > -kTouch_m) return 0;
    while (before < kShadowReach_m) {
        float low = before, high = before + std::clamp(0.5f * gapBefore, kMinStep_m, kMaxStep_m);
        float gapLow = gapBefore, gapHigh = gapAt(high);
        before = high, gapBefore = gapHigh;
        if (!(gapLow > 0 && gapHigh <= 0)) continue;
        // False position, which finds a smooth surface at once, takes turns with halving, which finds an edge
        // and the border of what is known.
        for (int k = 0; k < kHalvings; ++k) {
            const float part = k % 2 == 0 && std::isfinite(gapLow) ? gapLow / (gapLow - gapHigh) : 0.5f;
            const float middle = low + part * (high - low), gap = gapAt(middle);
            if (std::abs(gap) < kHit_m) return middle;
            (gap > 0 ? low : high) = middle;
            (gap > 0 ? gapLow : gapHigh) = gap;
        }
        if (gapLow - gapHigh < kEdge * (high - low)) return low + (high - low) * gapLow / (gapLow - gapHigh);
    }
    return -1;
}

} // namespace shoal::render
