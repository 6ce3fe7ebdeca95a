#include "content/make/video/Lamps.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::reef {

namespace {

constexpr int kSide = 512;      // of the shadow map
constexpr float kGlass = 0.05f; // metres, radius

} // namespace

Lamps::Lamps(const std::vector<Lamp>& lamps, const Water& water,
             const std::function<float(const vec3&, const vec3&)>& distance)
    : water_(water) {
    for (const Lamp& lamp : lamps) {
        Set set{lamp, lamp.place};
        const glm::mat3 frame = frameAlong(lamp.towards, 0); // its y is the axis
        set.lampFromWorld = glm::transpose(glm::mat3(frame[0], frame[2], frame[1]));
        set.halfWidth = std::sqrt(1 / (lamp.cosOuter * lamp.cosOuter) - 1);
        if (!lamp.carried) {
            set.reach.resize(static_cast<size_t>(kSide) * kSide);
            const glm::mat3 worldFromLamp = glm::transpose(set.lampFromWorld);
#pragma omp parallel for schedule(dynamic, 8)
            for (int y = 0; y < kSide; ++y)
                for (int x = 0; x < kSide; ++x) {
                    const vec2 q = (vec2(x, y) + 0.5f) * (2.0f / kSide) - 1.0f;
                    const vec3 dir = glm::normalize(worldFromLamp * vec3(q * set.halfWidth, 1));
                    set.reach[static_cast<size_t>(y * kSide + x)] =
                        0.08f + distance(lamp.place + dir * 0.08f, dir);
                }
        }
        sets_.push_back(std::move(set));
    }
}

void Lamps::carry(const vec3& camera) {
    for (Set& set : sets_)
        if (set.lamp.carried) set.place = camera + set.lamp.place;
}

// Bilinear between compared texels, so that the edge of a shadow is smooth.
float Lamps::lit(const Set& set, const vec3& inLamp, float distance) const {
    if (set.reach.empty()) return 1;
    const vec2 q =
        (vec2(inLamp) / (inLamp.z * set.halfWidth) * 0.5f + 0.5f) * static_cast<float>(kSide) - 0.5f;
    const vec2 base = glm::clamp(glm::floor(q), 0.0f, kSide - 2.0f), f = glm::clamp(q - base, 0.0f, 1.0f);
    const float* row =
        set.reach.data() + static_cast<size_t>(static_cast<int>(base.y) * kSide + static_cast<int>(base.x));
    const auto clear = [&](float reach) { return std::clamp((reach - distance) * 25 + 1.6f, 0.0f, 1.0f); };
    return (clear(row[0]) * (1 - f.x) + clear(row[1]) * f.x) * (1 - f.y) +
           (clear(row[kSide]) * (1 - f.x) + clear(row[kSide + 1]) * f.x) * f.y;
}

Lamps::List Lamps::at(const vec3& p) const {
    List list;
    for (const Set& set : sets_) {
        const vec3 d = p - set.place;
        const float square = std::max(glm::dot(d, d), 0.01f);
        if (square > kReach * kReach) continue;
        const float distance = std::sqrt(square), cosine = glm::dot(d, set.lamp.towards) / distance;
        if (cosine <= set.lamp.cosOuter) continue;
        float share = glm::smoothstep(set.lamp.cosOuter, set.lamp.cosInner, cosine) / square;
        share *= lit(set, set.lampFromWorld * d, distance);
        if (share > 0) list.add({set.lamp.intensity * water_.transmittance(distance) * share, -d / distance});
    }
    return list;
}

Mesh makeLamp(const Lamp& lamp) {
    Mesh mesh;
    const vec3 along = lamp.towards, front = lamp.place + along * 0.01f;
    const auto dark = [](float) { return vec3(0.03f); };
    mesh.addTube({front - along * 0.16f, front - along * 0.15f, front - along * 0.03f, front},
                 {0.0f, 0.045f, 0.055f, 0.062f}, 14, dark, Kind::Lamp);
    const vec3 foot = lamp.place - along * 0.09f;
    for (int i = 0; i < 3; ++i) {
        const float angle = 2.1f * static_cast<float>(i);
        mesh.addTube({foot, foot + vec3(0.14f * std::cos(angle), -0.55f, 0.14f * std::sin(angle))},
                     {0.012f, 0.010f}, 5, dark, Kind::Lamp);
    }
    // The glass sends all the lamp's light from its small disc, up to what the camera can tell from white.
    const vec3 radiance =
        lamp.intensity * std::min(1 / (3.14159f * kGlass * kGlass), 30 / std::max(lamp.intensity.y, 1e-3f));
    const size_t first = mesh.vertices.size();
    mesh.addTube({front - along * 0.004f, front + along * 0.004f}, {kGlass, 0.0f}, 14, dark, Kind::Lamp);
    for (size_t i = first; i < mesh.vertices.size(); ++i) {
        mesh.vertices[i].glow = glm::packF3x9_E1x5(radiance);
        mesh.vertices[i].normal = along;
    }
    return mesh;
}

} // namespace shoal::reef
