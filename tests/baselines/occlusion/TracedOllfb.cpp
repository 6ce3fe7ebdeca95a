#include "tests/baselines/occlusion/TracedOllfb.h"
#include "engine/occlusion/Directions.h"
#include "tests/baselines/occlusion/PixelWalk.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace shoal::occlusion {

namespace {

// The layers of one view.
struct OllfbPixels {
    const Ollfb& all;
    const OllfbView& view;

    // Layers of a pixel within the view's size.
    std::span<const OllfbLayer> layersOf(const glm::ivec2& pixel) const {
        const OllfbRow& row = all.rows[view.firstRow + pixel.y];
        if (pixel.x < row.begin || pixel.x >= row.end) return {};
        const uint16_t* const start = &all.starts[row.firstStart + (pixel.x - row.begin)];
        return std::span(all.layers).subspan(row.firstLayer + start[0], start[1] - start[0]);
    }
    // At the pixel's middle, pixels.
    float depthOf(const OllfbLayer& layer) const {
        return static_cast<float>(layer.depth) * (view.depthRange_px / 65535);
    }
    // Outwards, view frame.
    static glm::vec3 normalOf(const OllfbLayer& layer) { return unpackDirection(layer.normal, 8); }
};

struct OllfbSurface {
    float depth = 0;     // under the place, pixels
    glm::vec2 slope{0};  // depth per pixel
    glm::vec3 normal{0}; // unit, outwards, view frame
};

// Returns the surface near a place, pixels: the layers of the four pixels around it, blended. normal: what
// the surface's is about, view frame. None where no layer fits both.
//
// Two planes that touch a bent surface lie as far outside it between their middles as the chord between these
// lies inside: half the slope between them follows the bend.
std::optional<OllfbSurface> surfaceNear(const OllfbPixels& pixels, const glm::vec3& place,
                                        const glm::vec3& normal) {
    constexpr float kAlike = 0.5f; // cosine between normals of one surface
    const glm::ivec2& size = pixels.view.size;
    const glm::ivec2 corner(glm::floor(glm::vec2(place) - 0.5f));
    const glm::vec2 share = glm::vec2(place) - 0.5f - glm::vec2(corner);
    // Some pixels off the plane may still be it, the more the steeper.
    const float furthest =
        1 + 0.5f * glm::min(kSteepest, glm::length(glm::vec2(normal)) / std::abs(normal.z));
    OllfbSurface sum;
    float weightSum = 0, tiltSum = 0;
    int found = 0;
    for (int k = 0; k < 4; ++k) {
        const glm::ivec2 pixel = corner + glm::ivec2(k % 2, k / 2);
        if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.x || pixel.y >= size.y) continue;
        const glm::vec2 aside = glm::vec2(place) - (glm::vec2(pixel) + 0.5f);
        float nearest = furthest;
        OllfbSurface best;
        bool any = false;
        for (const OllfbLayer& layer : pixels.layersOf(pixel)) {
            const glm::vec3 other = OllfbPixels::normalOf(layer);
            const glm::vec2 slope = slopeOf(other);
            const float depth = pixels.depthOf(layer);
            const float off = std::abs(depth + glm::dot(slope, aside) - place.z);
            if (off > nearest || glm::dot(other, normal) < kAlike) continue;
            nearest = off, best = {depth, slope, other}, any = true;
        }
        if (!any) continue;
        const float weight = (k % 2 ? share.x : 1 - share.x) * (k / 2 ? share.y : 1 - share.y);
        sum.depth += weight * best.depth;
        sum.slope += weight * best.slope;
        sum.normal += weight * best.normal;
        tiltSum += weight * glm::dot(best.slope, aside);
        weightSum += weight;
        ++found;
    }
    if (weightSum <= 0.1f) return {};
    return OllfbSurface{(sum.depth + (found == 4 ? 0.5f : 1.0f) * tiltSum) / weightSum, sum.slope / weightSum,
                        glm::normalize(sum.normal)};
}

// Behind a surface that bounds no inside, its wall from one cell to the next is this thick.
constexpr float kSheet_px = 0.25f, kSheetPerSlope_px = 0.5f;
// A hit moves along its ray at most this far to where the surface is, and not at all if it hardly nears it.
constexpr float kFurthest_px = 3, kMinRate = 0.05f;
// Further behind a surface than planes lie beside what they stand for.
constexpr float kSunk_px = 0.5f;
constexpr float kNone = std::numeric_limits<float>::infinity();

