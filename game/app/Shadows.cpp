#include "game/app/Shadows.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace shoal::app {

namespace {

void straightBody(const game::CreatureView& creature, const scene::Silhouette& shape,
                  std::vector<render::CastingPiece>& out) {
    out.clear();
    const float whole = std::max(shape.front - shape.back, 1e-3f), scale = creature.length / whole;
    const glm::mat3 body = glm::mat3_cast(creature.worldFromBody);
    const auto at = [&](size_t slice) {
        const float z =
            shape.back + whole * static_cast<float>(slice) / static_cast<float>(scene::Silhouette::kSlices);
        return creature.position + body[2] * (z * scale);
    };
    for (size_t i = 0; i < scene::Silhouette::kSlices; ++i)
        out.push_back(
            {at(i), at(i + 1), body[0] * (shape.half[i].x * scale), body[1] * (shape.half[i].y * scale)});
}

// The five fingers, the palm, and a hand's length of the arm.
void handBody(const game::HandView& hand, std::vector<render::CastingPiece>& out) {
    out.clear();
    constexpr std::array<int, 5> kKnuckles = {3, 7, 12, 17, 22}; // hands::kJointNames: the proximal joints
    constexpr std::array<int, 5> kTips = {5, 10, 15, 20, 25};
    constexpr int kPalm = 0, kWrist = 1, kMiddle = 12;
    constexpr float kPalmHalf_m = 0.038f, kPalmThick_m = 0.014f, kArm_m = 0.18f, kArmHalf_m = 0.032f;
    for (size_t f = 0; f < kTips.size(); ++f) {
        const hands::Joint &knuckle = hand.joints[static_cast<size_t>(kKnuckles[f])],
                           &tip = hand.joints[static_cast<size_t>(kTips[f])];
        const glm::mat3 turn = glm::mat3_cast(knuckle.orientation);
        out.push_back({knuckle.position, tip.position, turn[0] * knuckle.radius, turn[1] * knuckle.radius});
    }
    const glm::mat3 palm = glm::mat3_cast(hand.joints[kPalm].orientation);
    const glm::vec3 wrist = hand.joints[kWrist].position;
    out.push_back({wrist, hand.joints[kMiddle].position, palm[0] * kPalmHalf_m, palm[1] * kPalmThick_m});
    const glm::mat3 arm = glm::mat3_cast(hand.joints[kWrist].orientation);
    out.push_back({wrist + arm[2] * kArm_m, wrist, arm[0] * kArmHalf_m, arm[1] * kArmHalf_m});
}

} // namespace

render::FloorLight floorLight(const light::CastingLight& light, const glm::mat3& envFromWorld,
                              const game::Ground& ground) {
    constexpr float kWidest = 0.75f; // radians: beyond, a cap is no disc
    render::FloorLight floor;
    floor.towards = glm::transpose(envFromWorld) * light.light.direction;
    floor.tangent = std::tan(std::min(light.light.radius, kWidest));
    floor.height_m = ground.height_m;
    const glm::vec3 all = glm::max(light.groundIrradiance, 1e-6f);
    floor.share = glm::clamp(light.light.irradiance * std::max(floor.towards.y, 0.0f) / all, 0.0f, 1.0f) *
                  (light.presence * ground.presence * floor.raised());
    return floor;
}

Result<Shadows> Shadows::make(std::vector<scene::Silhouette> bySpecies) {
    auto pass = render::ShadowPass::make();
    if (!pass) return pass.error();
    return Shadows(std::move(*pass), std::move(bySpecies));
}

void Shadows::set(const game::Snapshot& snapshot, const render::FloorLight& light) {
    light_ = light;
    pass_.begin();
    if (light.share == glm::vec3(0)) return;
    for (const game::CreatureView& creature : snapshot.creatures) {
        straightBody(creature, bySpecies_[static_cast<size_t>(creature.species)], body_);
        pass_.add(body_, light);
    }
    for (const game::HandView& hand : snapshot.hands) {
        if (!hand.visible) continue;
        handBody(hand, body_);
        pass_.add(body_, light);
    }
}

Status Shadows::draw(render::View view, const glm::vec3& eyeWorld, const water::Water& water,
                     const render::ShadowPass::Cover* cover) {
    view.eyeWorld = eyeWorld;
    return pass_.draw(view, light_, water, cover);
}

} // namespace shoal::app
