#include "content/make/video/Ground.h"

#include "content/make/video/Noise.h"

#include <algorithm>
#include <cmath>

namespace shoal::reef {

namespace {

float ellipsoid(const vec3& p, const vec3& radius) {
    const float k0 = glm::length(p / radius), k1 = glm::length(p / (radius * radius));
    return k1 > 1e-6f ? k0 * (k0 - 1) / k1 : -std::min({radius.x, radius.y, radius.z});
}

float smoothMin(float a, float b, float k) {
    const float h = std::max(k - std::fabs(a - b), 0.0f) / k;
    return std::min(a, b) - h * h * k * 0.25f;
}

// Returns the rock's distance without its fine relief; the noise below moves it by less than kRelief.
constexpr float kRelief = 0.75f;
float coarseDistance(const Rock& rock, const vec3& p) {
    float d = 1e9f;
    for (const Blob& blob : rock.blobs) d = smoothMin(d, ellipsoid(p - blob.centre, blob.radius), 0.5f);
    float tube = 1e9f;
    for (const auto& joints : rock.carve)
        for (size_t i = 0; i + 1 < joints.size(); ++i) {
            const vec3 a(joints[i]), along = vec3(joints[i + 1]) - a;
            const float t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0f, 1.0f);
            tube = smoothMin(tube, glm::length(p - a - along * t) - glm::mix(joints[i].w, joints[i + 1].w, t),
                             0.3f);
        }
    return rock.carve.empty() ? d : -smoothMin(-d, tube, 0.35f);
}

float rockDistance(const Rock& rock, const vec3& p) {
    const vec3 warp = 0.32f * vec3(fractalNoise(p * 0.9f, 2), fractalNoise(p * 0.9f + 31.0f, 2),
                                   fractalNoise(p * 0.9f + 67.0f, 2));
    float d = coarseDistance(rock, p + warp);
    if (std::fabs(d) > kRelief) return d;
    // Ledges: layers of harder and softer rock, a hand high; the softer ones are worn back.
    const float bed = p.y * 2.6f + 2.2f * fractalNoise(p * 0.7f + 5.0f, 2);
    d += 0.04f * (std::fabs(bed - std::floor(bed) - 0.5f) * 4 - 1) *
         std::clamp(0.6f + 2 * gradientNoise(p * 0.4f + 9.0f), 0.0f, 1.0f);
    d += 0.42f * fractalNoise(p * 1.1f + 3.0f, 3);
    // Overgrown heads of dead coral, with holes between them.
    d -= 0.17f * (0.75f - cellNoise(p * 1.9f).x);
    d -= 0.075f * (0.7f - cellNoise(p * 5.1f + 11.0f).x);
    d += 0.05f * std::max(gradientNoise(p * 6.3f), 0.0f);
    d -= 0.026f * (0.7f - cellNoise(p * 13.0f + 3.0f).x);
    return d;
}

vec3 rockAlbedo(const vec3& p, const vec3& n) {
    const float patch = fractalNoise(p * 2.3f, 4), mosaic = cellNoise(p * 5.5f).y,
                other = fractalNoise(p * 6.1f + 40.0f, 3);
    vec3 albedo =
        glm::mix(vec3(0.15f, 0.125f, 0.09f), vec3(0.24f, 0.215f, 0.17f), glm::smoothstep(-0.3f, 0.4f, patch));
    albedo = glm::mix(albedo, vec3(0.115f, 0.125f, 0.055f),
                      glm::smoothstep(0.0f, 0.25f, other) * glm::smoothstep(-0.1f, 0.6f, n.y) * 0.8f); // turf
    if (mosaic > 0.76f)
        albedo = glm::mix(albedo, vec3(0.30f, 0.17f, 0.21f), 0.65f); // pink coralline crust
    else if (mosaic < 0.10f)
        albedo = glm::mix(albedo, vec3(0.40f, 0.37f, 0.30f), 0.6f); // bare limestone
    const float shade = glm::smoothstep(0.25f, -0.35f, n.y);
    const float sponge = cellNoise(p * 2.7f + 20.0f).y;
    if (sponge > 0.66f)
        albedo = glm::mix(albedo,
                          sponge > 0.88f   ? vec3(0.50f, 0.25f, 0.05f)
                          : sponge > 0.76f ? vec3(0.42f, 0.07f, 0.045f)
                                           : vec3(0.33f, 0.13f, 0.26f),
                          shade * glm::smoothstep(-0.1f, 0.15f, fractalNoise(p * 4.0f + 8.0f, 3)) * 0.9f);
    const float dust = glm::smoothstep(0.72f, 0.95f, n.y + 0.35f * fractalNoise(p * 3.0f + 77.0f, 3));
    return glm::mix(albedo, vec3(0.36f, 0.32f, 0.255f), dust * 0.6f);
}

} // namespace

float sandHeight(const Scene& scene, const vec2& xz) {
    const vec3 p(xz.x, 0, xz.y);
    const float bend = 0.55f * fractalNoise(p * 0.45f + 2.0f, 3);
    const float across = (xz.x * 0.86f + xz.y * 0.5f + bend) / 0.19f + 0.5f * gradientNoise(p * 2.1f);
    const float wave = std::fabs(across - 2 * std::floor(across * 0.5f + 0.5f));
    const float ripples = glm::smoothstep(-0.25f, 0.2f, fractalNoise(p * 0.35f + 51.0f, 2));
    return scene.sandHeight + 0.42f * fractalNoise(p * 0.16f + 13.0f, 3) + 0.05f * fractalNoise(p * 1.7f, 3) +
           0.022f * ripples * (wave * wave - 0.5f) + 0.010f * fractalNoise(p * 9.0f, 2);
}

