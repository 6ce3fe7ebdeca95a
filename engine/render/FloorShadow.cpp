#include "engine/render/FloorShadow.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace shoal::render {

namespace {

constexpr int kMaxCells = 32;        // along a patch
constexpr float kMinTangent = 0.01f; // a sun's disc

// The share of a disc of radius 1 before a line at t.
float discBefore(float t) {
    if (t <= -1) return 0;
    if (t >= 1) return 1;
    return 0.5f + (t * std::sqrt(1 - t * t) + std::asin(t)) / std::numbers::pi_v<float>;
}

constexpr int kSlices = 8;       // along a body
constexpr size_t kMaxParts = 32; // ellipsoids of a body that cast

// Where a line across the silhouettes meets some; depth: of their middle, towards the light.
struct Chord {
    float low = 0, high = 0, depth = 0;
};

float tangentOf(const FloorLight& light) { return std::max(light.tangent, kMinTangent); }

// An ellipsoid's silhouette on the plane at right angles to the way to the light: an ellipse.
struct Silhouette {
    glm::vec3 centre{0};          // x and y on the plane, z towards the light
    float xx = 0, xy = 0, yy = 0; // its symmetric matrix, whose eigenvalues are its semi-axes squared
    float xz = 0;                 // the ellipsoid's own: how its middle rises along x

    // What a line of constant x meets.
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

// The direction between right and up in which the silhouettes extend furthest: of their second moments.
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

float FloorLight::raised() const {
    const float level = std::sqrt(std::max(0.0f, 1 - towards.y * towards.y));
    return glm::smoothstep(0.3f, 0.5f, towards.y - tangent * level);
}

void flatten(std::span<const occlusion::Ellipsoid> body, const FloorLight& light,
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
    const float slice = (high - low) / kSlices;
    if (!(slice > 1e-6f)) return;
    std::array<Chord, kMaxParts> chords;
    for (int k = 0; k < kSlices; ++k) {
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

float covered(std::span<const FlatPiece> body, const FloorLight& light, const glm::vec2& groundXz) {
    const glm::vec3 place(groundXz.x, light.height_m, groundXz.y);
    const float tangent = tangentOf(light);
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

FloorPatch patchOf(std::span<const FlatPiece> body, const FloorLight& light, float minimum) {
    FloorPatch patch{glm::vec2(1e9f), glm::vec2(-1e9f)};
    const glm::vec3& towards = light.towards;
    const float tangent = tangentOf(light);
    const float level = std::sqrt(std::max(0.0f, 1 - towards.y * towards.y));
    const float rise = towards.y - tangent * level;
    if (rise < 0.1f) return patch;
    float cell = 1e9f, hidden = 0;
    for (const FlatPiece& piece : body) {
        const float away = (piece.middle.y - light.height_m) / towards.y;
        if (away <= 0) continue;
        const float disc = tangent * away;
        // Places farther off see the body farther off, and the disc there larger.
        const auto onGround = [&](const glm::vec3& across) {
            return glm::abs(glm::vec2(across.x, across.z) -
                            glm::vec2(towards.x, towards.z) * (across.y / towards.y));
        };
        const glm::vec2 reach = ((piece.halfAlong_m + disc) * onGround(piece.along) +
                                 (piece.halfAside_m + disc) * onGround(piece.aside)) *
                                (towards.y / rise);
        const glm::vec2 under(piece.middle.x - towards.x * away, piece.middle.z - towards.z * away);
        patch.low = glm::min(patch.low, under - reach);
        patch.high = glm::max(patch.high, under + reach);
        cell = std::min(cell, 0.35f * (disc + piece.halfAside_m));
        // At most: its area on the disc's, where the product of strips is densest.
        const float flat = 4 * piece.halfAlong_m * piece.halfAside_m;
        hidden += std::min(1.0f, flat * 1.27f / (std::numbers::pi_v<float> * disc * disc));
    }
    if (patch.low.x > patch.high.x) return patch;
    const float taken = std::min(hidden, 1.0f) * std::max({light.share.x, light.share.y, light.share.z});
    if (taken <= minimum) return patch;
    patch.strength = glm::smoothstep(minimum, 2 * minimum, taken);
    const glm::vec2 extent = patch.high - patch.low;
    const auto cells = [&](float metres) {
        return std::clamp(static_cast<int>(std::ceil(metres / std::max(cell, 0.03f))), 2, kMaxCells);
    };
    patch.across = cells(extent.x);
    patch.down = cells(extent.y);
    return patch;
}

} // namespace shoal::render
