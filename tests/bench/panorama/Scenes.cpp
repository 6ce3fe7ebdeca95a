#include "tests/bench/panorama/Scenes.h"
#include "engine/math/Colour.h"
#include "tests/bench/Bench.h"

namespace shoal::bench {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

double lattice(int x, int y, int seed) {
    uint32_t h = static_cast<uint32_t>(x) * 0x9e3779b1u ^ static_cast<uint32_t>(y) * 0x85ebca77u ^
                 static_cast<uint32_t>(seed) * 0xc2b2ae3du;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return (h ^ h >> 15) / 4294967296.0;
}

// Value noise, 0 to 1.
double noise(double x, double y, int seed) {
    const double fx = std::floor(x), fy = std::floor(y);
    const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
    const auto ease = [](double t) { return t * t * (3 - 2 * t); };
    const double tx = ease(x - fx), ty = ease(y - fy);
    const double top = lattice(ix, iy, seed) * (1 - tx) + lattice(ix + 1, iy, seed) * tx;
    const double low = lattice(ix, iy + 1, seed) * (1 - tx) + lattice(ix + 1, iy + 1, seed) * tx;
    return top * (1 - ty) + low * ty;
}

double clouds(double x, double y, int octaves, int seed) {
    double sum = 0, part = 0.5;
    for (int k = 0; k < octaves; ++k, part /= 2, x *= 2.03, y *= 2.03) sum += part * noise(x, y, seed + k);
    return sum / (1 - 2 * part);
}

double step(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

glm::dvec3 mixed(const glm::dvec3& a, const glm::dvec3& b, double t) { return a + (b - a) * t; }

glm::dvec3 towards(double longitude_deg, double latitude_deg) {
    const double lon = longitude_deg * kDegree, lat = latitude_deg * kDegree;
    return {std::cos(lat) * std::sin(lon), std::sin(lat), -std::cos(lat) * std::cos(lon)};
}

// An upright round post: where it stands (degrees to the right, metres away), its radius and ends, metres
// above the eye.
struct Post {
    double longitude_deg, distance, radius, bottom, top;
};

// Distance along the level part of the ray, and how far round the post it hits, -1 to 1; or none.
struct Hit {
    double distance = 1e9, across = 0, height = 0;
    int post = -1;
};

Hit nearestPost(const std::vector<Post>& posts, const glm::dvec3& dir) {
    Hit hit;
    const double level = std::hypot(dir.x, dir.z);
    for (size_t k = 0; k < posts.size(); ++k) {
        const Post& post = posts[k];
        const double turn = std::atan2(dir.x, -dir.z) - post.longitude_deg * kDegree;
        const double across = post.distance * std::sin(turn);
        if (std::abs(across) > post.radius || std::cos(turn) < 0) continue;
        const double distance =
            post.distance * std::cos(turn) - std::sqrt(post.radius * post.radius - across * across);
        const double height = distance * dir.y / level;
        if (height < post.bottom || height > post.top || distance >= hit.distance) continue;
        hit = {distance, across / post.radius, height, static_cast<int>(k)};
    }
    return hit;
}

// colour: linear, by direction.
template <class Colour> Scene photograph(int width, int height, const glm::dvec3& light, Colour&& colour) {
    const double focal = width / 2.0 / std::tan(kSceneFov_deg / 2 * kDegree);
    Scene scene{ImageRgb8(width, height),
                {width / 2.0 + focal * light.x / -light.z, height / 2.0 - focal * light.y / -light.z}};
    onAllCores(static_cast<size_t>(height), [&](size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 seen = glm::min(
                colour(glm::normalize(glm::dvec3(x + 0.5 - width / 2.0, height / 2.0 - y - 0.5, -focal))),
                glm::dvec3(1));
            for (int c = 0; c < 3; ++c)
                scene.photo.at(x, y)[c] =
                    static_cast<uint8_t>(std::lround(255 * math::srgbFromLinear(std::max(0.0, seen[c]))));
        }
    });
    return scene;
}

} // namespace

