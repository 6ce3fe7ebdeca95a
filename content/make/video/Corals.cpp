#include "content/make/video/Corals.h"

#include "content/make/video/Noise.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace shoal::reef {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

vec3 anyDirection(Random& random) {
    const float y = random.between(-1, 1), angle = random.between(0, 2 * kPi), ring = std::sqrt(1 - y * y);
    return {ring * std::cos(angle), y, ring * std::sin(angle)};
}

vec3 paleTip(float along) {
    return vec3(glm::mix(0.75f, 1.0f, along) + 1.1f * glm::smoothstep(0.82f, 1.0f, along));
}

// A branch and its own branches: staghorn.
void branch(Mesh& mesh, Random& random, vec3 p, vec3 along, float length, float radius, int depth) {
    std::vector<vec3> points{p};
    std::vector<float> radii{radius};
    const int steps = 6;
    for (int i = 1; i <= steps; ++i) {
        along = glm::normalize(along + 0.16f * anyDirection(random) + vec3(0, 0.07f, 0));
        p += along * (length / steps);
        points.push_back(p);
        radii.push_back(radius * (i == steps ? 0.25f : 1 - 0.45f * static_cast<float>(i) / steps) *
                        random.between(0.9f, 1.12f));
        if (depth > 0 && i >= 2 && random.unit() < 0.62f) {
            const vec3 side =
                glm::normalize(along * 0.55f + anyDirection(random) * 0.75f + vec3(0, 0.25f, 0));
            branch(mesh, random, p, side, length * random.between(0.5f, 0.8f), radius * 0.72f, depth - 1);
        }
    }
    const bool tip = depth == 0;
    mesh.addTube(
        points, radii, 7, [&](float v) { return tip ? paleTip(v) : vec3(0.75f + 0.2f * v); }, Kind::Coral);
}

Mesh staghorn(Random& random) {
    Mesh mesh;
    const int stems = 6 + static_cast<int>(random.below(5));
    for (int i = 0; i < stems; ++i) {
        const float angle = 2 * kPi * (static_cast<float>(i) + random.unit()) / static_cast<float>(stems),
                    lean = random.between(0.2f, 1.1f);
        const vec3 along = glm::normalize(vec3(std::cos(angle) * lean, 1, std::sin(angle) * lean));
        branch(mesh, random, vec3(std::cos(angle), -0.3f, std::sin(angle)) * 0.16f, along,
               random.between(0.5f, 0.85f), 0.062f, 2);
    }
    return mesh;
}

// Returns a brain coral: a dome with winding valleys, and ridges where a warped noise crosses zero.
Mesh brain(Random& random) {
    Mesh mesh;
    const vec3 seed = anyDirection(random) * 50.0f;
    const float squash = random.between(0.55f, 0.85f);
    mesh.addGrid(150, 64, true, [&](float u, float v) {
        const float high = kPi * (0.5f - 0.62f * v), round = -2 * kPi * u;
        const vec3 d(std::cos(high) * std::cos(round), std::sin(high), std::cos(high) * std::sin(round));
        const vec3 q = d * 3.4f + seed;
        const vec3 warped = q + 0.5f * vec3(gradientNoise(q * 1.1f), gradientNoise(q * 1.1f + 9.0f),
                                            gradientNoise(q * 1.1f + 21.0f));
        const float ridge = std::min(std::fabs(gradientNoise(warped * 1.9f)) * 4.2f, 1.0f);
        const float lump = 1 + 0.24f * fractalNoise(d * 1.6f + seed, 3);
        const vec3 p = d * lump * (0.965f + 0.045f * ridge) * vec3(1, squash, 1);
        return Vertex{p - vec3(0, 0.1f, 0), d, glm::mix(vec3(0.42f, 0.52f, 0.38f), vec3(1.12f), ridge),
                      Kind::Coral};
    });
    mesh.makeNormals();
    return mesh;
}

