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

glm::dvec3 towards(double longitude_deg, double latitude_deg) {
    const double lon = longitude_deg * kDegree, lat = latitude_deg * kDegree;
    return {std::cos(lat) * std::sin(lon), std::sin(lat), -std::cos(lat) * std::cos(lon)};
}

constexpr double kEye_m = 1.7; // above the ground

// Where a trunk stands (degrees to the right, metres away), and its radius.
struct Trunk {
    double longitude_deg, distance, radius;
};

// Distance along the level part of the ray, and how far round the trunk it hits, -1 to 1; or none.
struct Hit {
    double distance = 1e9, across = 0, height = 0; // height: above the eye
    int trunk = -1;
};

Hit nearestTrunk(const std::vector<Trunk>& trunks, const glm::dvec3& dir) {
    Hit hit;
    const double level = std::hypot(dir.x, dir.z);
    for (size_t k = 0; k < trunks.size(); ++k) {
        const Trunk& trunk = trunks[k];
        const double turn = std::atan2(dir.x, -dir.z) - trunk.longitude_deg * kDegree;
        const double across = trunk.distance * std::sin(turn);
        if (std::abs(across) > trunk.radius || std::cos(turn) < 0) continue;
        const double distance =
            trunk.distance * std::cos(turn) - std::sqrt(trunk.radius * trunk.radius - across * across);
        const double height = distance * dir.y / level;
        if (height < -kEye_m || distance >= hit.distance) continue;
        hit = {distance, across / trunk.radius, height, static_cast<int>(k)};
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

Scene forest(int width, int height) {
    const glm::dvec3 window = towards(-12, 7);
    std::vector<Trunk> trunks = {{-20, 11, 0.2}, {-4, 9, 0.2}};
    for (int k = 0; k < 26; ++k) {
        const double around = -38 + 76 * (k + 0.6 * lattice(k, 1, 5)) / 26;
        if (std::abs(around + 12) < 7.5) continue; // the clearing
        trunks.push_back({around, 9 + 26 * lattice(k, 2, 5), 0.1 + 0.2 * lattice(k, 3, 5)});
    }
    return photograph(width, height, window, [=](const glm::dvec3& dir) {
        const double lon = std::atan2(dir.x, -dir.z) / kDegree, lat = std::asin(dir.y) / kDegree;
        const double rag = clouds(lon * 0.5, lat * 0.5, 5, 11) - 0.5;
        const double off = std::hypot((lon + 12) / 5, (lat - 7) / 6.5) + 0.9 * rag;
        const double open = glm::smoothstep(1.1, 0.75, off), haze = std::exp(-std::max(0.0, off - 0.8) / 1.8);
        const glm::dvec3 mist = glm::dvec3(0.30, 0.42, 0.24) * (0.12 + 1.3 * haze);
        const Hit hit = nearestTrunk(trunks, dir);
        const double reach = dir.y < 0 ? kEye_m / -dir.y : 1e9;
        const auto veiled = [&](const glm::dvec3& c, double away) {
            return glm::mix(c, mist, 1 - std::exp(-away / 26));
        };
        if (hit.trunk >= 0 && hit.distance < reach) {
            const double bark = clouds(hit.across * 5 + hit.trunk * 11, hit.height * 0.8, 5, 50);
            const double lit = std::max(0.0, -hit.across * ((lon + 12) > 0 ? 1 : -1));
            return veiled(glm::dvec3(0.085, 0.06, 0.042) * (0.35 + 1.1 * bark) * (0.5 + 2.2 * lit * haze),
                          hit.distance);
        }
        if (dir.y < 0) {
            const double x = dir.x * reach, z = -dir.z * reach;
            const double leaf = clouds(x * 5, z * 5, 6, 60), moss = clouds(x * 0.5, z * 0.5, 4, 70);
            const glm::dvec3 ground = glm::mix(glm::dvec3(0.13, 0.085, 0.04), glm::dvec3(0.09, 0.13, 0.035),
                                               glm::smoothstep(0.4, 0.65, moss));
            const double sunny = std::exp(-std::abs(lon + 12) / 9) *
                                 glm::smoothstep(0.35, 0.75, clouds(x * 0.9, z * 0.5, 3, 80));
            return veiled(ground * (0.35 + 1.3 * leaf) + glm::dvec3(0.35, 0.34, 0.16) * sunny, reach);
        }
        const double leaves = clouds(lon * 0.9, lat * 0.9, 7, 90);
        const double canopy = glm::smoothstep(4.0, 24.0, lat + 14 * (leaves - 0.5));
        glm::dvec3 back =
            glm::mix(mist * (0.7 + 0.6 * leaves), glm::dvec3(0.05, 0.09, 0.025) * (0.3 + 2 * leaves * leaves),
                     canopy * (1 - open));
        const double gap = glm::smoothstep(0.66, 0.74, leaves) * (1 - open) * 0.35;
        return back + glm::dvec3(0.55, 0.62, 0.4) * gap + glm::dvec3(2.6, 2.5, 2.0) * open;
    });
}

} // namespace shoal::bench