Mesh makeSand(const Scene& scene) {
    constexpr int kSide = 760;
    constexpr float kNear = 17, kFar = 70;
    Mesh mesh;
    const auto stretch = [](float u) {
        const float s = 2 * u - 1, s2 = s * s;
        return s * (kNear * 0.82f + kFar * s2 * s2 * s2 * s2);
    };
    mesh.addGrid(kSide, kSide, false, [&](float u, float v) {
        const vec2 xz(stretch(u), stretch(v));
        const vec3 flat(xz.x, 0, xz.y);
        Vertex vertex{vec3(xz.x, sandHeight(scene, xz), xz.y), vec3(0, 1, 0), scene.sandAlbedo, Kind::Sand};
        const float weed =
            glm::smoothstep(0.05f, 0.4f, fractalNoise(flat * 0.8f + 90.0f, 4)); // a thin film of algae
        vertex.albedo = glm::mix(vertex.albedo, vertex.albedo * vec3(0.70f, 0.72f, 0.55f), weed * 0.8f);
        vertex.albedo *= 1 + 0.22f * fractalNoise(flat * 3.5f, 4);
        return vertex;
    });
    mesh.makeNormals();
    return mesh;
}

Mesh makeRock(const Scene& scene, const Rock& rock) {
    vec3 low(1e9f), high(-1e9f);
    for (const Blob& blob : rock.blobs) {
        low = glm::min(low, blob.centre - blob.radius - kRelief);
        high = glm::max(high, blob.centre + blob.radius + kRelief);
    }
    low.y = std::max(low.y, scene.sandHeight - 0.5f);
    constexpr int kBlock = 8;
    const glm::ivec3 n = (glm::ivec3((high - low) / rock.voxel) / kBlock + 1) * kBlock;
    const auto index = [&](int x, int y, int z) { return (static_cast<size_t>(z) * n.y + y) * n.x + x; };
    const auto place = [&](int x, int y, int z) { return low + vec3(x, y, z) * rock.voxel; };
    std::vector<float> distance(static_cast<size_t>(n.x) * n.y * n.z);
    const float reach = kRelief + 0.5f + rock.voxel * kBlock;
#pragma omp parallel for schedule(dynamic)
    for (int z = 0; z < n.z; z += kBlock)
        for (int y = 0; y < n.y; y += kBlock)
            for (int x = 0; x < n.x; x += kBlock) {
                const float middle =
                    coarseDistance(rock, place(x + kBlock / 2, y + kBlock / 2, z + kBlock / 2));
                for (int k = z; k < z + kBlock; ++k)
                    for (int j = y; j < y + kBlock; ++j)
                        for (int i = x; i < x + kBlock; ++i)
                            distance[index(i, j, k)] =
                                std::fabs(middle) > reach ? middle : rockDistance(rock, place(i, j, k));
            }
    Mesh mesh;
    std::vector<uint32_t> vertexOf(distance.size(), ~0u);
    for (int z = 0; z + 1 < n.z; ++z)
        for (int y = 0; y + 1 < n.y; ++y)
            for (int x = 0; x + 1 < n.x; ++x) {
                float corner[8];
                int inside = 0;
                for (int i = 0; i < 8; ++i) {
                    corner[i] = distance[index(x + (i & 1), y + ((i >> 1) & 1), z + (i >> 2))];
                    inside += corner[i] < 0;
                }
                if (inside == 0 || inside == 8) continue;
                vec3 sum(0);
                int crossings = 0;
                for (int a = 0; a < 8; ++a)
                    for (int axis = 1; axis < 8; axis *= 2) {
                        const int b = a | axis;
                        if (b == a || (corner[a] < 0) == (corner[b] < 0)) continue;
                        const vec3 pa(a & 1, (a >> 1) & 1, a >> 2), pb(b & 1, (b >> 1) & 1, b >> 2);
                        sum += glm::mix(pa, pb, corner[a] / (corner[a] - corner[b]));
                        ++crossings;
                    }
                vertexOf[index(x, y, z)] =
                    mesh.add({.p = place(x, y, z) + sum * (rock.voxel / static_cast<float>(crossings))});
            }
    for (int z = 1; z + 1 < n.z; ++z)
        for (int y = 1; y + 1 < n.y; ++y)
            for (int x = 1; x + 1 < n.x; ++x)
                for (int axis = 0; axis < 3; ++axis) {
                    const glm::ivec3 along(axis == 0, axis == 1, axis == 2),
                        u(axis == 2, axis == 0, axis == 1), v(axis == 1, axis == 2, axis == 0);
                    const bool a = distance[index(x, y, z)] < 0,
                               b = distance[index(x + along.x, y + along.y, z + along.z)] < 0;
                    if (a == b) continue;
                    const auto cell = [&](const glm::ivec3& o) {
                        return vertexOf[index(x - o.x, y - o.y, z - o.z)];
                    };
                    uint32_t q[4] = {cell(u + v), cell(v), cell(glm::ivec3(0)), cell(u)};
                    if (b) std::swap(q[1], q[3]);
                    mesh.triangles.push_back({q[0], q[1], q[2]});
                    mesh.triangles.push_back({q[0], q[2], q[3]});
                }
    const auto buried = [&](const glm::uvec3& t) {
        const vec3& p = mesh.vertices[t.x].p;
        return p.y < scene.sandHeight + 0.5f && p.y < sandHeight(scene, {p.x, p.z}) - 0.12f;
    };
    std::erase_if(mesh.triangles, buried);
    mesh.makeNormals();
    for (Vertex& v : mesh.vertices) v.albedo = rockAlbedo(v.p, v.normal);
    return mesh;
}

} // namespace shoal::reef