Mesh table(Random& random) {
    Mesh mesh;
    const vec3 seed = anyDirection(random) * 50.0f;
    const int plates = 1 + static_cast<int>(random.below(3));
    for (int k = 0; k < plates; ++k) {
        const float height = 0.28f + 0.17f * static_cast<float>(k) + random.between(0, 0.05f),
                    width = random.between(0.6f, 1.0f) - 0.12f * static_cast<float>(k);
        const vec3 off(random.between(-0.3f, 0.3f) * static_cast<float>(k), 0,
                       random.between(-0.3f, 0.3f) * static_cast<float>(k));
        const vec2 tilt(random.between(-0.14f, 0.14f), random.between(-0.14f, 0.14f));
        // v: from the middle of the top over the rim to the middle below.
        mesh.addGrid(96, 46, true, [&](float u, float v) {
            const float angle = -2 * kPi * u, side = v < 0.62f ? v / 0.62f : (1 - v) / 0.38f;
            const vec3 ring(std::cos(angle), 0, std::sin(angle));
            const float rim =
                width * (1 + 0.30f * fractalNoise(ring * 1.7f + seed + static_cast<float>(k), 3));
            const float r = rim * side;
            vec3 p = ring * r;
            const float knobs = cellNoise(p * 17.0f + seed).x;
            p.y = height + 0.12f * side * side -
                  (v < 0.62f ? 0.0f : 0.05f + 0.16f * (1 - side) * (1 - side)) +
                  glm::dot(tilt, vec2(p.x, p.z)) + 0.05f * fractalNoise(p * 3.0f + seed, 2) +
                  (v < 0.62f ? 0.032f * (0.6f - knobs) : 0.0f);
            const float light =
                v < 0.62f ? 0.72f + 0.3f * (0.9f - knobs) + 0.75f * glm::smoothstep(0.9f, 1.0f, side) : 0.5f;
            return Vertex{p + off, vec3(0, 1, 0), vec3(light), Kind::Coral};
        });
    }
    mesh.makeNormals();
    mesh.addTube(
        {vec3(0, -0.3f, 0), vec3(0, 0, 0), vec3(0, 0.2f, 0), vec3(0, 0.33f, 0)}, {0.22f, 0.15f, 0.16f, 0.34f},
        12, [](float) { return vec3(0.45f); }, Kind::Rock);
    return mesh;
}

Mesh finger(Random& random) {
    Mesh mesh;
    const int lobes = 9 + static_cast<int>(random.below(10));
    for (int i = 0; i < lobes; ++i) {
        const float angle = random.between(0, 2 * kPi), out = std::sqrt(random.unit()) * 0.6f,
                    height = random.between(0.45f, 1.0f) * (1 - 0.5f * out);
        const vec3 root(std::cos(angle) * out, -0.2f, std::sin(angle) * out),
            seed = anyDirection(random) * 40.0f;
        const vec3 lean(std::cos(angle) * out * 0.4f, 0, std::sin(angle) * out * 0.4f);
        const float thick = random.between(0.10f, 0.19f);
        mesh.addGrid(22, 18, true, [&](float u, float v) {
            const float round = -2 * kPi * u, profile = std::sqrt(std::max(1 - std::pow(1 - v, 6.0f), 0.0f)) *
                                                        (1 + 0.22f * std::sin(v * 9 + static_cast<float>(i)));
            const vec3 d(std::cos(round), 0, std::sin(round)),
                axis = root + (vec3(0, 1, 0) * (height + 0.2f) + lean) * (1 - v);
            const float lump = 1 + 0.35f * gradientNoise(vec3(d * 1.3f) + vec3(0, v * 4, 0) + seed);
            return Vertex{axis + d * thick * profile * lump, d, vec3(0.7f + 0.5f * (1 - v) * (1 - v)),
                          Kind::Coral};
        });
    }
    mesh.makeNormals();
    return mesh;
}

// Tube sponges: walls up, over the lip, and down inside.
Mesh tubes(Random& random) {
    Mesh mesh;
    const int count = 3 + static_cast<int>(random.below(5));
    for (int i = 0; i < count; ++i) {
        const float angle = random.between(0, 2 * kPi), out = random.between(0.05f, 0.32f),
                    height = random.between(0.4f, 1.0f), thick = random.between(0.09f, 0.16f);
        const vec3 root(std::cos(angle) * out, -0.15f, std::sin(angle) * out),
            seed = anyDirection(random) * 40.0f;
        const vec3 lean(std::cos(angle) * 0.3f * height, 0, std::sin(angle) * 0.3f * height);
        mesh.addGrid(24, 26, true, [&](float u, float v) {
            const float round = -2 * kPi * u, up = v < 0.6f ? v / 0.6f : 1 - (v - 0.6f) / 0.4f * 0.7f,
                        inner = v < 0.6f ? 1.0f : glm::mix(1.0f, 0.55f, std::min((v - 0.6f) * 8, 1.0f));
            const vec3 d(std::cos(round), 0, std::sin(round));
            const float wall = thick * (0.75f + 0.35f * up) * inner *
                               (1 + 0.30f * gradientNoise(d * 1.2f + vec3(0, up * 5, 0) + seed) +
                                0.1f * gradientNoise(d * 4.0f + vec3(0, up * 16, 0) + seed));
            const vec3 p = root + (vec3(0, height + 0.15f, 0) + lean * up) * up + d * wall;
            return Vertex{p, d, vec3(v < 0.6f ? 0.7f + 0.4f * up : 0.35f), Kind::Soft};
        });
    }
    mesh.makeNormals();
    return mesh;
}

