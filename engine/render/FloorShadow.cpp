#include "engine/render/FloorShadow.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::render {

namespace {

constexpr int kMostCells = 32;         // along a patch
constexpr float kLeastTangent = 0.01f; // a sun's disc

// The share of a disc of radius 1 before a line at t.
float discBefore(float t) {
    if (t <= -1) return 0;
    if (t >= 1) return 1;
    return 0.5f + (t * std::sqrt(1 - t * t) + std::asin(t)) / std::numbers::pi_v<float>;
}

float tangentOf(const FloorLight& light) { return std::max(light.tangent, kLeastTangent); }

float sizeOf(const CastingPiece& piece) { return std::max(glm::length(piece.across), glm::length(piece.up)); }

} // namespace

float FloorLight::raised() const {
    const float level = std::sqrt(std::max(0.0f, 1 - towards.y * towards.y));
    return glm::smoothstep(0.3f, 0.5f, towards.y - tangent * level);
}

void flatten(std::span<const CastingPiece> body, const FloorLight& light, std::vector<FlatPiece>& out) {
    out.clear();
    for (const CastingPiece& piece : body) {
        const glm::vec3 way = piece.to - piece.from;
        const glm::vec3 flat = way - glm::dot(way, light.towards) * light.towards;
        const float length = glm::length(flat);
        if (length < 1e-6f) continue;
        const glm::vec3 along = flat / length, aside = glm::cross(light.towards, along);
        out.push_back({piece.from, piece.from + 0.5f * way, along, aside, length,
                       std::hypot(glm::dot(piece.across, aside), glm::dot(piece.up, aside))});
    }
}

float covered(std::span<const FlatPiece> body, const FloorLight& light, const glm::vec2& groundXz) {
    const glm::vec3 place(groundXz.x, light.height_m, groundXz.y);
    const float tangent = tangentOf(light);
    float sum = 0;
    for (const FlatPiece& piece : body) {
        const float disc = tangent * glm::dot(piece.middle - place, light.towards);
        if (disc <= 0) continue;
        const glm::vec3 from = piece.from - place;
        const float aside = glm::dot(from, piece.aside), begin = glm::dot(from, piece.along),
                    end = begin + piece.length_m;
        if (std::abs(aside) >= piece.half_m + disc || begin >= disc || end <= -disc) continue;
        sum += (discBefore(end / disc) - discBefore(begin / disc)) *
               (discBefore((aside + piece.half_m) / disc) - discBefore((aside - piece.half_m) / disc));
    }
    return std::min(sum, 1.0f);
}

FloorPatch patchOf(std::span<const CastingPiece> body, const FloorLight& light, float least) {
    FloorPatch patch{glm::vec2(1e9f), glm::vec2(-1e9f)};
    const glm::vec3& towards = light.towards;
    const float tangent = tangentOf(light);
    const float level = std::sqrt(std::max(0.0f, 1 - towards.y * towards.y));
    const float rise = towards.y - tangent * level;
    if (rise < 0.1f) return patch;
    float cell = 1e9f, hidden = 0;
    for (const CastingPiece& piece : body) {
        const float size = sizeOf(piece);
        float disc = 0;
        bool above = false;
        for (const glm::vec3& end : {piece.from, piece.to}) {
            const float away = (end.y - light.height_m) / towards.y;
            if (away <= 0) continue;
            above = true;
            disc = std::max(disc, tangent * away);
            // Places farther off see the end farther off, and the disc there larger.
            const float reach = (size + tangent * away) / rise;
            const glm::vec2 under(end.x - towards.x * away, end.z - towards.z * away);
            patch.low = glm::min(patch.low, under - reach);
            patch.high = glm::max(patch.high, under + reach);
        }
        if (!above) continue;
        cell = std::min(cell, 0.35f * (disc + 0.5f * size));
        // At most: its area on the disc's, where the product of strips is densest.
        const float flat = 2 * size * glm::length(piece.to - piece.from);
        hidden += disc > 0 ? std::min(1.0f, flat * 1.27f / (std::numbers::pi_v<float> * disc * disc)) : 1.0f;
    }
    const float taken = std::min(hidden, 1.0f) * std::max({light.share.x, light.share.y, light.share.z});
    if (taken <= least) return patch;
    patch.strength = glm::smoothstep(least, 2 * least, taken);
    const glm::vec2 extent = patch.high - patch.low;
    const auto cells = [&](float metres) {
        return std::clamp(static_cast<int>(std::ceil(metres / std::max(cell, 0.03f))), 2, kMostCells);
    };
    patch.across = cells(extent.x);
    patch.down = cells(extent.y);
    return patch;
}

} // namespace shoal::render
