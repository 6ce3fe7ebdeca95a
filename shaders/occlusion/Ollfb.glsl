// Traces a ray through layered fragment buffers (engine/occlusion/Ollfb.h); tests/baselines/occlusion/TracedOllfb.cpp is its twin
// on the processor, with the reasons. Returns the hit's distance and normal; a negative distance if there is none.
#include "occlusion/Bindings.glsl"
#include "occlusion/Octahedral.glsl"
#include "occlusion/Slab.glsl"

struct OllfbView {
    float viewFromBody[9]; // column by column
    float low[3];          // position of the pixels' origin
    float pixelsPerMetre;
    float depthRange;
    int width, height;
    uint firstRow;
};
struct OllfbRow {
    uint firstLayer, firstStart;
    uint span; // begin in the low half, end in the high
};
layout(std430, binding = OCCLUSION_VIEWS) readonly buffer Views { OllfbView views[]; };
layout(std430, binding = OCCLUSION_ROWS) readonly buffer Rows { OllfbRow rows[]; };
layout(std430, binding = OCCLUSION_STARTS) readonly buffer Starts { uint starts[]; };  // 16 bits each
layout(std430, binding = OCCLUSION_LAYERS) readonly buffer Layers { uint layers[]; };  // 3 times 16 bits each
layout(std430, binding = OCCLUSION_AXES) readonly buffer AxisTable { uint axisTable[]; }; // 16 bits each

uniform bool closed; // rays hit surfaces only where they enter

const int kTableWidth = 64;
const float kSteepest = 12.0, kLeaving_px = 3.0, kDepthMargin_px = kSteepest * 0.75;
const float kSheet_px = 0.25, kSheetPerSlope_px = 0.5, kBefore_px = 2.0;
const float kFurthest_px = 3.0, kMinRate = 0.05, kAlike = 0.5, kSunk_px = 0.5;

uint half_(uint word, uint index) { return word >> (16u * (index & 1u)) & 0xffffu; }
uint layerPart(uint layer, uint part) {
    uint at = 3u * layer + part;
    return half_(layers[at >> 1], at);
}
uint startAt(uint at) { return half_(starts[at >> 1], at); }
uint coverageOf(uint layer) { return layerPart(layer, 2u); }

// The ray in its view, in pixels, and the state of its walk.
OllfbView view;
vec3 rayFrom, rayAlong;
bool forwards, outside, inside, dived;
float left, metAt;
uint metLayer;

int nearestAxis(vec3 direction) {
    if (direction.z < 0.0) direction = -direction;
    vec2 flat_ = direction.xy / (abs(direction.x) + abs(direction.y) + direction.z);
    vec2 square = vec2(flat_.x + flat_.y, flat_.x - flat_.y);
    ivec2 cell = clamp(ivec2((square * 0.5 + 0.5) * float(kTableWidth)), ivec2(0), ivec2(kTableWidth - 1));
    uint at = uint(cell.y * kTableWidth + cell.x);
    return int(half_(axisTable[at >> 1], at));
}

uvec2 layersOf(ivec2 pixel) {
    OllfbRow row = rows[view.firstRow + uint(pixel.y)];
    int begin = int(row.span & 0xffffu), end = int(row.span >> 16);
    if (pixel.x < begin || pixel.x >= end) return uvec2(0);
    uint at = row.firstStart + uint(pixel.x - begin);
    return row.firstLayer + uvec2(startAt(at), startAt(at + 1u));
}

float depthOf(uint layer) { return float(layerPart(layer, 0u)) * (view.depthRange / 65535.0); }
vec3 normalOf(uint layer) { return unpackDirection(layerPart(layer, 1u), 8); }
vec2 slopeOf(vec3 normal) { return -normal.xy / normal.z; }

bool hasSunk(float behind, uint surface) {
    vec2 slope = slopeOf(normalOf(surface));
    return closed && behind > kSunk_px * sqrt(1.0 + dot(slope, slope));
}