Mesh lump(Random& random, int columns, int rows, float flat, float rough, Kind kind) {
    Mesh mesh;
    const vec3 seed = anyDirection(random) * 60.0f;
    mesh.addGrid(columns, rows, true, [&](float u, float v) {
        const float high = kPi * (0.5f - v), round = -2 * kPi * u;
        const vec3 d(std::cos(high) * std::cos(round), std::sin(high), std::cos(high) * std::sin(round));
        const float r =
            1 + rough * fractalNoise(d * 1.5f + seed, 3) + 0.25f * rough * gradientNoise(d * 6.0f + seed);
        return Vertex{d * r * vec3(1, flat, 1), d, vec3(0.85f + 0.5f * fractalNoise(d * 3.0f + seed, 2)),
                      kind};
    });
    mesh.makeNormals();
    return mesh;
}

Mesh urchin(Random& random) {
    Mesh mesh = lump(random, 14, 9, 0.8f, 0.0f, Kind::Soft);
    for (Vertex& v : mesh.vertices) v.p = v.p * 0.33f + vec3(0, 0.2f, 0);
    for (int i = 0; i < 150; ++i) {
        vec3 d = anyDirection(random);
        d.y = d.y * 0.75f + 0.25f;
        d = glm::normalize(d);
        const float length = random.between(0.65f, 1.0f);
        mesh.addTube(
            {d * 0.25f + vec3(0, 0.2f, 0), d * length + vec3(0, 0.2f, 0)}, {0.022f, 0.004f}, 3,
            [](float) { return vec3(1); }, Kind::Soft);
    }
    return mesh;
}

void addBlade(Mesh& mesh, Random& random, const vec3& root, float height, float width, float bend, int rows,
              float sway, Kind kind) {
    const float angle = random.between(0, 2 * kPi), tint = random.between(0.7f, 1.25f),
                turn = random.between(-1.0f, 1.0f);
    const vec3 out(std::cos(angle), 0, std::sin(angle));
    mesh.addGrid(2, rows, false, [&](float u, float v) {
        const vec3 across(std::sin(angle + turn * v), 0, -std::cos(angle + turn * v));
        const float thin = width * std::pow(1 - 0.95f * v * v, 0.7f);
        const vec3 p = root + vec3(0, 1, 0) * height * (v - 0.25f * bend * v * v) +
                       out * bend * height * v * v + across * (u - 0.5f) * thin;
        return Vertex{p, glm::normalize(out * -1.0f + vec3(0, 0.6f, 0)),
                      tint * glm::mix(vec3(0.55f, 0.6f, 0.6f), vec3(1.15f, 1.1f, 0.9f), v), kind,
                      sway * v * v};
    });
}

Mesh tuft(Random& random) {
    Mesh mesh;
    for (int i = 0; i < 9; ++i)
        addBlade(mesh, random, vec3(random.between(-0.5f, 0.5f), -0.1f, random.between(-0.5f, 0.5f)),
                 random.between(0.4f, 1.1f), random.between(0.10f, 0.2f), random.between(0.1f, 0.8f), 3, 0,
                 Kind::Leaf);
    return mesh;
}

Mesh grass(Random& random) {
    Mesh mesh;
    for (int i = 0; i < 5; ++i)
        addBlade(mesh, random, vec3(random.between(-0.25f, 0.25f), -0.02f, random.between(-0.25f, 0.25f)),
                 random.between(0.5f, 1.1f), random.between(0.022f, 0.04f), random.between(0.05f, 0.55f), 5,
                 0.30f, Kind::Leaf);
    return mesh;
}

