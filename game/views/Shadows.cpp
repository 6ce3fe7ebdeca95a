#include "game/views/Shadows.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::app {

render::FloorLight floorLight(const light::ShadowLight& light, const glm::mat3& envFromWorld,
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

Result<Shadows> Shadows::make() {
    auto pass = render::ShadowPass::make();
    if (!pass) return pass.error();
    return Shadows(std::move(*pass));
}

void Shadows::set(const render::NearBodies& bodies, const render::FloorLight& light) {
    light_ = light;
    pass_.begin();
    if (light.share == glm::vec3(0)) return;
    for (size_t body = 0; body < bodies.count(); ++body) pass_.add(bodies.ellipsoids(body), light);
}

Status Shadows::draw(render::View view, const glm::vec3& eyeWorld, const water::Water& water,
                     const render::ShadowPass::Cover* cover) {
    view.eyeWorld = eyeWorld;
    return pass_.draw(view, light_, water, cover);
}

} // namespace shoal::app