bool crossLayers(uvec2 here, ivec2 pixel, uint bit, float in_, float out_, bool started) {
    vec3 pIn = rayFrom + in_ * rayAlong, pOut = rayFrom + out_ * rayAlong;
    vec2 middle = vec2(pixel) + 0.5;
    vec2 asideIn = pIn.xy - middle, asideOut = pOut.xy - middle;
    float beyond = forwards ? pOut.z + kSteepest : pOut.z - kSteepest;
    float side = forwards ? 1.0 : -1.0;
    float passedIn = kNever, nextIn = kNever, at = kNever;
    uint next = 0u, lastIn = 0u, hit = 0u;
    int deepIn = 0, deepOut = 0;
    for (uint i = here.x; i < here.y; ++i) {
        uint layer = forwards ? i : here.y - 1u - (i - here.x);
        float depth = depthOf(layer);
        if (forwards ? depth > beyond : depth < beyond) break;
        if ((coverageOf(layer) & bit) == 0u) continue;
        vec3 normal = normalOf(layer);
        vec2 slope = slopeOf(normal);
        float fIn = side * (pIn.z - depth - dot(slope, asideIn));
        float fOut = side * (pOut.z - depth - dot(slope, asideOut));
        bool facing = forwards == (normal.z < 0.0);
        float reach = closed ? kNever : kSheet_px + kSheetPerSlope_px * length(slope);
        bool ahead = fIn < 0.0 && fOut >= 0.0, aside = fIn > 0.0 && fOut <= 0.0;
        if (ahead || aside) {
            float t = in_ + (out_ - in_) * (fIn / (fIn - fOut));
            bool enters = ahead == facing;
            if (t < at && (enters || (!closed && t > left))) {
                at = t;
                hit = layer;
            }
        }
        int deeper = facing || !closed ? 1 : -1;
        if (fIn >= 0.0 && fIn <= reach) deepIn += deeper;
        if (fOut >= 0.0 && fOut <= reach) deepOut += deeper;
        if (fIn >= 0.0 && fIn < passedIn) {
            passedIn = fIn;
            lastIn = layer;
        }
        if (fIn < 0.0 && -fIn < nextIn) {
            nextIn = -fIn;
            next = layer;
        }
    }
    outside = outside || deepIn <= 0;
    dived = !outside && in_ > left && passedIn < kNever && hasSunk(passedIn, lastIn);
    if (started && deepIn > 0 && (!inside || dived)) {
        metLayer = nextIn < passedIn ? next : lastIn;
        metAt = dived ? left : in_;
        return true;
    }
    if (at < kNever) {
        metLayer = hit;
        metAt = at;
        return true;
    }
    inside = deepOut > 0;
    return false;
}

bool walkLayers(float begin, float end, bool started) {
    ivec2 high = ivec2(view.width, view.height);
    CellWalk walk = walkStart(rayFrom.xy, rayAlong.xy, begin, end, ivec2(0), high);
    do {
        uvec2 here = layersOf(walk.cell);
        if (here.x == here.y) {
            inside = false;
            outside = true;
            started = true;
            continue;
        }
        uint all = 0xffffu;
        for (uint i = here.x; i < here.y; ++i) all &= coverageOf(i);
        if (all == 0xffffu) {
            if (crossLayers(here, walk.cell, 1u, walk.at, walk.end, started)) return true;
            started = true;
            continue;
        }
        ivec2 low = 4 * walk.cell;
        CellWalk parts = walkStart(4.0 * rayFrom.xy, 4.0 * rayAlong.xy, walk.at, walk.end, low, low + 4);
        do {
            ivec2 place = parts.cell - low;
            if (crossLayers(here, walk.cell, 1u << (4 * place.y + place.x), parts.at, parts.end, started)) return true;
            started = true;
        } while (walkStep(parts, low, low + 4));
    } while (walkStep(walk, ivec2(0), high));
    return false;
}

