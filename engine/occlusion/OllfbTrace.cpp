#include "engine/occlusion/MergeLayers.h"
#include "engine/occlusion/Octahedral.h"
#include "engine/occlusion/Ollfb.h"
#include "engine/occlusion/PixelWalk.h"

#include <cmath>

namespace shoal::occlusion {

namespace {

// Behind a surface that bounds no inside, its wall from one cell to the next is this thick.
constexpr float kSheet_px = 0.25f, kSheetPerSlope_px = 0.5f;
constexpr float kNone = std::numeric_limits<float>::infinity();

struct Layers {
    const OllfbLayer* begin;
    const OllfbLayer* end;
};

struct Unpacked {
    float depth;
    glm::vec2 slope;
    glm::vec3 normal;
};

// One view as a ray finds it.
struct Walk {
    const OllfbView& view;
    const OllfbRow* rows;
    const uint16_t* starts;
    const OllfbLayer* layers;
    bool closed, onlyOuter;
    glm::vec3 from, along; // pixels
    bool forwards;         // depth grows along the ray
    float left;            // along the ray, pixels: from here on it may meet a surface from behind

    bool inside = false; // where the last cell was left
    float metAt = 0;     // along the ray, pixels
    const OllfbLayer* met = nullptr;
    glm::ivec2 metPixel{0};
    bool metWall = false;

    Layers layersOf(const glm::ivec2& pixel) const {
        const OllfbRow& row = rows[pixel.y];
        if (pixel.x < row.begin || pixel.x >= row.end) return {nullptr, nullptr};
        const uint16_t* const start = starts + row.firstStart + (pixel.x - row.begin);
        const OllfbLayer* const first = layers + row.firstLayer;
        return {first + start[0], first + start[1]};
    }

    float depthOf(const OllfbLayer& layer) const {
        return static_cast<float>(layer.depth) * (view.depthRange_px / 65535);
    }

    Unpacked unpack(const OllfbLayer& layer) const {
        const glm::vec3 normal = unpackDirection(layer.normal, 8);
        return {depthOf(layer), slopeOf(normal), normal};
    }

    // Follows the ray from `in` to `out` through the part of a pixel whose layers have `bit`; true if it met
    // one.
    bool cross(const Layers& here, const glm::ivec2& pixel, unsigned bit, float in, float out, bool started) {
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
        const std::ptrdiff_t count = here.end - here.begin;
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const OllfbLayer& layer = forwards ? here.begin[i] : here.end[-1 - i];
            const float depth = depthOf(layer);
            if (forwards ? depth > beyond : depth < beyond) break; // all others lie further on
            if (!(layer.coverage & bit)) continue;
            const glm::vec3 normal = unpackDirection(layer.normal, 8);
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
        if (started && deepIn > 0 && !inside) {
            met = next && nextIn < passedIn ? next : lastIn;
            metAt = in, metPixel = pixel, metWall = true;
            return true;
        }
        if (hit) {
            met = hit, metAt = at, metPixel = pixel;
            return true;
        }
        inside = deepOut > 0;
        return false;
    }

    // Depth and normal where the ray met a surface, blended between the planes of the pixels around. Two
    // planes that touch a bent surface lie as far outside it between their middles as the chord between these
    // lies inside: half the slope between them follows the bend.
    Hit blend() const {
        const Unpacked own = unpack(*met);
        glm::vec3 normal = own.normal;
        float at = metAt;
        if (!metWall) {
            const glm::vec3 p = from + metAt * along;
            const glm::ivec2 corner(glm::floor(glm::vec2(p) - 0.5f));
            const glm::vec2 share = glm::vec2(p) - 0.5f - glm::vec2(corner);
            glm::vec3 normalSum(0);
            glm::vec2 slopeSum(0);
            float weightSum = 0, flatSum = 0, tiltSum = 0;
            int found = 0;
            for (int k = 0; k < 4; ++k) {
                const glm::ivec2 pixel = corner + glm::ivec2(k % 2, k / 2);
                if (pixel.x < 0 || pixel.y < 0 || pixel.x >= view.size.x || pixel.y >= view.size.y) continue;
                const glm::vec2 aside = glm::vec2(p) - (glm::vec2(pixel) + 0.5f);
                const Layers here = layersOf(pixel);
                float nearest = 0.5f + 0.5f * glm::length(own.slope);
                std::optional<Unpacked> best;
                for (const OllfbLayer* layer = here.begin; layer != here.end; ++layer) {
                    const Unpacked other = unpack(*layer);
                    const float off = std::abs(other.depth + glm::dot(other.slope, aside) - p.z);
                    if (off > nearest || glm::dot(other.normal, own.normal) < 0.5f) continue;
                    nearest = off, best = other;
                }
                if (!best) continue;
                const float weight = (k % 2 ? share.x : 1 - share.x) * (k / 2 ? share.y : 1 - share.y);
                normalSum += weight * best->normal;
                slopeSum += weight * best->slope;
                flatSum += weight * best->depth;
                tiltSum += weight * glm::dot(best->slope, aside);
                weightSum += weight;
                ++found;
            }
            if (weightSum > 0.1f) {
                normal = glm::normalize(normalSum);
                const float depth = (flatSum + (found == 4 ? 0.5f : 1.0f) * tiltSum) / weightSum;
                const float rate = along.z - glm::dot(slopeSum / weightSum, glm::vec2(along));
                if (std::abs(rate) > 0.05f) at += glm::clamp((depth - p.z) / rate, -1.0f, 1.0f);
            }
        }
        return {at, normal};
    }
};

// What is met from outside only: where the ray grazes it, the normal that is blended there may look away from
// the ray, and is laid down until it does not.
glm::vec3 towards(const glm::vec3& outwards, const glm::vec3& direction, bool onlyOuter) {
    const float away = glm::dot(outwards, direction);
    if (away <= 0) return outwards;
    return onlyOuter ? glm::normalize(outwards - away * direction) : -outwards;
}

} // namespace

std::optional<Hit> Ollfb::trace(const glm::vec3& origin, const glm::vec3& direction, float nearest,
                                float farthest) const {
    if (layers_.empty()) return {};
    const OllfbView& view = views_[static_cast<size_t>(axes_.nearest(direction))];
    Walk walk{view,
              rows_.data() + view.firstRow,
              starts_.data(),
              layers_.data(),
              closed_,
              onlyOuter_,
              view.pixelFromBody(origin),
              view.viewFromBody * direction,
              true,
              0};
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
    const bool met = walkCells(
        walk.from, walk.along, begin, end, glm::ivec2(0), view.size,
        [&](const glm::ivec2& pixel, float in, float out) {
            const Layers here = walk.layersOf(pixel);
            if (here.begin == here.end) {
                walk.inside = false;
                started = true;
                return false;
            }
            unsigned all = 0xffff;
            for (const OllfbLayer* layer = here.begin; layer != here.end; ++layer) all &= layer->coverage;
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
    const Hit inPixels = walk.blend();
    const glm::vec3 outwards = glm::transpose(view.viewFromBody) * inPixels.normal;
    // It grazes the surface it has begun on: blended, this falls away from the ray.
    if (inPixels.distance < walk.left && walk.onlyOuter && glm::dot(outwards, direction) >= 0) return {};
    return Hit{glm::max(inPixels.distance, first) / view.pixelsPerMetre,
               towards(outwards, direction, onlyOuter_)};
}

} // namespace shoal::occlusion
