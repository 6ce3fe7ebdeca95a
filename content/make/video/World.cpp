#include "content/make/video/World.h"

#include "content/make/video/Ground.h"
#include "content/make/video/Growth.h"
#include "content/make/video/Light.h"
#include "engine/core/WriteFile.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>

namespace shoal::reef {

namespace {

constexpr float kTurn = 2 * std::numbers::pi_v<float>;
constexpr float kShadowTexel = 0.02f;
constexpr int kShadowSide = 1800;
constexpr float kSwayingSeen = 16; // metres; beyond, the water hides such small movements

bool traceRay(RTCScene scene, const vec3& origin, const vec3& dir, float furthest, RTCRayHit& ray) {
    ray.ray = {origin.x, origin.y, origin.z, 1e-4f, dir.x, dir.y, dir.z, 0, furthest, ~0u, 0, 0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(scene, ray);
    return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

void append(Mesh& all, Mesh&& part) {
    const auto base = static_cast<uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const glm::uvec3& t : part.triangles) all.triangles.push_back(t + base);
}

} // namespace

World::World(const Scene& scene, const Route& route)
    : scene_(scene), device_(rtcNewDevice(nullptr)),
      duration_(static_cast<float>(scene.film.frames) / static_cast<float>(scene.film.fps)),
      gridLow_(-16, scene.sandHeight - 1.1f, -16),
      gridCells_(65, static_cast<int>((1.5f - scene.sandHeight) / kGridCell + 0.5f) + 1, 65) {
    Mesh ground = makeSand(scene);
    for (const Rock& rock : scene.rocks) append(ground, makeRock(scene, rock));
    std::fprintf(stderr, "ground: %zu triangles\n", ground.triangles.size());
    raise(kStill, Mesh(ground));
    castShadows();
    Grown grown = grow(scene, route, ground, [this](const vec3& p) { return sunlitSoft(p); });
    append(ground, std::move(grown.still));
    for (const Lamp& lamp : scene.lamps)
        if (!lamp.carried) append(ground, makeLamp(lamp));
    std::fprintf(stderr, "still: %zu triangles, swaying: %zu\n", ground.triangles.size(),
                 grown.swaying.triangles.size());
    raise(kStill, std::move(ground));
    raise(kSwaying, std::move(grown.swaying));
    castShadows();
    lamps_ = Lamps(scene.lamps, scene.water, [this](const vec3& origin, const vec3& dir) {
        Hit hit;
        return trace(origin, dir, Lamps::kReach, hit) ? hit.distance : Lamps::kReach;
    });
}

void World::lightOnce(const Path& cache) {
    const uint64_t key =
        scene_.key ^ (parts_[kStill].vertices.size() * 1000003 + parts_[kSwaying].vertices.size());
    if (!load(cache, key)) {
        light();
        save(cache, key);
    }
    for (int pass = 0; pass < 4; ++pass) smooth(kStill);
}

void World::raise(Part part, Mesh&& raised) {
    const Mesh& mesh = parts_[part] = std::move(raised);
    indirect_[part].assign(mesh.vertices.size(), vec3(0));
    auto& scene = scenes_[part];
    scene.reset();
    if (mesh.triangles.empty()) return;
    const bool sways = part == kSwaying;
    if (sways) {
        moved_.clear();
        for (const Vertex& v : mesh.vertices) moved_.push_back(v.p);
        moved_.emplace_back(0); // Embree reads 16 bytes at the last vertex
    }
    scene.reset(rtcNewScene(device_.get()));
    if (sways) rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_DYNAMIC);
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    const void* vertices = sways ? static_cast<const void*>(moved_.data()) : mesh.vertices.data();
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices, 0,
                               sways ? sizeof(vec3) : sizeof(Vertex), mesh.vertices.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                               sizeof(glm::uvec3), mesh.triangles.size());
    if (sways) rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene.get(), geometry, 0);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
}

void World::putAnimal(Mesh&& animal) {
    constexpr int kRays = 512; // gathered once for a picture
    raise(kAnimal, std::move(animal));
    lightVertices(kAnimal, kRays);
}