// Finds a surface near a place in `view`; false if no layer fits.
bool surfaceNear(vec3 place, vec3 normal, out float depth, out vec2 slope, out vec3 blended) {
    ivec2 corner = ivec2(floor(place.xy - 0.5));
    vec2 share = place.xy - 0.5 - vec2(corner);
    float furthest = 1.0 + 0.5 * min(kSteepest, length(normal.xy) / abs(normal.z));
    vec3 normalSum = vec3(0);
    vec2 slopeSum = vec2(0);
    float weightSum = 0.0, flatSum = 0.0, tiltSum = 0.0;
    int found = 0;
    for (int k = 0; k < 4; ++k) {
        ivec2 pixel = corner + ivec2(k % 2, k / 2);
        if (any(lessThan(pixel, ivec2(0))) || pixel.x >= view.width || pixel.y >= view.height) continue;
        vec2 aside = place.xy - (vec2(pixel) + 0.5);
        uvec2 here = layersOf(pixel);
        float nearest = furthest;
        bool any_ = false;
        vec3 bestNormal;
        float bestDepth;
        for (uint layer = here.x; layer < here.y; ++layer) {
            vec3 other = normalOf(layer);
            float at = depthOf(layer);
            float off = abs(at + dot(slopeOf(other), aside) - place.z);
            if (off > nearest || dot(other, normal) < kAlike) continue;
            nearest = off;
            any_ = true;
            bestNormal = other;
            bestDepth = at;
        }
        if (!any_) continue;
        float weight = (k % 2 != 0 ? share.x : 1.0 - share.x) * (k / 2 != 0 ? share.y : 1.0 - share.y);
        vec2 tilt = slopeOf(bestNormal);
        normalSum += weight * bestNormal;
        slopeSum += weight * tilt;
        flatSum += weight * bestDepth;
        tiltSum += weight * dot(tilt, aside);
        weightSum += weight;
        ++found;
    }
    if (weightSum <= 0.1) return false;
    depth = (flatSum + (found == 4 ? 0.5 : 1.0) * tiltSum) / weightSum;
    slope = slopeSum / weightSum;
    blended = normalize(normalSum);
    return true;
}

mat3 bodyFromView() {
    float m[9] = view.viewFromBody;
    return mat3(m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]);
}

vec3 pixelFromBody(vec3 place) {
    return place * bodyFromView() * view.pixelsPerMetre - vec3(view.low[0], view.low[1], view.low[2]);
}

const vec4 kNothing = vec4(-1, 0, 0, 0);

// Traces a ray once, for traceLayers(). again: whether it grazes the surface on which it began and must be
// traced again from `nearest`, which has moved on.
vec4 traceFrom(vec3 origin, vec3 direction, inout float nearest, out bool again) {
    again = false;
    view = views[nearestAxis(direction)];
    rayFrom = pixelFromBody(origin);
    rayAlong = direction * bodyFromView();
    forwards = rayAlong.z > 0.0;
    inside = false;
    dived = false;
    float first = nearest * view.pixelsPerMetre;
    left = first + kLeaving_px;
    float begin = first, end = kNever;
    if (!clipSlab(rayFrom.x, rayAlong.x, 0.0, float(view.width), begin, end) ||
        !clipSlab(rayFrom.y, rayAlong.y, 0.0, float(view.height), begin, end) ||
        !clipSlab(rayFrom.z, rayAlong.z, kDepthMargin_px - kBefore_px,
                  view.depthRange - kDepthMargin_px + kBefore_px, begin, end))
        return kNothing;
    outside = begin > first;
    if (!walkLayers(begin, end, outside)) return kNothing;
    float at = metAt / view.pixelsPerMetre, leftAt = left / view.pixelsPerMetre;
    vec3 outwards = bodyFromView() * normalOf(metLayer);
    for (int pass = 0; pass < 2; ++pass) {
        view = views[nearestAxis(outwards)];
        vec3 place = pixelFromBody(origin + at * direction), blended;
        float depth;
        vec2 slope;
        if (!surfaceNear(place, outwards * bodyFromView(), depth, slope, blended)) break;
        vec3 along = direction * bodyFromView();
        float rate = along.z - dot(slope, along.xy);
        if (abs(rate) > kMinRate)
            at += clamp((depth - place.z) / rate, -kFurthest_px, kFurthest_px) / view.pixelsPerMetre;
        outwards = bodyFromView() * blended;
    }
    float away = dot(outwards, direction);
    if (!dived && at < leftAt && away >= 0.0) {
        nearest = leftAt;
        again = true;
        return kNothing;
    }
    vec3 normal = away <= 0.0 ? outwards : closed ? normalize(outwards - away * direction) : -outwards;
    return vec4(max(at, nearest), normal);
}

vec4 traceLayers(vec3 origin, vec3 direction, float nearest) {
    vec4 hit;
    bool again;
    do {
        hit = traceFrom(origin, direction, nearest, again);
    } while (again);
    return hit;
}
