#include "engine/render/CastShadow.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace shoal::render {

namespace {

constexpr int kMaxCells = 28; // along a grid
constexpr float kReach_m = 8; // that shadows fall; they fade over its last third
constexpr float kMinCell_m = 0.04f;
constexpr float kMinTangent = 0.01f; // a sun's disc
constexpr float kLevel = 1;          // rise of a surface that a guess at it allows for, by what it goes aside

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

float tangentOf(const CastingLight& light) { return std::max(light.tangent, kMinTangent); }

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

float CastingLight::raised() const {
    const float level = std::sqrt(std::max(0.0f, 1 - towards.y * towards.y));
    return glm::smoothstep(0.3f, 0.5f, towards.y - tangent * level);
}

// Of the irradiance E on level ground the light gives s E, the rest is (1 - s) E; on another surface it gives
// s E k, k the ratio of the cosines.
glm::vec3 CastingLight::shareAt(float cosine) const {
    if (!(towards.y > 0)) return glm::vec3(0);
    const glm::vec3 given = share * (std::max(cosine, 0.0f) / towards.y);
    return given / glm::max(given + 1.0f - share, 1e-6f);
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

float covered(std::span<const FlatPiece> body, const CastingLight& light, const glm::vec3& place) {
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

namespace {

constexpr float kHit_m = 0.004f; // gap that counts as none: less than the map's steps from 0.8 m on

// A ray before what a film shows.
struct FilmRay {
    const depth::DepthMap& map;
    glm::vec3 from, dir; // frame of the film

    FilmRay(const FilmSurface& film, const glm::vec3& fromWorld, const glm::vec3& dirWorld)
        : map(film.map), from(film.envFromWorld * fromWorld), dir(film.envFromWorld * dirWorld) {}

    // Metres that the surface lies behind the place s along the ray, seen from the film's camera.
    float gapAt(float s) const {
        const glm::vec3 place = from + s * dir;
        const float distance = glm::length(place);
        return distance > 1e-4f ? map.distance_m(place / distance) - distance : INFINITY;
    }
};

float meet(const FilmRay& ray, float reach_m) {
    constexpr float kMinStep_m = 0.1f, kMaxStep_m = 0.5f;
    constexpr float kTouch_m = 0.3f; // so far within a surface a ray begins at it
    // A rise of the gap by this much for what a ray goes on is an edge: as of a surface seen at 4 degrees.
    constexpr float kEdge = 16;
    constexpr int kHalvings = 10;
    float before = 0, gapBefore = ray.gapAt(0);
    if (gapBefore <= 0 && gapBefore > -kTouch_m) return 0;
    while (before < reach_m) {
        float low = before, high = before + std::clamp(0.5f * gapBefore, kMinStep_m, kMaxStep_m);
        float gapLow = gapBefore, gapHigh = ray.gapAt(high);
        before = high, gapBefore = gapHigh;
        if (!(gapLow > 0 && gapHigh <= 0)) continue;
        // False position, which finds a smooth surface at once; halves find an edge, and where what is
        // known ends.
        for (int k = 0; k < kHalvings; ++k) {
            const float part = k % 2 == 0 && std::isfinite(gapLow) ? gapLow / (gapLow - gapHigh) : 0.5f;
            const float middle = low + part * (high - low), gap = ray.gapAt(middle);
            if (std::abs(gap) < kHit_m) return middle;
            (gap > 0 ? low : high) = middle;
            (gap > 0 ? gapLow : gapHigh) = gap;
        }
        if (gapLow - gapHigh < kEdge * (high - low)) return low + (high - low) * gapLow / (gapLow - gapHigh);
    }
    return -1;
}

// The same where a ray close by meets the surface at guess: looks there first, no further off than within_m.
// What only this ray meets before that is passed over.
float meetNear(const FilmRay& ray, float guess, float within_m, float reach_m) {
    constexpr int kLooks = 4;
    float at = guess, gap = ray.gapAt(at), next = at + gap;
    for (int k = 1; k < kLooks && std::abs(gap) >= kHit_m && std::abs(next - guess) < within_m; ++k) {
        // The secant method.
        const float gapNext = ray.gapAt(next);
        const float after = next - gapNext * (next - at) / (gapNext - gap);
        at = next, gap = gapNext, next = after;
    }
    return std::abs(gap) < kHit_m && at >= 0 ? at : meet(ray, reach_m);
}

} // namespace

float meet(const FilmSurface& film, const glm::vec3& fromWorld, const glm::vec3& dirWorld, float reach_m) {
    return meet(FilmRay(film, fromWorld, dirWorld), reach_m);
}

namespace {

// The rays that a grid's nodes lie on: from a rectangle across the way of the light, at the height of the
// body's piece that is nearest to it. They part as the light's disc grows, so that they bound the shadow
// however far it falls.
struct Bundle {
    glm::vec3 middle{0}, along{0}, aside{0};
    float halfAlong_m = 0, halfAside_m = 0;

    Bundle(std::span<const FlatPiece> body, const CastingLight& light) {
        along = body[0].along, aside = body[0].aside;
        glm::vec3 low(INFINITY), high(-INFINITY);
        for (const FlatPiece& piece : body) {
            const glm::vec3 at(glm::dot(piece.middle, along), glm::dot(piece.middle, aside),
                               glm::dot(piece.middle, light.towards));
            const glm::vec3 half(piece.halfAlong_m, piece.halfAside_m, 0);
            low = glm::min(low, at - half), high = glm::max(high, at + half);
        }
        const glm::vec3 centre = 0.5f * (low + high);
        middle = centre.x * along + centre.y * aside + high.z * light.towards;
        halfAlong_m = 0.5f * (high.x - low.x), halfAside_m = 0.5f * (high.y - low.y);
    }
};

// Of the piece that a ray passes: how far it lies below the bundle's beginning.
float depthOfPiece(std::span<const FlatPiece> body, const Bundle& bundle, const CastingLight& light,
                   const glm::vec3& from) {
    float nearest = INFINITY, depth = 0;
    for (const FlatPiece& piece : body) {
        const float away = std::abs(glm::dot(piece.middle - from, bundle.along));
        if (away >= nearest) continue;
        nearest = away;
        depth = glm::dot(bundle.middle - piece.middle, light.towards);
    }
    return std::max(depth, 0.0f);
}

// Between the surface's normal, from the two neighbours of a node with the least difference in height, and
// the way to the light. Neighbours so far off that the map's steps tilt it little, where there are such.
float cosineAt(const ShadowGrid& grid, int x, int y, const CastingLight& light) {
    constexpr float kSpan_m = 0.25f;
    const int widest = std::max(1, static_cast<int>(std::lround(kSpan_m / grid.cell_m)));
    const auto node = [&](int nx, int ny) -> const ShadowGrid::Node* {
        if (nx < 0 || ny < 0 || nx > grid.across || ny > grid.down) return nullptr;
        const ShadowGrid::Node& found = grid.at(nx, ny);
        return found.fall_m < 0 ? nullptr : &found;
    };
    const ShadowGrid::Node& here = *node(x, y);
    const auto slopeOver = [&](int dx, int dy) {
        const ShadowGrid::Node *a = node(x - dx, y - dy), *b = node(x + dx, y + dy);
        const auto off = [&](const ShadowGrid::Node* n) {
            return n ? std::abs(n->fall_m - here.fall_m) : INFINITY;
        };
        if (!a && !b) return glm::vec3(0);
        return off(a) < off(b) ? here.place - a->place : b->place - here.place;
    };
    const auto slope = [&](int dx, int dy, int cells) {
        glm::vec3 found(0);
        for (int span = std::min(widest, cells / 2); span > 0 && found == glm::vec3(0); span /= 2)
            found = slopeOver(dx * span, dy * span);
        return found;
    };
    const glm::vec3 normal = glm::cross(slope(1, 0, grid.across), slope(0, 1, grid.down));
    const float length = glm::length(normal);
    return length > 1e-9f ? std::abs(glm::dot(normal, light.towards)) / length : light.towards.y;
}

} // namespace

bool ShadowGrid::shades(size_t a, size_t b, size_t c) const {
    constexpr float kSteepest = 4; // rise of a surface by what it goes aside; steeper ones get little light
    constexpr float kUnseen = 0.002f;
    const Node &first = nodes[a], &second = nodes[b], &third = nodes[c];
    const auto [low, high] = std::minmax({first.fall_m, second.fall_m, third.fall_m});
    const glm::vec3 taken = glm::max(first.taken, glm::max(second.taken, third.taken));
    return low >= 0 && high - low < kSteepest * cell_m && std::max({taken.x, taken.y, taken.z}) > kUnseen;
}

// The shadow lies in a cone that is cut off, from around the body to where shadows end: it is out of view
// where both its ends are beyond one side of the view, or behind the eye.
bool mayBeSeen(std::span<const FlatPiece> body, const CastingLight& light, const View& eye) {
    if (body.empty()) return false;
    const Bundle bundle(body, light);
    const float radius = std::hypot(bundle.halfAlong_m, bundle.halfAside_m);
    const float furthest = radius + std::sqrt(2.0f) * tangentOf(light) * kReach_m;
    const glm::quat eyeFromWorld = glm::conjugate(eye.worldFromEye);
    const glm::vec3 top = eyeFromWorld * (bundle.middle - eye.eyeWorld);
    const glm::vec3 bottom = top - kReach_m * (eyeFromWorld * light.towards);
    const glm::vec2 half = eye.halfExtent(), low = eye.shift - half, high = eye.shift + half;
    const std::array<glm::vec3, 5> inward{
        {{1, 0, low.x}, {-1, 0, -high.x}, {0, 1, low.y}, {0, -1, -high.y}, {0, 0, -1}}};
    return std::ranges::all_of(inward, [&](const glm::vec3& side) {
        const float length = glm::length(side);
        return glm::dot(side, top) > -radius * length || glm::dot(side, bottom) > -furthest * length;
    });
}

namespace {

// How far a body's shadow reaches on what a film shows, found for its pieces one by one.
struct ShadowExtent {
    float furthest_m = 0;    // that it falls, from the bundle's beginning
    float cell_m = INFINITY; // of a grid that is fine enough for the sharpest of it
    float hidden = 0;        // share of the light's disc where it is darkest, at most
};

ShadowExtent extentOf(const FilmSurface& film, std::span<const FlatPiece> body, const Bundle& bundle,
                      const CastingLight& light) {
    ShadowExtent extent;
    float ground = -INFINITY; // where the last piece's shadow falls, along the light's way
    for (const FlatPiece& piece : body) {
        const float from = -glm::dot(piece.middle, light.towards);
        const FilmRay ray(film, piece.middle, -light.towards);
        const float away = ground > from
                               ? meetNear(ray, ground - from, kLevel * 2 * piece.halfAlong_m, kReach_m)
                               : meet(ray, kReach_m);
        if (away < 0) continue;
        ground = from + away;
        const float disc = std::max(tangentOf(light) * away, 1e-3f);
        extent.cell_m = std::min(extent.cell_m, 0.35f * (disc + piece.halfAside_m));
        extent.furthest_m =
            std::max(extent.furthest_m, away + glm::dot(bundle.middle - piece.middle, light.towards));
        // Its area on the disc's, where the product of strips is densest.
        const float flat = 4 * piece.halfAlong_m * piece.halfAside_m;
        extent.hidden += std::min(1.0f, flat * 1.27f / (std::numbers::pi_v<float> * disc * disc));
    }
    extent.hidden = std::min(extent.hidden, 1.0f);
    return extent;
}

// Sets out's cells, with nodes of which nothing is known.
void layOut(const Bundle& bundle, const CastingLight& light, const ShadowExtent& extent, ShadowGrid& out) {
    const float aside_m = tangentOf(light) * extent.furthest_m;
    const float halfAlong = bundle.halfAlong_m + aside_m, halfAside = bundle.halfAside_m + aside_m;
    const auto cells = [&](float half_m) {
        const float count = std::ceil(2 * half_m / std::max(extent.cell_m, kMinCell_m));
        return std::clamp(static_cast<int>(count), 2, kMaxCells);
    };
    out.across = cells(halfAlong), out.down = cells(halfAside);
    out.cell_m =
        2 * std::max(halfAlong / static_cast<float>(out.across), halfAside / static_cast<float>(out.down));
    out.nodes.assign(static_cast<size_t>((out.across + 1) * (out.down + 1)), {});
}

// Finds where the bundle's rays through a grid's nodes meet what a film shows.
struct NodeFinder {
    const FilmSurface& film;
    std::span<const FlatPiece> body;
    const Bundle& bundle;
    const CastingLight& light;
    ShadowGrid& grid;

    // (dx, dy): to the neighbours on both sides that have been looked for, from which this node differs
    // little; (0, 0): there are none.
    void find(int x, int y, int dx, int dy) const {
        const float u = 2 * static_cast<float>(x) / static_cast<float>(grid.across) - 1,
                    v = 2 * static_cast<float>(y) / static_cast<float>(grid.down) - 1;
        const glm::vec3 from =
            bundle.middle + u * bundle.halfAlong_m * bundle.along + v * bundle.halfAside_m * bundle.aside;
        const glm::vec3 way = tangentOf(light) * (u * bundle.along + v * bundle.aside) - light.towards;
        const float start = depthOfPiece(body, bundle, light, from);
        const FilmRay ray(film, from + start * way, way);
        const float within_m = kLevel * static_cast<float>(dx + dy) * grid.cell_m;
        const float guess = guessFrom(x, y, dx, dy, within_m) - start;
        const float away = guess >= 0 ? meetNear(ray, guess, within_m, kReach_m) : meet(ray, kReach_m);
        if (away < 0) return;
        ShadowGrid::Node& found = grid.at(x, y);
        found.fall_m = start + away;
        found.place = from + found.fall_m * way;
    }

    // The neighbours' mean fall; -infinity where they are too far apart to be of one surface.
    float guessFrom(int x, int y, int dx, int dy, float within_m) const {
        if (dx + dy == 0) return -INFINITY;
        const bool both = x + dx <= grid.across && y + dy <= grid.down;
        const float before = grid.at(x - dx, y - dy).fall_m,
                    after = both ? grid.at(x + dx, y + dy).fall_m : before;
        const bool near = before >= 0 && after >= 0 && std::abs(before - after) < 2 * within_m;
        return near ? 0.5f * (before + after) : -INFINITY;
    }

    // Every fourth node is looked for along the whole ray, then those in between.
    void findAll() const {
        constexpr int kApart = 4;
        for (int y = 0; y <= grid.down; y += kApart)
            for (int x = 0; x <= grid.across; x += kApart) find(x, y, 0, 0);
        for (int step = kApart / 2; step > 0; step /= 2) {
            for (int y = 0; y <= grid.down; y += 2 * step)
                for (int x = step; x <= grid.across; x += 2 * step) find(x, y, step, 0);
            for (int y = step; y <= grid.down; y += 2 * step)
                for (int x = 0; x <= grid.across; x += step) find(x, y, 0, step);
        }
    }
};

// What the body takes of the light at each node that was found.
void shade(std::span<const FlatPiece> body, const CastingLight& light, float strength, ShadowGrid& grid) {
    for (int y = 0; y <= grid.down; ++y)
        for (int x = 0; x <= grid.across; ++x) {
            ShadowGrid::Node& shaded = grid.at(x, y);
            if (shaded.fall_m < 0) continue;
            const float here = covered(body, light, shaded.place);
            if (!(here > 0)) continue;
            const float fade = 1 - glm::smoothstep(0.67f * kReach_m, kReach_m, shaded.fall_m);
            shaded.taken = strength * fade * here * light.shareAt(cosineAt(grid, x, y, light));
        }
}

} // namespace

void castOn(const FilmSurface& film, std::span<const FlatPiece> body, const CastingLight& light,
            float minimum, ShadowGrid& out) {
    out.across = out.down = 0;
    if (body.empty() || light.share == glm::vec3(0)) return;
    const Bundle bundle(body, light);
    const ShadowExtent extent = extentOf(film, body, bundle, light);
    const glm::vec3 most = light.presence * light.share;
    const float taken = extent.hidden * std::max({most.x, most.y, most.z});
    if (taken <= minimum) return;
    layOut(bundle, light, extent, out);
    NodeFinder{film, body, bundle, light, out}.findAll();
    shade(body, light, light.presence * glm::smoothstep(minimum, 2 * minimum, taken), out);
}

} // namespace shoal::render