Scene beach(int width, int height) {
    const glm::dvec3 sun = towards(9, 10);
    const std::vector<Post> posts = {{4, 7, 0.16, -1.6, 2.4},    {14.5, 7, 0.16, -1.6, 2.4},
                                     {-6, 9, 0.16, -1.6, 1.9},   {24, 8, 0.16, -1.6, 2.0},
                                     {-17, 12, 0.16, -1.6, 1.6}, {-26, 15, 0.16, -1.6, 1.4},
                                     {29.5, 11, 0.16, -1.6, 1.7}};
    return photograph(width, height, sun, [=](const glm::dvec3& dir) {
        const double toSun = std::acos(std::clamp(glm::dot(dir, sun), -1.0, 1.0)) / kDegree;
        const double glow = std::exp(-toSun / 9), wide = std::exp(-toSun / 35);
        const Hit hit = nearestPost(posts, dir);
        if (hit.post >= 0) {
            const double grain = clouds(hit.across * 4 + hit.post * 7, hit.height * 1.5, 4, 40);
            const double lit = std::max(0.0, hit.across * (posts[hit.post].longitude_deg < 9 ? 1 : -1));
            return glm::dvec3(0.10, 0.065, 0.045) * (0.4 + 0.9 * grain) * (0.5 + 2.5 * lit * lit);
        }
        if (dir.y > 0) {
            const double high = dir.y / (dir.y + 0.35);
            glm::dvec3 sky = mixed({0.62, 0.42, 0.30}, {0.10, 0.20, 0.42}, std::pow(high, 0.7));
            sky += glm::dvec3(1.0, 0.62, 0.28) * (0.9 * glow + 0.25 * wide);
            const double flat = 1 / (dir.y + 0.12);
            const double cover = clouds(dir.x * flat * 1.3, dir.z * flat * 3, 6, 3);
            sky =
                mixed(sky, glm::dvec3(0.75, 0.52, 0.42) * (0.6 + 1.2 * wide), 0.75 * step(0.5, 0.75, cover));
            return toSun < 1 ? glm::dvec3(4) : sky;
        }
        const double reach = 1.6 / std::max(-dir.y, 1e-3); // of the ray, eye 1.6 m above the water
        const double x = dir.x * reach, z = -dir.z * reach;
        const double shore = 6.5 + 0.7 * std::sin(x * 0.35) + 0.5 * noise(x * 0.8, 1, 9);
        if (z > shore) {
            const double wave = clouds(x * 0.7, z * 2.2, 4, 20) - 0.5;
            const double fade = 1 / (1 + reach / 60);
            const double along = std::abs(std::atan2(dir.x, -dir.z) / kDegree - 9 + wave * fade * 14);
            const double path = std::exp(-along / 3.5);
            const glm::dvec3 sea = mixed({0.10, 0.16, 0.20}, {0.42, 0.32, 0.27}, 1 - fade);
            const glm::dvec3 foam =
                glm::dvec3(0.7, 0.66, 0.6) * step(0.7, 0.1, std::abs(z - shore - 0.4 - wave));
            return sea * (1 + 1.1 * wave * fade) + glm::dvec3(1, 0.65, 0.32) * (0.9 * path) + foam;
        }
        const double ripple = std::sin(z * 9 + 2.5 * clouds(x, z, 3, 30) * 6) * 0.08;
        const double sand = 0.75 + ripple + 0.5 * (clouds(x * 9, z * 9, 5, 33) - 0.5);
        const double wet = step(1.6, 0.1, shore - z);
        return glm::dvec3(0.42, 0.32, 0.22) * sand * (1 - 0.45 * wet) + glm::dvec3(0.3, 0.18, 0.08) * wide;
    });
}

Scene forest(int width, int height) {
    const glm::dvec3 window = towards(-12, 7);
    std::vector<Post> trunks = {{-20, 11, 0.2, -1.7, 40}, {-4, 9, 0.2, -1.7, 40}};
    for (int k = 0; k < 26; ++k) {
        const double around = -38 + 76 * (k + 0.6 * lattice(k, 1, 5)) / 26;
        if (std::abs(around + 12) < 7.5) continue; // the clearing
        trunks.push_back({around, 9 + 26 * lattice(k, 2, 5), 0.1 + 0.2 * lattice(k, 3, 5), -1.7, 40});
    }
    return photograph(width, height, window, [=](const glm::dvec3& dir) {
        const double lon = std::atan2(dir.x, -dir.z) / kDegree, lat = std::asin(dir.y) / kDegree;
        const double rag = clouds(lon * 0.5, lat * 0.5, 5, 11) - 0.5;
        const double off = std::hypot((lon + 12) / 5, (lat - 7) / 6.5) + 0.9 * rag;
        const double open = step(1.1, 0.75, off), haze = std::exp(-std::max(0.0, off - 0.8) / 1.8);
        const glm::dvec3 mist = glm::dvec3(0.30, 0.42, 0.24) * (0.12 + 1.3 * haze);
        const Hit hit = nearestPost(trunks, dir);
        const double reach = dir.y < 0 ? 1.7 / -dir.y : 1e9;
        const auto veiled = [&](const glm::dvec3& c, double away) {
            return mixed(c, mist, 1 - std::exp(-away / 26));
        };
        if (hit.post >= 0 && hit.distance < reach) {
            const double bark = clouds(hit.across * 5 + hit.post * 11, hit.height * 0.8, 5, 50);
            const double lit = std::max(0.0, -hit.across * ((lon + 12) > 0 ? 1 : -1));
            return veiled(glm::dvec3(0.085, 0.06, 0.042) * (0.35 + 1.1 * bark) * (0.5 + 2.2 * lit * haze),
                          hit.distance);
        }
        if (dir.y < 0) {
            const double x = dir.x * reach, z = -dir.z * reach;
            const double leaf = clouds(x * 5, z * 5, 6, 60), moss = clouds(x * 0.5, z * 0.5, 4, 70);
            const glm::dvec3 ground = mixed({0.13, 0.085, 0.04}, {0.09, 0.13, 0.035}, step(0.4, 0.65, moss));
            const double sunny =
                std::exp(-std::abs(lon + 12) / 9) * step(0.35, 0.75, clouds(x * 0.9, z * 0.5, 3, 80));
            return veiled(ground * (0.35 + 1.3 * leaf) + glm::dvec3(0.35, 0.34, 0.16) * sunny, reach);
        }
        const double leaves = clouds(lon * 0.9, lat * 0.9, 7, 90);
        const double canopy = step(4, 24, lat + 14 * (leaves - 0.5));
        glm::dvec3 back =
            mixed(mist * (0.7 + 0.6 * leaves), glm::dvec3(0.05, 0.09, 0.025) * (0.3 + 2 * leaves * leaves),
                  canopy * (1 - open));
        const double gap = step(0.66, 0.74, leaves) * (1 - open) * 0.35;
        return back + glm::dvec3(0.55, 0.62, 0.4) * gap + glm::dvec3(2.6, 2.5, 2.0) * open;
    });
}

} // namespace shoal::bench
