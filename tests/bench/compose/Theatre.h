// The dive as the game draws it, at moments of our choice.
#pragma once

#include "engine/gl/Target.h"
#include "game/app/Plan.h"
#include "game/app/Run.h"
#include "game/app/Stage.h"
#include "game/app/Surround.h"

#include <optional>

namespace shoal::bench {

constexpr glm::ivec2 kPicture(1280, 720);
constexpr float kFov_deg = 65; // vertical, as in the game

// One way of compositing with what it needs.
struct Way {
    app::Compose compose;
    const char* name;
};
inline constexpr Way kWays[] = {{app::Compose::Plain, "plain"},
                                {app::Compose::Resolution, "resolution"},
                                {app::Compose::Texels, "texels"},
                                {app::Compose::Camera, "camera"}};

// The simulation up to a time of the dive; nobody plays.
app::Run runTo(const app::Plan& plan, double time_s);
void runOn(app::Run& run, double seconds);

Result<app::Stage> makeStage(const app::Plan& plan, app::Compose compose);
Result<app::Surround> openVideo(const Path& file, const app::Plan& plan);

// yaw: to the right.
render::View viewOf(const game::Snapshot& snapshot, float yaw_deg, int heightPixels);

// The whole picture, as Play draws it. target: of any size in the picture's proportions.
Status drawPicture(app::Stage& stage, const app::Surround& surround, const render::View& view,
                   const gl::Target& target);

// The objects alone, premultiplied by coverage. For a stage that composes plainly.
Status drawObjectsAlone(app::Stage& stage, const app::Surround& surround, const render::View& view,
                        const gl::Target& target);

} // namespace shoal::bench