bool World::isShadedByAnimal(const vec3& p) const {
    if (!scenes_[kAnimal]) return false;
    const vec3& d = scene_.sun.toSunWater;
    RTCRay ray{p.x, p.y, p.z, 0, d.x, d.y, d.z, 0, 100, ~0u, 0, 0};
    occlude(scenes_[kAnimal].get(), ray);
    return ray.tfar < 0;
}

// The surge moves all to and fro together, a little later and less regularly from place to place.
void World::advance(float turn, const vec3& camera) {
    const Mesh& mesh = parts_[kSwaying];
    const auto cycles = [&](float period) { return std::round(duration_ / period); };
    const float slow = cycles(5.4f), quick = cycles(2.3f), flutter = cycles(1.1f);
    lamps_.carry(camera);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vertex& v = mesh.vertices[i];
        const float sway =
            v.sway * glm::smoothstep(kSwayingSeen, 0.75f * kSwayingSeen, glm::distance(v.p, camera));
        const float place = v.p.x * 0.55f + v.p.z * 0.35f + v.p.y * 0.3f, here = v.p.x * 2.3f - v.p.z * 3.1f;
        const float a =
            std::sin(kTurn * slow * turn - place) + 0.35f * std::sin(kTurn * quick * turn - 2.1f * here);
        const float b = 0.45f * std::sin(kTurn * slow * turn - place - 1.1f) +
                        0.22f * std::sin(kTurn * flutter * turn + 3.3f * here);
        moved_[i] = v.p + sway * vec3(0.85f * a + 0.3f * b, -0.22f * a * a, 0.5f * a - 0.8f * b);
    }
    if (mesh.triangles.empty()) return;
    const RTCGeometry geometry = rtcGetGeometry(scenes_[kSwaying].get(), 0);
    rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(geometry);
    rtcCommitScene(scenes_[kSwaying].get());
}

bool World::trace(const vec3& origin, const vec3& dir, float furthest, Hit& hit) const {
    RTCRayHit ray, next;
    size_t part = kParts;
    for (size_t i = 0; i < kParts; ++i)
        if (scenes_[i] && traceRay(scenes_[i].get(), origin, dir, furthest, next)) {
            ray = next;
            furthest = ray.ray.tfar;
            part = i;
        }
    if (part == kParts) return false;
    const Mesh& mesh = parts_[part];
    const auto& indirect = indirect_[part];
    const glm::uvec3& t = mesh.triangles[ray.hit.primID];
    const float u = ray.hit.u, v = ray.hit.v, w = 1 - u - v;
    const Vertex &a = mesh.vertices[t.x], &b = mesh.vertices[t.y], &c = mesh.vertices[t.z];
    hit.distance = ray.ray.tfar;
    hit.p = origin + dir * hit.distance;
    hit.normal = glm::normalize(w * a.normal + u * b.normal + v * c.normal);
    hit.albedo = w * a.albedo + u * b.albedo + v * c.albedo;
    hit.indirect = w * indirect[t.x] + u * indirect[t.y] + v * indirect[t.z];
    hit.kind = a.kind;
    hit.glow = vec3(0);
    if (a.glow | b.glow | c.glow)
        hit.glow = w * glm::unpackF3x9_E1x5(a.glow) + u * glm::unpackF3x9_E1x5(b.glow) +
                   v * glm::unpackF3x9_E1x5(c.glow);
    return true;
}

void World::castShadows() {
    shadow_.assign(static_cast<size_t>(kShadowSide) * kShadowSide, -1e9f);
    const vec3 down = -scene_.sun.toSunWater;
#pragma omp parallel for schedule(dynamic, 16)
    for (int z = 0; z < kShadowSide; ++z)
        for (int x = 0; x < kShadowSide; ++x) {
            Hit hit;
            const vec3 origin((static_cast<float>(x) - kShadowSide / 2) * kShadowTexel, 0,
                              (static_cast<float>(z) - kShadowSide / 2) * kShadowTexel);
            if (trace(origin, down, 100, hit)) shadow_[static_cast<size_t>(z * kShadowSide + x)] = hit.p.y;
        }
}

