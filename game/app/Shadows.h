// What of a snapshot throws shadows on the ground that the video shows, and by which light.
#pragma once

#include "engine/light/LightOverTime.h"
#include "engine/render/ShadowPass.h"
#include "engine/scene/Silhouette.h"
#include "game/Snapshot.h"

#include <glm/mat3x3.hpp>

#include <span>
#include <vector>

namespace shoal::app {

// The light on the snapshot's ground; its share is 0 where one of the two is missing.
render::FloorLight floorLight(const light::CastingLight& light, const glm::mat3& envFromWorld,
                              const game::Ground& ground);

class Shadows {
  public:
    // bySpecies: how wide each species' model is.
    static Result<Shadows> make(std::vector<scene::Silhouette> bySpecies);

    // Once a frame, before draw().
    void set(const game::Snapshot& snapshot, const render::FloorLight& light);

    // On the backdrop, which has just been drawn. eyeWorld: where the video's picture was taken for this eye;
    // cover: what it shows of objects, if any.
    Status draw(render::View view, const glm::vec3& eyeWorld, const water::Water& water,
                const render::ShadowPass::Cover* cover);

    int drawCount() const { return pass_.patches() > 0 ? 1 : 0; }

  private:
    Shadows(render::ShadowPass pass, std::vector<scene::Silhouette> bySpecies)
        : pass_(std::move(pass)), bySpecies_(std::move(bySpecies)) {}
    render::ShadowPass pass_;
    std::vector<scene::Silhouette> bySpecies_;
    render::FloorLight light_;
    std::vector<render::CastingPiece> body_; // scratch
};

} // namespace shoal::app
