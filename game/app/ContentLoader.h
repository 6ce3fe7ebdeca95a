// Loader of what a dive shows and is lit by: film, models and the renderer. Opens again only what other
// options change. The thread of the OpenGL context only.
#pragma once

#include "game/session/GameSession.h"
#include "game/views/Environment.h"
#include "game/views/SceneRenderer.h"

#include <functional>
#include <memory>
#include <optional>

namespace shoal::app {

class ContentLoader {
  public:
    // progress: draws the loading screen with the share done, -1 if unknown; returns false to stop.
    explicit ContentLoader(std::function<bool(float)> progress) : progress_(std::move(progress)) {}

    // Opens what these options want and is not open: after each change of a setting, and for another dive or
    // film. Sets what the config's rules know of the film. seesRoom: the display can show the player's room.
    // filmFirst: shows the dive's film while the models are loaded. After an error nothing may be drawn.
    Status open(const PlayOptions& options, SessionConfig& config, bool seesRoom, bool filmFirst);

    // Returns whether there is a picture to draw, while the rest is loaded too.
    bool hasPicture() const { return environment_ && renderer_; }
    Environment& environment() { return *environment_; }
    const Environment& environment() const { return *environment_; }
    SceneRenderer& renderer() { return *renderer_; }

  private:
    struct Models {
        render::Reflectance reflectance;
        std::string skin;
        std::vector<bool> shown; // by index into the species table
        bool operator==(const Models&) const = default;
    };

    std::function<bool(float)> progress_;
    std::unique_ptr<Environment> environment_;
    std::optional<SceneRenderer> renderer_;
    std::optional<CreatureModels> models_; // empty while the renderer has them
    std::optional<Models> loaded_;
    float minRoughness_ = 1; // of the models
    std::shared_ptr<const game::FilmSpace> space_;
};

// Gives the rules the distances of the film, none without a file. A replay recorded without them is played
// without them.
Status findFilmSpace(const Path& film, const EnvironmentOptions& options, SessionConfig& config);

} // namespace shoal::app