// One view as a ray finds it.
struct Walk {
    OllfbPixels pixels;
    bool closed, onlyOuter;
    glm::vec3 from, along; // pixels
    bool forwards;         // depth grows along the ray
    float left;            // along the ray, pixels: from here on it may meet a surface from behind
    bool outside;          // whether it has been outside the body yet

    bool inside = false; // where the last cell was left
    bool dived = false;  // what it met is what it began on
    float metAt = 0;     // along the ray, pixels
    const OllfbLayer* met = nullptr;

    // Follows the ray from `in` to `out` through the part of a pixel whose layers have `bit`; true if it met
    // one.
    bool cross(std::span<const OllfbLayer> here, const glm::ivec2& pixel, unsigned bit, float in, float out,
               bool started) {
        const glm::vec3 pIn = from + in * along, pOut = from + out * along;
        const glm::vec2 middle = glm::vec2(pixel) + 0.5f;
        const glm::vec2 asideIn = glm::vec2(pIn) - middle, asideOut = glm::vec2(pOut) - middle;
        const float beyond = forwards ? pOut.z + kSteepest : pOut.z - kSteepest;
        // The surface passed last, where the ray comes in, and the next one.
        float passedIn = kNone, nextIn = kNone, at = kNone;
        const OllfbLayer *next = nullptr, *lastIn = nullptr, *hit = nullptr;
        // How many surfaces the ray is behind. Counted and not read from the last one: where a body thins out
        // at its silhouette, planes of its two sides may change places.
        int deepIn = 0, deepOut = 0;
        for (size_t i = 0; i < here.size(); ++i) {
            const OllfbLayer& layer = here[forwards ? i : here.size() - 1 - i];
            const float depth = pixels.depthOf(layer);
            if (forwards ? depth > beyond : depth < beyond) break; // all others lie further on
            if (!(layer.coverage & bit)) continue;
            const glm::vec3 normal = OllfbPixels::normalOf(layer);
            const glm::vec2 slope = slopeOf(normal);
            const float side = forwards ? 1.0f : -1.0f;
            const float fIn = side * (pIn.z - depth - glm::dot(slope, asideIn));
            const float fOut = side * (pOut.z - depth - glm::dot(slope, asideOut));
            const bool facing = forwards == (normal.z < 0);
            const float reach = closed ? kNone : kSheet_px + kSheetPerSlope_px * glm::length(slope);
            const bool ahead = fIn < 0 && fOut >= 0, aside = fIn > 0 && fOut <= 0;
            if (ahead || aside) {
                const float t = in + (out - in) * (fIn / (fIn - fOut));
                const bool enters = ahead == facing;
                if (t < at && (enters || (!onlyOuter && t > left))) at = t, hit = &layer;
            }
            const int deeper = facing || !onlyOuter ? 1 : -1;
            if (fIn >= 0 && fIn <= reach) deepIn += deeper;
            if (fOut >= 0 && fOut <= reach) deepOut += deeper;
            if (fIn >= 0 && fIn < passedIn) passedIn = fIn, lastIn = &layer;
            if (fIn < 0 && -fIn < nextIn) nextIn = -fIn, next = &layer;
        }
        outside = outside || deepIn <= 0;
        // A ray that has never been outside has not left the surface that it began on, but dived under it.
        dived = !outside && in > left && hasSunk(passedIn, lastIn);
        if (started && deepIn > 0 && (!inside || dived)) {
            met = next && nextIn < passedIn ? next : lastIn;
            metAt = dived ? left : in;
            return true;
        }
        if (hit) {
            met = hit, metAt = at;
            return true;
        }
        inside = deepOut > 0;
        return false;
    }

    // behind: pixels of depth.
    bool hasSunk(float behind, const OllfbLayer* surface) const {
        if (!closed || !onlyOuter || !surface) return false;
        const glm::vec2 slope = slopeOf(OllfbPixels::normalOf(*surface));
        return behind > kSunk_px * std::sqrt(1 + glm::dot(slope, slope));
    }
};

// Half of the octahedron, turned by 45 degrees to fill [-1, 1]^2. direction.z >= 0.
glm::vec2 squareFromHalf(const glm::vec3& direction) {
    const glm::vec2 flat =
        glm::vec2(direction) / (std::abs(direction.x) + std::abs(direction.y) + direction.z);
    return {flat.x + flat.y, flat.x - flat.y};
}

// A surface that is met from outside only: where the ray grazes it, the normal that is blended there may look
// away from the ray, and is laid down until it does not.
glm::vec3 towards(const glm::vec3& outwards, const glm::vec3& direction, bool onlyOuter) {
    const float away = glm::dot(outwards, direction);
    if (away <= 0) return outwards;
    return onlyOuter ? glm::normalize(outwards - away * direction) : -outwards;
}

} // namespace

