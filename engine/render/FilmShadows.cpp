#include "engine/render/FilmShadows.h"

#include "engine/core/Vectorise.h"
#include "engine/math/LatLong.h"

#include <glm/glm.hpp>

#include <cmath>
#include <numbers>

namespace shoal::render {

namespace {

constexpr float kUnseen = 0.0039f; // share of the light whose loss rounds to none of 255 display values
constexpr float kFar_m = 1e4f;     // stands for unknown distances; no shadow falls so far
constexpr int kSame = 2;           // neighbours' codes are clamped to this difference, then averaged

// Returns at least the share of a disc that a piece hides where its shadow is darkest: its area divided by
// the disc's, times 1.27, the greatest density of the product of two strips.
float mostHidden(float halfAlong, float halfAside, float disc) {
    return 4 * halfAlong * halfAside * 1.27f / (std::numbers::pi_v<float> * disc * disc);
}

// Adds the share of the light that the piece hides from each place. disc: CastingLight::discTangent().
SHOAL_VECTORISE void hide(const FilmShadows::Occluder& piece, float disc, const float* along,
                          const float* aside, const float* up, size_t count, float* hidden) {
    for (size_t i = 0; i < count; ++i) {
        const float fall = piece.up - up[i];
        const float perDisc = 1 / std::max(disc * fall, kMinDisc_m);
        const float a = piece.along - along[i], b = piece.aside - aside[i];
        const float covered =
            (discBefore((a + piece.halfAlong) * perDisc) - discBefore((a - piece.halfAlong) * perDisc)) *
            (discBefore((b + piece.halfAside) * perDisc) - discBefore((b - piece.halfAside) * perDisc));
        const float above = std::min(std::max((up[i] - piece.lowest) * piece.perFade, 0.0f), piece.share);
        hidden[i] += fall > 0 ? covered * above : 0.0f;
    }
}

// Multiplies the texels from low to below high, blue first, by a factor for red, green and blue.
void dimTexels(Image<uint8_t, 4>& texels, const glm::ivec2& low, const glm::ivec2& high,
               const glm::vec3& factor) {
    for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x)
            for (int c = 0; c < 3; ++c) {
                uint8_t& value = texels.at(x, y)[c];
                value = static_cast<uint8_t>(static_cast<float>(value) * factor[2 - c] + 0.5f);
            }
}

Sphere sphereAround(std::span<const occlusion::Ellipsoid> body) {
    Sphere sphere;
    for (const auto& part : body) sphere.centre += part.centre / static_cast<float>(body.size());
    for (const auto& part : body)
        sphere.radius =
            std::max(sphere.radius, glm::distance(part.centre, sphere.centre) +
                                        std::max({part.semiAxes.x, part.semiAxes.y, part.semiAxes.z}));
    return sphere;
}

// Returns whether an eye may see a place on which a body's shadow can fall: tests a row of spheres that hold
// the shadow. Most bodies are outside the view, and this test is quicker than finding their shadows.
bool mayBeSeen(const Sphere& body, const CastingLight& light, std::span<const View> eyes) {
    constexpr int kSteps = 8;
    constexpr float kStep_m = kShadowReach_m / kSteps;
    // A piece's middle is at most one radius from the body's along each axis; its spot is as in findTiles().
    constexpr float kOff = std::numbers::sqrt3_v<float> + 2;
    for (int k = 0; k < kSteps; ++k) {
        const float end = static_cast<float>(k + 1) * kStep_m;
        const float disc = std::numbers::sqrt2_v<float> * std::max(light.discTangent() * end, kMinDisc_m);
        const Sphere step{body.centre - (end - kStep_m / 2) * light.towards,
                          kOff * body.radius + disc + kStep_m / 2};
        if (std::ranges::any_of(eyes, [&](const View& eye) { return sees(eye, step); })) return true;
    }
    return false;
}

} // namespace

glm::vec3 surfaceShare(const water::Water& water, float distance_m) {
    const glm::vec3 arrives = glm::exp(-water.attenuation_perM * distance_m);
    const glm::vec3 veil = glm::max(water.veil[0], 1e-6f),
                    surface = arrives * std::max({veil.r, veil.g, veil.b});
    return surface / (surface + (1.0f - arrives) * veil);
}

