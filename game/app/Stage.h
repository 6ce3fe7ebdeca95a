// Draws a snapshot: creatures and hands in the light of the surround, the surround behind them.
#pragma once

#include "engine/render/BackdropPass.h"
#include "engine/render/ObjectPass.h"
#include "game/app/Cast.h"
#include "game/app/Surround.h"

namespace shoal::app {

class Stage {
  public:
    static Result<Stage> make(Cast cast, render::Detail detail);

    // Once a frame, before draw().
    void set(const game::Snapshot& snapshot, bool backdropOnly);

    // Once an eye (0 left, 1 right), into the bound framebuffer, whose viewport is set.
    Status draw(const Surround& surround, int eye, const render::View& view, const render::Exposure& exposure,
                const render::Water& water, render::Glossy glossy);

    // The two halves of draw(), for eyes that share a backdrop.
    Status drawBackdrop(const Surround& surround, int eye, const render::View& view,
                        const render::Exposure& exposure);
    Status drawObjects(const Surround& surround, int eye, const render::View& view,
                       const render::Exposure& exposure, const render::Water& water, render::Glossy glossy);

    int drawCount() const { return objects_.drawCount() + 1; }
    int triangleCount() const { return objects_.triangleCount(); }

  private:
    Stage(Cast cast, render::BackdropPass backdrop, render::ObjectPass objects)
        : cast_(std::move(cast)), backdrop_(std::move(backdrop)), objects_(std::move(objects)) {}
    Cast cast_;
    render::BackdropPass backdrop_;
    render::ObjectPass objects_;
};

} // namespace shoal::app
