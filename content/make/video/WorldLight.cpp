// Indirect light, which other surfaces and the water send on: gathered once, for every vertex and for a grid
// of places in the water.
#include "content/make/video/World.h"

#include "content/make/video/Light.h"
#include "engine/core/Random.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace shoal::reef {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
// Returns point i of Roberts' sequence, which is even over the unit square, shifted by a random vector.
vec2 spread(int i, const vec2& shift) {
    const vec2 p = shift + static_cast<float>(i) * vec2(0.7548776662f, 0.5698402910f);
    return p - glm::floor(p);
}

} // namespace

void World::light() {
    grid_.assign(cell(0, 0, gridCells_.z), vec3(-1));
    lightGrid(16);
    for (const Part part : {kStill, kSwaying}) lightVertices(part, 4);
    lightGrid(32);
    for (const Part part : {kStill, kSwaying}) lightVertices(part, 14);
    lightGrid(64);
}

// Returns the radiance that arrives at origin from dir, without the sun's direct light.
vec3 World::incoming(const vec3& origin, const vec3& dir, bool& fromBehind) const {
    Hit hit;
    const bool met = trace(origin, dir, 60, hit);
    float distance = met ? hit.distance : 60;
    vec3 behind(0);
    fromBehind = met && glm::dot(hit.normal, dir) > 0.2f;
    if (met) {
        const vec3 sun =
            sunAtDepth(scene_, -hit.p.y) * (sunlit(hit.p + hit.normal * 0.03f) *
                                            std::max(glm::dot(hit.normal, scene_.sun.toSunWater), 0.0f));
        vec3 irradiance = sun + hit.indirect;
        for (const Lamps::Arriving& light : lamps_.at(hit.p + hit.normal * 0.02f))
            irradiance += light.irradiance * std::max(glm::dot(hit.normal, light.toLamp), 0.0f);
        behind = fromBehind ? vec3(0) : hit.albedo * irradiance / kPi;
        // Rays would hit a lamp's small glass by chance only; its light is counted directly by lamps_.
        if (hit.kind != Kind::Lamp) behind += hit.glow;
    } else if (dir.y > 0.02f) {
        distance = std::min(-origin.y / dir.y, 60.0f);
        const Window window = throughSurface(dir, vec3(0, 1, 0));
        if (window.through > 0)
            behind = skyRadiance(scene_, window.dirAir) * (window.through * kWaterIndex * kWaterIndex);
    }
    const vec3 middle = origin + dir * std::min(0.5f * distance, 3.0f),
               through = scene_.water.transmittance(distance);
    const vec3 sun = sunAtDepth(scene_, -middle.y) *
                     (sunlit(middle) * scene_.water.phase(glm::dot(-scene_.sun.toSunWater, -dir)));
    vec3 source = sun + ambient(middle);
    for (const Lamps::Arriving& light : lamps_.at(middle))
        source += light.irradiance * scene_.water.phase(glm::dot(light.toLamp, dir));
    const vec3 veil = scene_.water.scattered * source;
    return behind * through + veil * (1.0f - through);
}

void World::lightGrid(int rays) {
    const std::vector<vec3> before = grid_;
    std::vector<vec3> next(grid_.size());
    std::vector<uint8_t> solid(grid_.size());
#pragma omp parallel for schedule(dynamic)
    for (int z = 0; z < gridCells_.z; ++z)
        for (int y = 0; y < gridCells_.y; ++y)
            for (int x = 0; x < gridCells_.x; ++x) {
                const vec3 p = gridLow_ + vec3(x, y, z) * kGridCell;
                Random random(cell(x, y, z), 3);
                const vec2 shift(random.unit(), random.unit());
                vec3 sum(0);
                int behind = 0;
                for (int i = 0; i < rays; ++i) {
                    const vec2 s = spread(i, shift);
                    const float up = 2 * s.x - 1, ring = std::sqrt(1 - up * up);
                    bool fromBehind = false;
                    sum += incoming(p, {ring * std::cos(2 * kPi * s.y), up, ring * std::sin(2 * kPi * s.y)},
                                    fromBehind);
                    behind += fromBehind;
                }
                next[cell(x, y, z)] = sum / static_cast<float>(rays);
                solid[cell(x, y, z)] = behind * 5 > rays;
            }
    // Places within rock take their neighbours' light, so that it can be interpolated up to the wall.
    for (int pass = 0; pass < 3; ++pass) {
        const auto was = solid;
        for (int z = 1; z + 1 < gridCells_.z; ++z)
            for (int y = 1; y + 1 < gridCells_.y; ++y)
                for (int x = 1; x + 1 < gridCells_.x; ++x) {
                    if (!was[cell(x, y, z)]) continue;
                    vec3 sum(0);
                    int count = 0;
                    for (int i = 0; i < 27; ++i) {
                        const size_t other = cell(x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1);
                        if (!was[other]) sum += next[other], ++count;
                    }
                    if (count)
                        next[cell(x, y, z)] = sum / static_cast<float>(count), solid[cell(x, y, z)] = 0;
                }
    }
    grid_ = next;
}