glm::vec3 remainingOf(const glm::vec3& taken, FrameCoding frames, const glm::vec3& share) {
    const glm::vec3 left = 1.0f - taken;
    return glm::sqrt(1.0f - (1.0f - (frames == FrameCoding::Srgb ? left : left * left)) * share);
}

void FilmShadows::begin(const FilmSurface& film, FrameCoding frames, const water::Water& water) {
    film_ = film;
    frames_ = frames;
    ++number_;
    const glm::ivec2 size(film.map->inverse.width, film.map->inverse.height);
    if (size != glm::ivec2(remaining_.width, remaining_.height)) {
        remaining_ = Image<uint8_t, 4>(size.x, size.y);
        columns_.clear();
        rows_.clear();
        for (int x = 0; x < size.x; ++x) columns_.push_back(texelDirection(x, 0, size.x, 1));
        for (int y = 0; y < size.y; ++y) rows_.push_back(texelDirection(0, y, 1, size.y));
    }
    std::ranges::fill(remaining_.pixels, uint8_t{255});
    empty_ = true;
    tiles_.clear(size);
    static_assert(depth::DepthRange::kCells == FrameTiles::kCount);
    for (size_t code = 0; code < distance_m_.size(); ++code) {
        distance_m_[code] = code == 0 ? kFar_m : 1 / depth::DepthMap::perM(static_cast<int>(code));
        surface_[code] = surfaceShare(water, distance_m_[code]);
    }
}

void FilmShadows::add(std::span<const occlusion::Ellipsoid> body, const CastingLight& light,
                      std::span<const View> eyes) {
    if (light.presence == 0 || light.share == glm::vec3(0) || !mayBeSeen(sphereAround(body), light, eyes))
        return;
    flatten(body, light, pieces_);
    const glm::vec3 most = light.presence * light.share;
    const float taken = findOccluders(light) * std::max({most.x, most.y, most.z});
    if (taken <= kMinShadow) return;
    lightFromEnv_ =
        glm::transpose(film_.envFromWorld * glm::mat3(pieces_[0].along, pieces_[0].aside, light.towards));
    findTiles(eyes);
    // The shadow of a body that takes little more than kMinShadow is faint, so that it does not pop in.
    const float strength = light.presence * glm::smoothstep(kMinShadow, 2 * kMinShadow, taken);
    for (const size_t tile : reached_)
        shadeTile(light, strength, glm::ivec2(tile % FrameTiles::kCount.x, tile / FrameTiles::kCount.x));
}

// Finds the tiles around the spots; a spot on a surface that slopes by 45 degrees is longer by sqrt(2).
void FilmShadows::findTiles(std::span<const View> eyes) {
    reached_.clear();
    for (const Occluder& piece : occluders_) {
        const Sphere around{piece.spotWorld, std::numbers::sqrt2_v<float> * piece.spotRadius_m};
        if (std::ranges::none_of(eyes, [&](const View& eye) { return sees(eye, around); })) continue;
        tiles_.eachOfSphere(film_.envFromWorld * (around.centre - film_.cameraWorld), around.radius,
                            [&](const glm::ivec2& tile) {
                                const size_t index = FrameTiles::indexOf(tile.x, tile.y);
                                if (!isReached_[index]) reached_.push_back(index);
                                isReached_[index] = true;
                            });
    }
    for (const size_t tile : reached_) isReached_[tile] = false;
}

// Computes the places, in the light's frame, of each `step`th texel of each `step`th row. Codes are averaged
// with neighbours', clamped to nearly equal ones: on a surface that slopes little, whole numbers leave steps.
void FilmShadows::findPlaces(const glm::ivec2& low, const glm::ivec2& high, int step) {
    const Image<uint8_t, 1>& codes = film_.map->inverse;
    const glm::ivec2 blocks = (high - low + step - 1) / step;
    const auto count = static_cast<size_t>(blocks.x) * static_cast<size_t>(blocks.y);
    for (std::vector<float>* each : {&along_, &aside_, &up_}) each->resize(count);
    hidden_.assign(count, 0);
    size_t i = 0;
    for (int y = low.y; y < high.y; y += step) {
        const std::array<const uint8_t*, 3> rows{codes.at(0, std::max(y - 1, 0)), codes.at(0, y),
                                                 codes.at(0, std::min(y + 1, codes.height - 1))};
        for (int x = low.x; x < high.x; x += step, ++i) {
            const int code = rows[1][x], left = wrappedColumn(x - 1, codes.width),
                      right = wrappedColumn(x + 1, codes.width);
            int sum = 0;
            for (const uint8_t* row : rows)
                for (const int column : {left, x, right})
                    sum += std::clamp<int>(row[column], code - kSame, code + kSame);
            const float distance =
                code == 0 ? kFar_m : 9 / (static_cast<float>(sum) * depth::DepthMap::perM(1));
            const glm::vec3 place = lightFromEnv_ * (distance * directionAt(x, y));
            along_[i] = place.x, aside_[i] = place.y, up_[i] = place.z;
        }
    }
}

