#include "Truth.h"

#include "engine/math/SphericalHarmonics.h"

#include <algorithm>
#include <numbers>

namespace shoal {

namespace {

constexpr float kGap_m = 2e-5f; // of a ray's start from its surface
constexpr float kFar_m = 100;

double uniform(uint64_t& state) { // SplitMix64: Steele, Lea and Flood 2014
    uint64_t z = (state += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

glm::vec3 cosineDirection(const glm::vec3& normal, double u, double v) {
    const glm::vec3 side = std::abs(normal.y) > 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 x = glm::normalize(glm::cross(side, normal)), y = glm::cross(normal, x);
    const double r = std::sqrt(u), angle = 2 * std::numbers::pi * v;
    return glm::normalize(static_cast<float>(r * std::cos(angle)) * x +
                          static_cast<float>(r * std::sin(angle)) * y +
                          static_cast<float>(std::sqrt(std::max(0.0, 1 - u))) * normal);
}

constexpr size_t kNone = ~size_t{0};

} // namespace

std::vector<SurfacePoint> scatter(const OcclusionScene& scene, size_t body, int count) {
    const scene::Surface& s = scene.bodies[body].surface;
    std::vector<double> areas = {0};
    for (size_t i = 0; i < s.indices.size(); i += 3) {
        const glm::vec3& a = s.positions[s.indices[i]];
        areas.push_back(areas.back() + glm::length(glm::cross(s.positions[s.indices[i + 1]] - a,
                                                              s.positions[s.indices[i + 2]] - a)));
    }
    std::vector<SurfacePoint> points;
    uint64_t state = 1;
    for (int k = 0; k < count; ++k) {
        const double at = (k + uniform(state)) / count * areas.back();
        const size_t t = std::min<size_t>(
            static_cast<size_t>(std::upper_bound(areas.begin(), areas.end(), at) - areas.begin()),
            areas.size() - 1);
        const uint32_t* corner = &s.indices[3 * (t - 1)];
        double u = uniform(state), v = uniform(state);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const auto mix = [&](const auto& of) {
            return static_cast<float>(1 - u - v) * of[corner[0]] + static_cast<float>(u) * of[corner[1]] +
                   static_cast<float>(v) * of[corner[2]];
        };
        points.push_back(
            {body, mix(s.positions), glm::normalize(mix(s.normals)), mix(scene.bodies[body].selfOcclusion)});
    }
    return points;
}

Truth::Truth(const OcclusionScene& scene, const ImageRgbF& light) : scene_(scene), light_(light) {
    for (const SceneBody& body : scene.bodies)
        trees_.emplace_back(body.surface.positions, body.surface.indices);
}

std::optional<Truth::Met> Truth::meet(const glm::vec3& from, const glm::vec3& direction,
                                      size_t leftOut) const {
    std::optional<occlusion::Bvh::Touch> nearest;
    Met met;
    for (size_t b = 0; b < trees_.size(); ++b) {
        if (b == leftOut) continue;
        const auto touch = trees_[b].first(from, direction, kGap_m, nearest ? nearest->distance : kFar_m);
        if (touch) nearest = touch, met.body = b;
    }
    if (!nearest) return {};
    const scene::Surface& s = scene_.bodies[met.body].surface;
    const uint32_t* corner = &s.indices[3 * size_t{nearest->triangle}];
    const glm::vec3& a = s.positions[corner[0]];
    met.normal = glm::normalize(glm::cross(s.positions[corner[1]] - a, s.positions[corner[2]] - a));
    met.fromInside = glm::dot(met.normal, direction) > 0;
    if (met.fromInside) met.normal = -met.normal;
    met.place = from + nearest->distance * direction;
    return met;
}

glm::dvec3 Truth::radiance(const glm::vec3& direction) const {
    const glm::vec2 uv = latLongFromDirection(direction);
    const float* texel =
        light_.at(std::min(static_cast<int>(uv.x * static_cast<float>(light_.width)), light_.width - 1),
                  std::min(static_cast<int>(uv.y * static_cast<float>(light_.height)), light_.height - 1));
    return {texel[0], texel[1], texel[2]};
}

glm::dvec3 Truth::unoccluded(const glm::vec3& normal) const {
    glm::dvec3 sum(0);
    math::eachTexel(light_, [&](const glm::dvec3& radiance, double solidAngle, const glm::dvec3& dir) {
        sum += std::max(0.0, glm::dot(dir, glm::dvec3(normal))) * solidAngle * radiance;
    });
    return sum / std::numbers::pi;
}

// Returns the light that a surface reflects along one path.
glm::dvec3 Truth::reflected(const Met& at, int bounces, uint64_t& state) const {
    if (bounces == 0) return glm::dvec3(0);
    const double u = uniform(state), v = uniform(state);
    const glm::vec3 direction = cosineDirection(at.normal, u, v);
    const auto met = meet(at.place, direction, kNone);
    return glm::dvec3(scene_.bodies[at.body].albedo) *
           (met ? reflected(*met, bounces - 1, state) : radiance(direction));
}

bool Truth::buried(const SurfacePoint& at) const {
    uint64_t state = 7;
    int behind = 0, rays = 33;
    for (int k = 0; k < rays; ++k) {
        const double u = uniform(state), v = uniform(state);
        const glm::vec3 direction = cosineDirection(at.normal, u, v);
        const auto met = meet(at.position, direction, at.body);
        behind += met && met->fromInside;
    }
    return 2 * behind > rays;
}

glm::dvec3 Truth::lost(const SurfacePoint& at, bool self, int bounces, int rays) const {
    uint64_t state =
        12345 + static_cast<uint64_t>(at.position.x * 1e6f) + static_cast<uint64_t>(at.position.z * 1e7f);
    const double shift = uniform(state), turn = uniform(state);
    glm::dvec3 sum(0);
    for (int k = 0; k < rays; ++k) { // a lattice by the golden section, shifted
        double u = (k + 0.5) / rays + shift, v = k * 0.6180339887498949 + turn;
        u -= std::floor(u), v -= std::floor(v);
        const glm::vec3 direction = cosineDirection(at.normal, u, v);
        if (const auto met = meet(at.position, direction, self ? kNone : at.body))
            sum += radiance(direction) - reflected(*met, bounces, state);
    }
    return sum / static_cast<double>(rays);
}

} // namespace shoal
