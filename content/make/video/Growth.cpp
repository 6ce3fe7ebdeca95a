#include "content/make/video/Growth.h"

#include "content/make/video/Corals.h"
#include "content/make/video/Ground.h"
#include "content/make/video/Noise.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>

namespace shoal::reef {

namespace {

constexpr float kTurn = 6.2831853f;

// Returns whether a colony grows here: each kind in its own patches, most near the camera's path.
bool thrives(const Growth& growth, const Vertex& ground, const Route& route, float size, uint32_t seed,
             Random& random, const std::function<float(const vec3&)>& sunlit) {
    if (ground.normal.y < growth.up || (ground.kind == Kind::Sand) != growth.onSand) return false;
    const float patch = fractalNoise(ground.p * 0.55f + static_cast<float>(seed) * 7.3f, 3);
    if (growth.kind != "tuft" && growth.kind != "crust" && growth.kind != "rubble" &&
        patch < random.between(-0.1f, 0.35f))
        return false;
    if (growth.kind == "grass" && patch < 0.16f) return false;
    // Plants with a `clear` of their own are tall: their distance is measured at the camera's height.
    const float away =
        route.distanceTo(growth.clear > 0 ? vec3(ground.p.x, route.at(0).y, ground.p.z) : ground.p);
    const float clear = growth.clear > 0 ? growth.clear : 0.62f + 0.9f * size;
    if (away < clear || random.unit() > 2.6f / (1 + 0.12f * away * away)) return false;
    const float sun = sunlit(ground.p + ground.normal * 0.1f);
    return sun >= growth.light.x && sun <= growth.light.y;
}

// Keeps vertices below the sea's surface, and makes some colonies glow, most at their pale parts, but none
// close to the camera's path.
void finish(const Growth& growth, const Route& route, uint32_t number, Mesh& mesh, size_t first) {
    const bool glows = growth.glow != vec3(0) && unitFrom(hash(number, 3, 71)) < 0.45f &&
                       route.distanceTo(mesh.vertices[first].p) > 1.4f;
    const float strength = 0.4f + unitFrom(hash(number, 5, 71));
    for (size_t i = first; i < mesh.vertices.size(); ++i) {
        Vertex& v = mesh.vertices[i];
        v.p.y = std::min(v.p.y, -0.06f);
        if (!glows) continue;
        const float pale = 3 * glm::dot(v.albedo, vec3(0.333f));
        v.glow = glm::packF3x9_E1x5(growth.glow * (strength * pale * pale));
    }
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
            const size_t first = into.vertices.size();
            into.add(variants[random.below(6)], frameAlong(up, random.between(0, kTurn)), size, at.p,
                     colonyAlbedo(growth.kind, random));
            finish(growth, route, static_cast<uint32_t>(set), into, first);
            ++set;
        }
    }
    return grown;
}

} // namespace shoal::reef
