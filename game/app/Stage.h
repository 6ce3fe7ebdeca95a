// Draws a snapshot: creatures and hands in the light of the surround, the surround behind them.
#pragma once

#include "engine/render/BackdropPass.h"
#include "engine/render/FrameTiles.h"
#include "engine/render/LatLongPass.h"
#include "engine/render/LayerPass.h"
#include "engine/render/ObjectPass.h"
#include "engine/render/SnowPass.h"
#include "game/app/Cast.h"
#include "game/app/Shadows.h"
#include "game/app/Surround.h"

#include <optional>
#include <vector>

namespace shoal::app {

// How objects come into the picture of the surround.
enum class Compose {
    Plain,      // as finely as the picture is drawn
    Resolution, // as finely as the surround's own picture is, where that is coarser, and scaled up with it
    Texels,     // into the texels of the surround's own picture, and shown with it
    Camera // as Texels, and as the surround's camera would have filmed them; an HDR picture has none: plainly
};

struct StageSetup {
    render::Detail detail = render::Detail::Full;
    bool snow = true;      // specks drift in the water, where there is water
    bool shadows = true;   // fall on the video's ground, where that is known and the surround finds lights
    bool occlusion = true; // bodies take light from each other
    Compose compose = Compose::Plain;
    int layerSamples = 4; // for anti-aliasing, of objects that are scaled up
};

// Where nothing else is asked for. Four cost a software renderer half a frame; what is painted into texels is
// drawn smooth between its pixels before it is enlarged, and one is enough.
constexpr int layerSamplesFor(Compose compose, bool software) {
    return software && compose != Compose::Resolution ? 1 : 4;
}

class Stage {
  public:
    static Result<Stage> make(Cast cast, const StageSetup& setup);

    // Once a frame, before draw().
    void set(const game::Snapshot& snapshot, const Surround& surround, bool backdropOnly);

    // What one eye's picture is drawn with.
    struct Eye {
        const Surround& surround;
        int eye = 0; // left, 1: right
        render::View view;
        render::Exposure exposure;
        water::Water water;
        render::Glossy glossy = render::Glossy::Prefiltered;
        glm::ivec2 size{0}; // of the canvas, in pixels
    };

    // To save time, of the eye that is drawn first, before all the others.
    void beginBackdrop(const Eye& eye);

    // For each eye: drawLayer() first, which binds a framebuffer of its own, then the others into the canvas,
    // which is bound by then. Software renderers finish a framebuffer before they begin another: there are
    // two in a frame.
    Status drawLayer(const Eye& eye);
    Status drawBackdrop(const Eye& eye);
    Status drawObjects(const Eye& eye);
    bool needsDepth(const Eye& eye) const; // drawObjects() does, of the canvas

    // Where objects lie in the backdrop, each eye has its own.
    bool eyesShareBackdrop() const { return frames_.empty(); }

    int drawCount() const {
        return objects_.drawCount() + 1 + (snow_ ? 1 : 0) + (shadows_ ? shadows_->drawCount() : 0) +
               (layers_.empty() ? 0 : 1);
    }
    int triangleCount() const { return objects_.triangleCount(); }

  private:
    Stage(Cast cast, render::BackdropPass backdrop, render::ObjectPass objects)
        : cast_(std::move(cast)), backdrop_(std::move(backdrop)), objects_(std::move(objects)) {}
    bool paintsTexels(const Eye& eye) const;
    render::BackdropPass::InMemory inMemory(const Eye& eye) const; // where the surround's frame is
    void chooseTexels(const Eye& eye);
    Status paintFrame(const Eye& eye); // on the graphics side
    Status drawFromMemory(const Eye& eye);
    render::View layerView(const Eye& eye) const;
    // Of the eye's picture; as large as that where objects are drawn straight into it.
    glm::ivec2 layerSize(const Eye& eye) const;
    Status drawSnow(render::SnowPass::On on, const Eye& eye, const render::View& view);
    Status drawBodies(const Eye& eye, const render::View& view);

    Cast cast_;
    render::BackdropPass backdrop_;
    render::ObjectPass objects_;
    std::optional<render::SnowPass> snow_;
    std::optional<Shadows> shadows_;
    std::vector<render::LayerPass> layers_;   // one an eye; none: objects are drawn straight into the picture
    std::vector<render::LatLongPass> frames_; // one an eye; where objects go into the surround's own picture
    render::FrameTiles tiles_;                // of it, of the eye drawn last
    std::vector<uint8_t> grain_;              // of films, where they are painted in memory
    Compose compose_ = Compose::Plain;
    int layerSamples_ = 1;
    double time_s_ = 0;
    glm::vec3 headWorld_{0};
    bool backdropOnly_ = false;
    bool texelsChosen_ = false; // of the eye whose backdrop has begun
};

} // namespace shoal::app