float World::sunlit(const vec3& p) const {
    const vec3& up = scene_.sun.toSunWater;
    const vec2 q =
        (vec2(p.x, p.z) - vec2(up.x, up.z) * (p.y / up.y)) / kShadowTexel + 0.5f * kShadowSide + 0.5f;
    const int x = static_cast<int>(q.x), z = static_cast<int>(q.y);
    if (x < 0 || z < 0 || x >= kShadowSide || z >= kShadowSide) return 1;
    return p.y > shadow_[static_cast<size_t>(z * kShadowSide + x)] - 0.03f ? 1.0f : 0.0f;
}

float World::sunlitSoft(const vec3& p) const {
    const vec3& up = scene_.sun.toSunWater;
    const vec2 q = (vec2(p.x, p.z) - vec2(up.x, up.z) * (p.y / up.y)) / kShadowTexel + 0.5f * kShadowSide;
    if (q.x < 40 || q.y < 40 || q.x > kShadowSide - 40 || q.y > kShadowSide - 40) return 1;
    const auto heightAt = [&](const vec2& r) {
        return shadow_[static_cast<size_t>(static_cast<int>(r.y + 0.5f) * kShadowSide +
                                           static_cast<int>(r.x + 0.5f))];
    };
    // Bilinear between compared texels, so that the edge of a near shadow is smooth.
    const auto lit = [&](const vec2& r) {
        const vec2 base = glm::floor(r), f = r - base;
        const float* row = shadow_.data() + static_cast<size_t>(static_cast<int>(base.y) * kShadowSide +
                                                                static_cast<int>(base.x));
        const auto clear = [&](float height) { return std::clamp((p.y - height) * 40 + 2, 0.0f, 1.0f); };
        return (clear(row[0]) * (1 - f.x) + clear(row[1]) * f.x) * (1 - f.y) +
               (clear(row[kShadowSide]) * (1 - f.x) + clear(row[kShadowSide + 1]) * f.x) * f.y;
    };
    float gap = 0;
    constexpr vec2 kProbe[5] = {{0, 0}, {7, 2}, {-2, 7}, {-7, -2}, {2, -7}};
    for (const vec2& o : kProbe) gap = std::max(gap, heightAt(q + o) - p.y);
    const float radius = std::clamp(0.035f * gap, 0.012f, 0.22f) / kShadowTexel;
    constexpr vec2 kDisc[7] = {{0, 0},         {0.9f, 0.2f},     {0.28f, 0.87f}, {-0.62f, 0.67f},
                               {-0.9f, -0.2f}, {-0.28f, -0.87f}, {0.62f, -0.67f}};
    float sum = 0;
    for (const vec2& o : kDisc) sum += lit(q + o * radius);
    return sum / 7;
}

bool World::load(const Path& cache, uint64_t key) {
    auto bytes = readFile(cache, 1ull << 32);
    uint64_t found = 0;
    size_t wanted = sizeof key;
    grid_.resize(1);
    for (const auto& part : indirect_) wanted += part.size() * sizeof(vec3);
    if (!bytes || bytes->size() < wanted) return false;
    std::memcpy(&found, bytes->data(), sizeof found);
    if (found != key) return false;
    const uint8_t* from = bytes->data() + sizeof key;
    for (auto& part : indirect_) {
        std::memcpy(part.data(), from, part.size() * sizeof(vec3));
        from += part.size() * sizeof(vec3);
    }
    grid_.resize((bytes->size() - wanted) / sizeof(vec3));
    std::memcpy(grid_.data(), from, grid_.size() * sizeof(vec3));
    return true;
}

void World::save(const Path& cache, uint64_t key) const {
    std::string bytes(reinterpret_cast<const char*>(&key), sizeof key);
    for (const auto& part : indirect_)
        bytes.append(reinterpret_cast<const char*>(part.data()), part.size() * sizeof(vec3));
    bytes.append(reinterpret_cast<const char*>(grid_.data()), grid_.size() * sizeof(vec3));
    if (const Status kept = writeFileWhole(cache, bytes); !kept)
        std::fprintf(stderr, "%s\n", kept.error().message().c_str());
}

} // namespace shoal::reef
