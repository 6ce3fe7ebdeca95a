// Loads the film, its light, the models and the renderer of a dive, and after a change of options again only
// the parts that it affects. Only on the thread of the OpenGL context.
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
    ContentLoader(const ContentLoader&) = delete; // the renderer holds the models' address
    ContentLoader& operator=(const ContentLoader&) = delete;

    // Opens the parts that these options need and that are not open yet, after a change of settings, dive or
    // film. Sets the film's length and distances in the config's dive. seesRoom: the display can show the
    // player's room. filmFirst: shows the film while models load. After an error nothing may be drawn.
    Status open(const PlayOptions& options, SessionConfig& config, bool seesRoom, bool filmFirst);

    // Loads the model of a species that the dive lacks, in some tenths of a second. Returns the model's
    // greatest extent over its length. If there is none, logs why.
    std::optional<float> loadSpecies(const SessionConfig& config, size_t species);

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
    std::optional<Models> loaded_; // the models that there are
    CreatureModels models_;
    std::optional<size_t> unloadable_; // the species whose model could not be loaded last
    std::unique_ptr<Environment> environment_;
    std::optional<SceneRenderer> renderer_;
    std::shared_ptr<const game::FilmSpace> space_;
};

// Returns the rules' grid of distances, from the depth track beside a film; null without a track, or with one
// that cannot be read (a warning says why). yaw: turn of the environment about the player, radians to the
// right. Opens the track a second time, because the film's player reads other frames of it on another thread.
// Decodes a few hundred frames, in half a second.
std::shared_ptr<const game::FilmSpace> filmSpaceOf(const Path& film, float yaw);

// Sets the FilmSpace of the config's dive from the film's depth track; null without a track, or for a replay
// that was recorded without one.
Status findFilmSpace(const Path& film, const EnvironmentOptions& options, SessionConfig& config);

} // namespace shoal::app