int nearestAxis(const Axes& axes, const glm::vec3& direction) {
    const glm::vec2 place = (squareFromHalf(direction.z < 0 ? -direction : direction) * 0.5f + 0.5f) *
                            static_cast<float>(Axes::kTableWidth);
    const int x = std::clamp(static_cast<int>(place.x), 0, Axes::kTableWidth - 1);
    const int y = std::clamp(static_cast<int>(place.y), 0, Axes::kTableWidth - 1);
    return axes.table[y * Axes::kTableWidth + x];
}

std::optional<Hit> TracedOllfb::trace(const glm::vec3& origin, const glm::vec3& direction, float nearest,
                                      float farthest) const {
    if (layers.empty()) return {};
    const OllfbView& view = views[nearestAxis(axes, direction)];
    Walk walk{OllfbPixels{*this, view},      closed, onlyOuter_, view.pixelFromBody(origin),
              view.viewFromBody * direction, true,   0,          false};
    walk.forwards = walk.along.z > 0;
    const float first = nearest * view.pixelsPerMetre;
    walk.left = first + kLeaving_px;
    float begin = first, end = farthest * view.pixelsPerMetre;
    // Planes may stand a little before the surface they stand for.
    constexpr float kBefore_px = 2;
    if (!clipSlab(walk.from.x, walk.along.x, 0, static_cast<float>(view.size.x), begin, end) ||
        !clipSlab(walk.from.y, walk.along.y, 0, static_cast<float>(view.size.y), begin, end) ||
        !clipSlab(walk.from.z, walk.along.z, kDepthMargin_px - kBefore_px,
                  view.depthRange_px - kDepthMargin_px + kBefore_px, begin, end))
        return {};
    bool started = begin > first; // a ray that starts among the layers starts where it is, in or out
    walk.outside = started;
    const bool met = walkCells(
        walk.from, walk.along, begin, end, glm::ivec2(0), view.size,
        [&](const glm::ivec2& pixel, float in, float out) {
            const std::span<const OllfbLayer> here = walk.pixels.layersOf(pixel);
            if (here.empty()) {
                walk.inside = false;
                walk.outside = started = true;
                return false;
            }
            unsigned all = 0xffff;
            for (const OllfbLayer& layer : here) all &= layer.coverage;
            if (all == 0xffff) {
                const bool hit = walk.cross(here, pixel, 1, in, out, started);
                started = true;
                return hit;
            }
            return walkCells(4.0f * glm::vec2(walk.from), 4.0f * glm::vec2(walk.along), in, out, 4 * pixel,
                             4 * pixel + 4, [&](const glm::ivec2& part, float partIn, float partOut) {
                                 const glm::ivec2 place = part - 4 * pixel;
                                 const bool hit = walk.cross(here, pixel, 1u << (4 * place.y + place.x),
                                                             partIn, partOut, started);
                                 started = true;
                                 return hit;
                             });
        });
    if (!met) return {};
    // The view along the ray sees little of a surface that the ray grazes; the one that looks straight at the
    // surface says best where it lies and how it turns. Twice: the ray may meet it some pixels further on.
    float at = walk.metAt / view.pixelsPerMetre;
    glm::vec3 outwards = glm::transpose(view.viewFromBody) * OllfbPixels::normalOf(*walk.met);
    for (int pass = 0; pass < 2; ++pass) {
        const OllfbView& straight = views[nearestAxis(axes, outwards)];
        const glm::vec3 place = straight.pixelFromBody(origin + at * direction);
        const auto surface =
            surfaceNear(OllfbPixels{*this, straight}, place, straight.viewFromBody * outwards);
        if (!surface) break;
        const glm::vec3 along = straight.viewFromBody * direction;
        const float rate = along.z - glm::dot(surface->slope, glm::vec2(along));
        if (std::abs(rate) > kMinRate)
            at += glm::clamp((surface->depth - place.z) / rate, -kFurthest_px, kFurthest_px) /
                  straight.pixelsPerMetre;
        outwards = glm::transpose(straight.viewFromBody) * surface->normal;
    }
    // It grazes the surface it has begun on, which blended falls away from it: on from where it has left.
    if (!walk.dived && at * view.pixelsPerMetre < walk.left && glm::dot(outwards, direction) >= 0)
        return trace(origin, direction, walk.left / view.pixelsPerMetre, farthest);
    return Hit{glm::max(at, nearest), towards(outwards, direction, onlyOuter_)};
}

} // namespace shoal::occlusion