// A gorgonian: branches that fork in one plane.
void forks(Mesh& mesh, Random& random, vec3 p, float angle, float length, float radius, int depth) {
    std::vector<vec3> points{p};
    std::vector<float> radii{radius};
    for (int i = 1; i <= 3; ++i) {
        angle = angle * 0.97f + random.between(-0.12f, 0.12f);
        p += vec3(std::sin(angle), std::cos(angle), random.between(-0.08f, 0.08f)) * (length / 3);
        points.push_back(p);
        radii.push_back(radius * (1 - 0.1f * static_cast<float>(i)));
        if (depth > 0 && random.unit() < 0.75f)
            forks(mesh, random, p,
                  angle + (random.unit() < 0.5f ? -1.0f : 1.0f) * random.between(0.35f, 0.75f),
                  length * random.between(0.65f, 0.9f), std::max(radius * 0.72f, 0.0045f), depth - 1);
    }
    mesh.addTube(
        points, radii, 4, [](float) { return vec3(1); }, Kind::Leaf);
}

Mesh fan(Random& random) {
    Mesh mesh;
    for (int i = -2; i <= 2; ++i)
        forks(mesh, random, vec3(0, -0.05f, 0), 0.42f * static_cast<float>(i) + random.between(-0.15f, 0.15f),
              random.between(0.32f, 0.45f), 0.014f, 4);
    for (Vertex& v : mesh.vertices) v.sway = 0.10f * v.p.y * v.p.y;
    return mesh;
}

Mesh whip(Random& random) {
    Mesh mesh;
    for (int i = 0; i < 7; ++i) {
        vec3 p(random.between(-0.12f, 0.12f), -0.05f, random.between(-0.12f, 0.12f)),
            along = glm::normalize(vec3(p.x * 3, 1, p.z * 3));
        std::vector<vec3> points{p};
        std::vector<float> radii{0.022f};
        const float length = random.between(0.5f, 1.1f);
        for (int k = 1; k <= 9; ++k) {
            along = glm::normalize(along + 0.16f * anyDirection(random) + vec3(0, 0.06f, 0));
            p += along * length / 9.0f;
            points.push_back(p);
            radii.push_back(k == 9 ? 0.006f : 0.022f - 0.0008f * static_cast<float>(k));
        }
        mesh.addTube(
            points, radii, 5, [](float v) { return vec3(0.8f + 0.35f * v); }, Kind::Leaf, 0.20f);
    }
    return mesh;
}

// A leather coral: a folded cap on a foot, its polyps a fringe of tentacles.
Mesh leather(Random& random) {
    Mesh mesh;
    const vec3 seed = anyDirection(random) * 40.0f;
    for (int i = 0; i < 130; ++i) {
        const float out = std::sqrt(random.unit()) * 0.85f, angle = random.between(0, 2 * kPi);
        const vec3 d(std::cos(angle) * out, 0, std::sin(angle) * out);
        const vec3 root = d + vec3(0, 0.42f - 0.4f * out * out + 0.12f * gradientNoise(d * 3.0f + seed), 0);
        const vec3 along = glm::normalize(vec3(d.x * 0.9f, 0.8f, d.z * 0.9f) + 0.35f * anyDirection(random));
        mesh.addTube(
            {root, root + along * 0.12f, root + along * 0.23f + 0.03f * anyDirection(random),
             root + along * 0.30f},
            {0.03f, 0.026f, 0.024f, 0.016f}, 5,
            [](float v) { return vec3(0.65f + 0.35f * v + 0.6f * glm::smoothstep(0.8f, 1.0f, v)); },
            Kind::Leaf, 0.07f);
    }
    mesh.addGrid(30, 14, true, [&](float u, float v) {
        const float round = -2 * kPi * u, out = v < 0.6f ? v / 0.6f * 0.9f : 0.9f - (v - 0.6f) / 0.4f * 0.5f;
        const vec3 d(std::cos(round), 0, std::sin(round));
        const float y = v < 0.6f ? 0.42f - 0.4f * out * out + 0.12f * gradientNoise(d * out * 3.0f + seed)
                                 : 0.08f - (v - 0.6f) * 0.9f;
        return Vertex{d * out + vec3(0, y, 0), d, vec3(0.6f), Kind::Soft};
    });
    mesh.makeNormals();
    return mesh;
}

