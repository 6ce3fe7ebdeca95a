// Draws a snapshot: creatures and hands in the light of the surround, the surround behind them.
#pragma once

#include "engine/render/BackdropPass.h"
#include "engine/render/ObjectPass.h"
#include "engine/render/SnowPass.h"
#include "game/app/Cast.h"
#include "game/app/Surround.h"

#include <optional>

namespace shoal::app {

class Stage {
  public:
    // snow: specks drift in the water, where there is water. occlusion: bodies take light from each other.
    static Result<Stage> make(Cast cast, render::Detail detail, bool snow, bool occlusion);

    // Once a frame, before draw().
    void set(const game::Snapshot& snapshot, bool backdropOnly);

    // Once an eye (0 left, 1 right), into the bound framebuffer, whose viewport is set.
    Status draw(const Surround& surround, int eye, const render::View& view, const render::Exposure& exposure,
                const water::Water& water, render::Glossy glossy);

    // Its two halves, for eyes that share a backdrop.
    Status drawBackdrop(const Surround& surround, int eye, const render::View& view,
                        const render::Exposure& exposure);
    Status drawObjects(const Surround& surround, int eye, const render::View& view,
                       const render::Exposure& exposure, const water::Water& water, render::Glossy glossy);

    int drawCount() const { return objects_.drawCount() + 1 + (snow_ ? 1 : 0); }
    int triangleCount() const { return objects_.triangleCount(); }

  private:
    Stage(Cast cast, render::BackdropPass backdrop, render::ObjectPass objects,
          std::optional<render::SnowPass> snow)
        : cast_(std::move(cast)), backdrop_(std::move(backdrop)), objects_(std::move(objects)),
          snow_(std::move(snow)) {}
    Cast cast_;
    render::BackdropPass backdrop_;
    render::ObjectPass objects_;
    std::optional<render::SnowPass> snow_;
    double time_s_ = 0;
    bool backdropOnly_ = false;
};

} // namespace shoal::app