glm::vec3 FilmShadows::directionAt(int x, int y) const {
    const glm::vec3 &level = columns_[static_cast<size_t>(x)], &ahead = rows_[static_cast<size_t>(y)];
    return {-ahead.z * level.x, ahead.y, -ahead.z * level.z};
}

glm::vec3 FilmShadows::placeAt(int x, int y) const {
    return distance_m_[*film_.map->inverse.at(x, y)] * directionAt(x, y);
}

// Takes the normal from neighbours, along each axis from the one that is nearer in depth: the other may lie
// beyond an edge. They are so far apart that the map's steps tilt the normal little.
float FilmShadows::cosineAt(int x, int y, const glm::vec3& towardsEnv) const {
    constexpr float kSpan_m = 0.25f;
    const Image<uint8_t, 1>& codes = film_.map->inverse;
    const float perRadian = static_cast<float>(codes.height) * std::numbers::inv_pi_v<float>;
    const auto spanOf = [&](float ring_m) {
        return std::clamp(static_cast<int>(perRadian * kSpan_m / ring_m + 0.5f), 1, codes.width / 16);
    };
    const int code = *codes.at(x, y);
    const float distance = distance_m_[static_cast<size_t>(code)];
    const int across = spanOf(distance * std::max(-rows_[static_cast<size_t>(y)].z, 0.05f)),
              down = spanOf(distance);
    const glm::vec3 here = placeAt(x, y);
    const auto slope = [&](glm::ivec2 a, glm::ivec2 b) {
        const auto off = [&](const glm::ivec2& at) { return std::abs(*codes.at(at.x, at.y) - code); };
        return off(a) < off(b) ? here - placeAt(a.x, a.y) : placeAt(b.x, b.y) - here;
    };
    const glm::vec3 normal = glm::cross(
        slope({wrappedColumn(x - across, codes.width), y}, {wrappedColumn(x + across, codes.width), y}),
        slope({x, std::max(y - down, 0)}, {x, std::min(y + down, codes.height - 1)}));
    const float length = glm::length(normal);
    return length > 1e-9f ? std::abs(glm::dot(normal, towardsEnv)) / length : towardsEnv.y;
}

// A piece casts no shadow if the film shows nothing below it, or nothing near enough.
float FilmShadows::findOccluders(const CastingLight& light) {
    occluders_.clear();
    float darkest = 0;
    for (const FlatPiece& piece : pieces_) {
        const float fall = fallOf(film_, piece.middle, light);
        if (fall < 0) continue;
        const float disc = std::max(light.discTangent() * fall, kMinDisc_m);
        const float radius = std::hypot(piece.halfAlong_m, piece.halfAside_m) + disc;
        const float fade = 1 - glm::smoothstep(0.67f * kShadowReach_m, kShadowReach_m, fall);
        darkest += fade * std::min(1.0f, mostHidden(piece.halfAlong_m, piece.halfAside_m, disc));
        const glm::vec3 middle = piece.middle - film_.cameraWorld;
        // The lower end is a little below where the shadow meets the surface, which may slope.
        const float up = glm::dot(middle, light.towards), margin = 0.5f * radius + 0.05f;
        occluders_.push_back({.along = glm::dot(middle, piece.along),
                              .aside = glm::dot(middle, piece.aside),
                              .up = up,
                              .halfAlong = piece.halfAlong_m,
                              .halfAside = piece.halfAside_m,
                              .lowest = up - fall - radius - margin,
                              .perFade = fade / margin,
                              .share = fade,
                              .spotWorld = piece.middle - fall * light.towards,
                              .spotRadius_m = radius});
    }
    return std::min(darkest, 1.0f);
}