// Adds one blade of kelp: from its bladder outwards, then hanging, with ruffled edges.
void addKelpBlade(Mesh& mesh, Random& random, const vec3& root, float rootSway, float length) {
    const float angle = random.between(0, 2 * kPi), tint = random.between(0.75f, 1.2f),
                lift = random.between(0.1f, 0.7f), ruffle = random.between(0, 6.0f),
                curl = random.between(-0.7f, 0.7f);
    const vec3 out(std::cos(angle), 0, std::sin(angle));
    const vec3 start = root + out * 0.0035f;
    mesh.addTube(
        {root, root + out * 0.0018f + vec3(0, 0.0012f, 0), start}, {0.0006f, 0.0018f, 0.0006f}, 5,
        [](float) { return vec3(1.25f, 1.15f, 0.8f); }, Kind::Leaf);
    for (size_t i = mesh.vertices.size() - 15; i < mesh.vertices.size(); ++i)
        mesh.vertices[i].sway = rootSway;
    mesh.addGrid(3, 9, false, [&](float u, float v) {
        const float heading = angle + curl * v;
        const vec3 ahead(std::cos(heading), 0, std::sin(heading)), across(-ahead.z, 0, ahead.x);
        const float wide = 0.0062f * std::sqrt(std::max(std::sin(kPi * std::pow(v, 0.7f)), 0.0f)) + 0.0003f;
        const float side = (u - 0.5f) * 2, wave = 0.0016f * side * std::sin(v * 26 + ruffle + side);
        const vec3 p = start + ahead * (length * v * (1 - 0.25f * v)) +
                       vec3(0, length * (lift * v - (lift + 0.45f) * v * v) + wave, 0) +
                       across * (side * wide);
        return Vertex{p, vec3(0, 1, 0),
                      tint *
                          glm::mix(vec3(1.1f, 1.05f, 0.9f), vec3(0.85f, 0.9f, 0.9f), u == 0.5f ? 1.0f : 0.3f),
                      Kind::Leaf, rootSway + 0.009f * v * v};
    });
}

// Returns giant kelp, scaled to a height of a metre: stipes from one holdfast, their ends along the surface.
Mesh kelp(Random& random) {
    Mesh mesh;
    const int stipes = 3 + static_cast<int>(random.below(3));
    const float drift = random.between(0, 2 * kPi);
    for (int s = 0; s < stipes; ++s) {
        vec3 p(random.between(-0.012f, 0.012f), -0.01f, random.between(-0.012f, 0.012f));
        const float top = random.between(0.75f, 1.0f);
        vec3 along(random.between(-0.12f, 0.12f), 1, random.between(-0.12f, 0.12f));
        std::vector<vec3> points{p};
        std::vector<float> radii{0.0016f};
        constexpr int kSteps = 44;
        for (int i = 1; i <= kSteps; ++i) {
            const float lying = glm::smoothstep(top - 0.08f, top, p.y);
            along += 0.05f * anyDirection(random) +
                     lying * vec3(0.5f * std::cos(drift), -0.5f, 0.5f * std::sin(drift));
            along.y = std::max(along.y, 0.03f);
            along = glm::normalize(along + vec3(0, 0.12f * (1 - lying), 0));
            p += along * (1.12f / kSteps);
            points.push_back(p);
            radii.push_back(0.0015f - 0.0009f * static_cast<float>(i) / kSteps);
        }
        const auto swayAt = [](float height) { return 0.034f * std::pow(std::max(height, 0.0f), 1.3f); };
        const size_t first = mesh.vertices.size();
        mesh.addTube(
            points, radii, 4, [](float) { return vec3(0.8f, 0.75f, 0.7f); }, Kind::Leaf);
        for (size_t i = first; i < mesh.vertices.size(); ++i)
            mesh.vertices[i].sway = swayAt(mesh.vertices[i].p.y);
        for (size_t i = 2; i < points.size(); ++i)
            for (int blade = 0; blade < (i % 3 ? 1 : 2); ++blade) {
                const vec3 root = glm::mix(points[i - 1], points[i], random.unit());
                const float young = glm::smoothstep(0.0f, 0.3f, root.y);
                addKelpBlade(mesh, random, root, swayAt(root.y),
                             random.between(0.045f, 0.085f) * (0.5f + 0.5f * young));
            }
    }
    mesh.makeNormals();
    return mesh;
}

struct Species {
    Mesh (*make)(Random&);
    std::vector<vec3> albedos;
    bool sways = false;
    float leans = 0.5f;
};

