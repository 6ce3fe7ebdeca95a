#include "content/make/video/Growth.h"

#include "content/make/video/Corals.h"
#include "content/make/video/Ground.h"
#include "content/make/video/Noise.h"

#include <algorithm>

namespace shoal::reef {

namespace {

constexpr float kTurn = 6.2831853f;

// Colonies keep to patches, each kind to its own; most stand near the camera's way, where they are seen.
bool thrives(const Growth& growth, const Vertex& ground, const Route& route, float size, uint32_t seed,
             Random& random, const std::function<float(const vec3&)>& sunlit) {
    if (ground.normal.y < growth.up || (ground.kind == Kind::Sand) != growth.onSand) return false;
    const float patch = fractalNoise(ground.p * 0.55f + static_cast<float>(seed) * 7.3f, 3);
    if (growth.kind != "tuft" && growth.kind != "crust" && growth.kind != "rubble" &&
        patch < random.between(-0.1f, 0.35f))
        return false;
    if (growth.kind == "grass" && patch < 0.16f) return false;
    const float away = route.distanceTo(ground.p);
    if (away < 0.62f + 0.9f * size || random.unit() > 2.6f / (1 + 0.12f * away * away)) return false;
    const float sun = sunlit(ground.p + ground.normal * 0.1f);
    return sun >= growth.light.x && sun <= growth.light.y;
}

} // namespace

Grown grow(const Scene& scene, const Route& route, const Mesh& ground,
           const std::function<float(const vec3&)>& sunlit) {
    Grown grown;
    std::vector<uint32_t> sand, rock;
    for (uint32_t i = 0; i < ground.vertices.size(); ++i) {
        const Vertex& v = ground.vertices[i];
        if (v.p.y < sandHeight(scene, {v.p.x, v.p.z}) - 0.03f) continue;
        (v.kind == Kind::Sand ? sand : rock).push_back(i);
    }
    uint32_t seed = 0;
    for (const Growth& growth : scene.growths) {
        Random random(++seed, 5);
        std::vector<Mesh> variants;
        for (int i = 0; i < 6; ++i) variants.push_back(makeColony(growth.kind, random));
        const auto& places = growth.onSand ? sand : rock;
        Mesh& into = sways(growth.kind) ? grown.swaying : grown.still;
        int set = 0;
        for (int tries = 0; set < growth.count && tries < growth.count * 60 && !places.empty(); ++tries) {
            const Vertex& at = ground.vertices[places[random.below(static_cast<uint32_t>(places.size()))]];
            const float share = random.unit(), size = glm::mix(growth.size.x, growth.size.y, share * share);
            if (!thrives(growth, at, route, size, seed, random, sunlit)) continue;
            const vec3 up = glm::normalize(glm::mix(vec3(0, 1, 0), at.normal, leans(growth.kind)));
            into.add(variants[random.below(6)], frameAlong(up, random.between(0, kTurn)), size, at.p,
                     colonyAlbedo(growth.kind, random));
            ++set;
        }
    }
    return grown;
}

} // namespace shoal::reef