// Uses the nearest and the farthest of the tile's texels: most tiles that a spot's sphere reaches lie before
// or behind it.
scene::Bounds FilmShadows::extentOf(const glm::ivec2& tile, const glm::ivec2& low,
                                    const glm::ivec2& high) const {
    const auto [least, most] = film_.range->codesIn(FrameTiles::indexOf(tile.x, tile.y));
    const float furthest = distance_m_[static_cast<size_t>(std::max(least - kSame, 0))];
    const float nearest = most == 0 ? kFar_m : distance_m_[static_cast<size_t>(std::min(most + kSame, 255))];
    const glm::ivec2 middle = (low + high) / 2;
    const glm::vec3 towards = lightFromEnv_ * directionAt(middle.x, middle.y);
    const float texel = std::numbers::pi_v<float> / static_cast<float>(film_.map->inverse.height);
    const float beside = furthest * texel * (0.5f * glm::length(glm::vec2(high - low)) + 1);
    const glm::vec3 near = nearest * towards, far = furthest * towards;
    return {glm::min(near, far) - beside, glm::max(near, far) + beside};
}

bool FilmShadows::reaches(const Occluder& piece, const scene::Bounds& extent, float discTangent) {
    const glm::vec3 &low = extent.low, &high = extent.high; // along, aside, up
    // The disc is largest at the extent's lower end. A body has some eight pieces, which may add up.
    const float disc = discTangent * (piece.up - std::max(low.z, piece.lowest));
    const float least = std::max(discTangent * (piece.up - high.z), kMinDisc_m);
    if (mostHidden(piece.halfAlong, piece.halfAside, least) < kUnseen / 8) return false;
    return piece.along + piece.halfAlong + disc > low.x && piece.along - piece.halfAlong - disc < high.x &&
           piece.aside + piece.halfAside + disc > low.y && piece.aside - piece.halfAside - disc < high.y &&
           high.z > piece.lowest && low.z < piece.up;
}

void FilmShadows::shadeTile(const CastingLight& light, float strength, const glm::ivec2& tile) {
    const glm::ivec2 low = tiles_.lowOf(tile), high = tiles_.lowOf(tile + 1);
    const scene::Bounds extent = extentOf(tile, low, high);
    const int step = light.isWide() ? 2 : 1; // its shadows change little from texel to texel
    hidden_.clear();
    for (const Occluder& piece : occluders_) {
        if (!reaches(piece, extent, light.discTangent())) continue;
        if (hidden_.empty()) findPlaces(low, high, step);
        hide(piece, light.discTangent(), along_.data(), aside_.data(), up_.data(), hidden_.size(),
             hidden_.data());
    }
    if (hidden_.empty()) return;
    bool any = false;
    const glm::vec3 towardsEnv = film_.envFromWorld * light.towards;
    const glm::vec3 most = strength * light.shareAt(1); // share of a surface that faces the light
    const float unseen = frames_ == FrameCoding::Srgb ? kUnseen : kUnseen / 2; // see remainingOf()
    size_t i = 0;
    for (int y = low.y; y < high.y; y += step)
        for (int x = low.x; x < high.x; x += step, ++i) {
            const float hidden = std::min(hidden_[i], 1.0f);
            const glm::vec3& surface = surface_[*film_.map->inverse.at(x, y)];
            const glm::vec3 bound = hidden * most * surface;
            if (std::max({bound.r, bound.g, bound.b}) < unseen) continue;
            any = true;
            const glm::vec3 taken = hidden * strength * light.shareAt(cosineAt(x, y, towardsEnv));
            const glm::vec3 left = remainingOf(taken, frames_, surface);
            dimTexels(remaining_, {x, y}, glm::min(glm::ivec2(x, y) + step, high), left);
        }
    if (!any) return;
    empty_ = false;
    // Neighbours are chosen too: where the map is enlarged, their outermost texels are mixed with the tile's.
    for (int y = std::max(tile.y - 1, 0); y <= std::min(tile.y + 1, FrameTiles::kCount.y - 1); ++y)
        for (int x = tile.x - 1; x <= tile.x + 1; ++x) tiles_.choose({x, y});
}

} // namespace shoal::render