const std::map<std::string, Species>& allSpecies() {
    static const std::map<std::string, Species> all = {
        {"staghorn",
         {staghorn,
          {{0.33f, 0.24f, 0.12f},
           {0.36f, 0.30f, 0.20f},
           {0.20f, 0.22f, 0.34f},
           {0.30f, 0.31f, 0.14f},
           {0.38f, 0.24f, 0.24f}},
          false,
          0.4f}},
        {"brain",
         {brain,
          {{0.30f, 0.25f, 0.12f}, {0.22f, 0.26f, 0.12f}, {0.34f, 0.24f, 0.16f}, {0.28f, 0.27f, 0.20f}},
          false,
          0.7f}},
        {"table",
         {table,
          {{0.27f, 0.20f, 0.12f}, {0.22f, 0.22f, 0.13f}, {0.24f, 0.18f, 0.22f}, {0.31f, 0.25f, 0.15f}},
          false,
          0.35f}},
        {"finger",
         {finger,
          {{0.33f, 0.28f, 0.11f}, {0.30f, 0.22f, 0.15f}, {0.26f, 0.20f, 0.28f}, {0.22f, 0.26f, 0.15f}},
          false,
          0.6f}},
        {"tubes",
         {tubes,
          {{0.50f, 0.34f, 0.06f}, {0.34f, 0.14f, 0.34f}, {0.46f, 0.13f, 0.06f}, {0.28f, 0.21f, 0.16f}},
          false,
          0.8f}},
        {"crust",
         {[](Random& r) { return lump(r, 18, 11, 0.2f, 1.0f, Kind::Coral); },
          {{0.27f, 0.17f, 0.19f},
           {0.31f, 0.19f, 0.10f},
           {0.20f, 0.20f, 0.11f},
           {0.33f, 0.29f, 0.22f},
           {0.29f, 0.10f, 0.08f},
           {0.24f, 0.19f, 0.13f}},
          false,
          1.0f}},
        {"urchin", {urchin, {{0.025f, 0.02f, 0.025f}, {0.03f, 0.018f, 0.03f}}, false, 0.9f}},
        {"tuft",
         {tuft,
          {{0.14f, 0.14f, 0.05f}, {0.17f, 0.12f, 0.06f}, {0.10f, 0.13f, 0.05f}, {0.20f, 0.10f, 0.09f}},
          false,
          0.7f}},
        {"rubble",
         {[](Random& r) { return lump(r, 12, 8, 0.55f, 0.9f, Kind::Rock); },
          {{0.34f, 0.31f, 0.26f}, {0.24f, 0.20f, 0.15f}, {0.44f, 0.41f, 0.35f}, {0.28f, 0.19f, 0.19f}},
          false,
          0.2f}},
        {"grass", {grass, {{0.11f, 0.19f, 0.05f}, {0.15f, 0.19f, 0.05f}, {0.17f, 0.17f, 0.06f}}, true, 0.1f}},
        {"fan", {fan, {{0.36f, 0.13f, 0.30f}, {0.48f, 0.28f, 0.06f}, {0.42f, 0.09f, 0.06f}}, true, 0.6f}},
        {"whip", {whip, {{0.42f, 0.20f, 0.07f}, {0.34f, 0.27f, 0.16f}, {0.40f, 0.12f, 0.18f}}, true, 0.3f}},
        {"kelp", {kelp, {{0.30f, 0.22f, 0.055f}, {0.26f, 0.21f, 0.05f}, {0.34f, 0.23f, 0.06f}}, true, 0.0f}},
        {"leather",
         {leather, {{0.34f, 0.29f, 0.17f}, {0.30f, 0.30f, 0.18f}, {0.36f, 0.26f, 0.22f}}, true, 0.6f}},
    };
    return all;
}

} // namespace

Mesh makeColony(const std::string& kind, Random& random) {
    const auto found = allSpecies().find(kind);
    return found == allSpecies().end() ? Mesh{} : found->second.make(random);
}

vec3 colonyAlbedo(const std::string& kind, Random& random) {
    const auto& albedos = allSpecies().at(kind).albedos;
    const vec3 base = albedos[random.below(static_cast<uint32_t>(albedos.size()))];
    return base * random.between(0.75f, 1.2f) *
           vec3(random.between(0.92f, 1.08f), 1, random.between(0.9f, 1.1f));
}

bool sways(const std::string& kind) { return allSpecies().at(kind).sways; }
float leans(const std::string& kind) { return allSpecies().at(kind).leans; }

} // namespace shoal::reef
