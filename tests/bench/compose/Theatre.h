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

// The compositions that are compared.
struct Way {
    render::Composition composition;
    const char* name;
};
inline constexpr Way kWays[] = {{render::Composition::Plain, "plain"},
                                {render::Composition::MatchedResolution, "resolution"},
                                {render::Composition::VideoTexels, "texels"},
                                {render::Composition::CameraResponse, "camera"}};

// The simulation up to a time of the dive; nobody plays.
app::GameSession runTo(const app::SessionConfig& plan, double time_s);
void runOn(app::GameSession& session, double seconds);

Result<app::SceneRenderer> makeSceneRenderer(const app::SessionConfig& plan, render::Composition composition);
Result<std::unique_ptr<app::Environment>> openVideo(const Path& file);

// yaw: to the right.
render::View viewOf(const game::Snapshot& snapshot, float yaw_deg, int heightPixels);

// The whole picture, as Play draws it. target: of any size in the picture's proportions.
Status drawPicture(app::SceneRenderer& sceneRenderer, const render::View& view, const gl::Target& target);

// The objects alone, premultiplied by coverage.
Status drawObjectsAlone(app::SceneRenderer& sceneRenderer, const render::View& view,
                        const gl::Target& target);

} // namespace shoal::bench