vec3 World::ambient(const vec3& p) const {
    if (grid_[0].x < 0) return 0.03f * sunAtDepth(scene_, -p.y);
    const vec3 q = glm::clamp((p - gridLow_) / kGridCell, vec3(0), vec3(gridCells_) - 1.01f),
               base = glm::floor(q), f = q - base;
    const int x = static_cast<int>(base.x), y = static_cast<int>(base.y), z = static_cast<int>(base.z);
    const vec3* at = grid_.data() + cell(x, y, z);
    const auto row = [&](int j, int k) {
        const vec3* r = at + cell(0, j, k);
        return r[0] * (1 - f.x) + r[1] * f.x;
    };
    return (row(0, 0) * (1 - f.y) + row(1, 0) * f.y) * (1 - f.z) +
           (row(0, 1) * (1 - f.y) + row(1, 1) * f.y) * f.z;
}

void World::lightVertices(Part part, int rays) {
    const Mesh& mesh = parts_[part];
    std::vector<vec3> next(mesh.vertices.size());
#pragma omp parallel for schedule(dynamic, 4096)
    for (size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vertex& v = mesh.vertices[i];
        // Ground is broad and shows the noise of few rays. Leaves are too small for that, and much water
        // hides far things.
        const bool far = glm::dot(v.p, v.p) > 13 * 13;
        const bool ground = v.kind == Kind::Sand || v.kind == Kind::Rock;
        Random random(i, part);
        const vec2 shift(random.unit(), random.unit());
        const glm::mat3 frame = frameAlong(v.normal, 0);
        const int count = std::max(rays / (far ? 6 : ground ? 1 : v.kind == Kind::Leaf ? 4 : 2), 2);
        vec3 sum(0);
        for (int k = 0; k < count; ++k) {
            const vec2 s = spread(k, shift);
            const float ring = std::sqrt(s.x), up = std::sqrt(1 - s.x);
            bool fromBehind = false;
            vec3 d = frame * vec3(ring * std::cos(2 * kPi * s.y), up, ring * std::sin(2 * kPi * s.y));
            if (v.kind == Kind::Leaf && (k & 1)) d = -d; // thin: light passes it
            sum += incoming(v.p + (v.kind == Kind::Leaf ? d : v.normal) * 0.012f, d, fromBehind);
        }
        next[i] = sum * (kPi / static_cast<float>(count));
    }
    indirect_[part] = next;
    for (int pass = 0; pass < 2; ++pass) smooth(part);
    std::fprintf(stderr, "lit %zu vertices with %d rays each\n", next.size(), rays);
}

// Smooths the noise of few rays: blends each vertex half and half with its neighbours' mean.
void World::smooth(size_t part) {
    const Mesh& mesh = parts_[part];
    std::vector<vec3> sum(mesh.vertices.size());
    std::vector<float> count(mesh.vertices.size());
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) {
            sum[t[i]] += indirect_[part][t[(i + 1) % 3]] + indirect_[part][t[(i + 2) % 3]];
            count[t[i]] += 2;
        }
    for (size_t i = 0; i < sum.size(); ++i)
        if (count[i] > 0) indirect_[part][i] = 0.5f * (indirect_[part][i] + sum[i] / count[i]);
}

} // namespace shoal::reef
