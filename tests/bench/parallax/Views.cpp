#include "tests/bench/parallax/Views.h"

#include "engine/math/LatLong.h"
#include "engine/render/BackgroundCells.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace shoal::bench {

namespace {

glm::vec3 sample(const ImageRgbF& map, const glm::vec2& uv) {
    const glm::vec2 at = uv * glm::vec2(map.width, map.height) - 0.5f, low = glm::floor(at), part = at - low;
    const auto texel = [&](int x, int y) {
        const float* t = map.at((x % map.width + map.width) % map.width, std::clamp(y, 0, map.height - 1));
        return glm::vec3(t[0], t[1], t[2]);
    };
    const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), part.x),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), part.x), part.y);
}

// Returns the ray from the eye to a pixel's middle on the image plane.
glm::vec3 rayOf(const glm::vec2& pixel, const glm::mat3& envFromEye, int size) {
    return envFromEye * glm::vec3(2.0f * (pixel + 0.5f) / static_cast<float>(size) - 1.0f, -1);
}

// colourOf(ray in the env frame)
template <class Colour> Picture everyPixel(const glm::mat3& envFromEye, int size, const Colour& colourOf) {
    Picture picture{size, {}};
    picture.pixels.reserve(static_cast<size_t>(size) * size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) picture.pixels.push_back(colourOf(rayOf({x, y}, envFromEye, size)));
    return picture;
}

struct Vertex {
    glm::vec3 place; // eye frame
    glm::vec2 uv;
};

// Draws a perspective-correct triangle with a depth test; skips it if it reaches behind the image plane.
void fill(const std::array<Vertex, 3>& corners, const ImageRgbF& map, Picture& picture,
          std::vector<float>& nearest) {
    constexpr float kNear_m = 0.01f;
    std::array<glm::vec3, 3> at; // pixels, and one over the distance ahead
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec3& p = corners[i].place;
        if (-p.z < kNear_m) return;
        const glm::vec2 plane = glm::vec2(p.x, p.y) / -p.z;
        at[i] = glm::vec3((plane * 0.5f + 0.5f) * static_cast<float>(picture.size) - 0.5f, -1 / p.z);
    }
    const glm::vec2 a(at[0]), b(at[1]), c(at[2]);
    const auto cross = [](const glm::vec2& u, const glm::vec2& v) { return u.x * v.y - u.y * v.x; };
    const float area = cross(b - a, c - a);
    if (area == 0) return;
    const glm::vec2 low = glm::max(glm::ceil(glm::min(glm::min(a, b), c)), 0.0f);
    const glm::vec2 high =
        glm::min(glm::floor(glm::max(glm::max(a, b), c)), static_cast<float>(picture.size - 1));
    for (float y = low.y; y <= high.y; ++y)
        for (float x = low.x; x <= high.x; ++x) {
            const glm::vec2 p(x, y);
            const glm::vec3 weight =
                glm::vec3(cross(c - b, p - b), cross(a - c, p - c), cross(b - a, p - a)) / area;
            if (weight.x < 0 || weight.y < 0 || weight.z < 0) continue;
            const glm::vec3 shares = weight * glm::vec3(at[0].z, at[1].z, at[2].z);
            const float inverse = shares.x + shares.y + shares.z;
            const size_t pixel = static_cast<size_t>(y) * picture.size + static_cast<size_t>(x);
            if (inverse <= nearest[pixel]) continue;
            nearest[pixel] = inverse;
            const glm::vec2 uv =
                (corners[0].uv * shares.x + corners[1].uv * shares.y + corners[2].uv * shares.z) / inverse;
            picture.pixels[pixel] = sample(map, uv);
        }
}

} // namespace

Picture seenFlat(const ImageRgbF& display, const glm::mat3& envFromEye, int size) {
    return everyPixel(envFromEye, size, [&](const glm::vec3& ray) {
        return sample(display, latLongFromDirection(glm::normalize(ray)));
    });
}

Picture seenBySearch(const Frame& frame, const glm::vec3& eyeInFilm, const glm::mat3& envFromEye, int size) {
    return everyPixel(envFromEye, size, [&](const glm::vec3& ray) {
        const depth::Seen seen = depth::searchAlong(frame.widened, eyeInFilm, glm::normalize(ray));
        return sample(frame.display, latLongFromDirection(seen.dirEnv));
    });
}

Picture seenByCells(const Frame& frame, const glm::vec3& eyeInFilm, const glm::mat3& envFromEye, int size) {
    render::View view;
    view.verticalFov = std::numbers::pi_v<float> / 2;
    view.aspect = 1;
    render::BackgroundCells cells;
    cells.make(view, envFromEye, {size, size}, {&frame.widened, eyeInFilm});
    Picture picture{size, std::vector<glm::vec3>(static_cast<size_t>(size) * size)};
    for (const render::BackgroundCell& cell : cells.all())
        for (int y = cell.low.y; y < cell.high.y; ++y)
            for (int x = cell.low.x; x < cell.high.x; ++x) {
                const glm::vec2 share =
                    (glm::vec2(x, y) + 0.5f - glm::vec2(cell.low)) / glm::vec2(cell.high - cell.low);
                glm::vec2 uv = cell.first + share.x * cell.right + share.y * cell.up;
                if (cell.polar) {
                    const auto& d = cell.directions;
                    uv = latLongFromDirection(glm::normalize(
                        glm::mix(glm::mix(d[0], d[1], share.x), glm::mix(d[2], d[3], share.x), share.y)));
                }
                picture.pixels[static_cast<size_t>(y) * size + x] = sample(frame.display, uv);
            }
    return picture;
}

Picture seenByGrid(const Frame& frame, const glm::vec3& eyeInFilm, const glm::mat3& envFromEye, int size,
                   int step) {
    constexpr float kFurthest_m = 100; // distance that stands for infinity
    const int across = frame.depth.inverse.width / step, down = frame.depth.inverse.height / step;
    const glm::mat3 eyeFromEnv = glm::transpose(envFromEye);
    std::vector<Vertex> vertices;
    for (int y = 0; y <= down; ++y)
        for (int x = 0; x <= across; ++x) {
            const glm::vec2 uv(static_cast<float>(x) / static_cast<float>(across),
                               static_cast<float>(y) / static_cast<float>(down));
            const glm::vec3 direction = directionFromLatLong(uv);
            const float away = std::min(frame.depth.distance_m(direction), kFurthest_m);
            vertices.push_back({eyeFromEnv * (direction * away - eyeInFilm), uv});
        }
    Picture picture{size, std::vector<glm::vec3>(static_cast<size_t>(size) * size)};
    std::vector<float> nearest(picture.pixels.size(), 0);
    for (int y = 0; y < down; ++y)
        for (int x = 0; x < across; ++x) {
            const auto corner = [&](int dx, int dy) {
                return vertices[static_cast<size_t>(y + dy) * (across + 1) + x + dx];
            };
            fill({corner(0, 0), corner(1, 0), corner(0, 1)}, frame.display, picture, nearest);
            fill({corner(1, 0), corner(1, 1), corner(0, 1)}, frame.display, picture, nearest);
        }
    return picture;
}

} // namespace shoal::bench
