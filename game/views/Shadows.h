// Shadows of the posed bodies on the ground that the video shows, and the light that casts them.
#pragma once

#include "engine/light/LightOverTime.h"
#include "engine/render/BodyOccluders.h"
#include "engine/render/ShadowPass.h"
#include "game/rules/Snapshot.h"

#include <glm/mat3x3.hpp>

namespace shoal::app {

// The light on the snapshot's ground; its share is 0 where one of the two is missing.
render::FloorLight floorLight(const light::ShadowLight& light, const glm::mat3& envFromWorld,
                              const game::Ground& ground);

class Shadows {
  public:
    static Result<Shadows> make();

    // Once a frame, before draw().
    void set(const render::NearBodies& bodies, const render::FloorLight& light);

    // On the backdrop, which has just been drawn. eyeWorld: where the video's picture was taken for this eye;
    // cover: what it shows of objects, if any.
    Status draw(render::View view, const glm::vec3& eyeWorld, const water::Water& water,
                const render::ShadowPass::Cover* cover);

    int drawCount() const { return pass_.patches() > 0 ? 1 : 0; }

  private:
    explicit Shadows(render::ShadowPass pass) : pass_(std::move(pass)) {}
    render::ShadowPass pass_;
    render::FloorLight light_;
};

} // namespace shoal::app
