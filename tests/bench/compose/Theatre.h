// The dive as the game draws it, at chosen moments.
#pragma once

#include "engine/gl/Target.h"
#include "game/session/GameSession.h"
#include "game/views/Environment.h"
#include "game/views/SceneRenderer.h"

#include <optional>

namespace shoal::bench {

constexpr glm::ivec2 kPicture(1280, 720);
constexpr float kFov_deg = 65; // vertical, as in the game

// One of the compositions that are compared.
struct Way {
    render::Composition composition;
    const char* name;
};
inline constexpr Way kWays[] = {{render::Composition::Plain, "plain"},
                                {render::Composition::MatchedResolution, "resolution"},
                                {render::Composition::VideoTexels, "texels"},
                                {render::Composition::CameraResponse, "camera"}};

// Runs the simulation to a time of the dive, without a player.
app::GameSession runTo(const app::SessionConfig& plan, double time_s);
void runOn(app::GameSession& session, double seconds);

Result<app::SceneRenderer> makeSceneRenderer(const app::SessionConfig& plan, render::Composition composition);
Result<std::unique_ptr<app::Environment>> openVideo(const Path& file);

// yaw_deg: turn of the view to the right.
render::View viewOf(const game::Snapshot& snapshot, float yaw_deg, int heightPixels);

// Draws the whole picture as Play does. target: of any size with the picture's aspect ratio.
Status drawPicture(app::SceneRenderer& sceneRenderer, const render::View& view, const gl::Target& target);

// Draws the objects alone, premultiplied by coverage.
Status drawObjectsAlone(app::SceneRenderer& sceneRenderer, const render::View& view,
                        const gl::Target& target);

} // namespace shoal::bench
