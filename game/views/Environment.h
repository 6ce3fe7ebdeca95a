// Environment of a dive as OpenGL textures: the picture around the player, and the light made from it.
// Used on the thread of the OpenGL context.
#pragma once

#include "engine/environment/Player.h"
#include "engine/render/EnvironmentGpu.h"
#include "engine/render/ModelGpu.h"
#include "engine/render/View.h"
#include "game/settings/PlayOptions.h"
#include "game/texts/Texts.h"

#include <glm/mat3x3.hpp>

#include <array>
#include <memory>
#include <optional>

namespace shoal::app {

struct EnvironmentSetup {
    environment::Setup player;
    float yaw_deg = 0;     // turn of the environment about the vertical axis, positive to the right
    bool bothEyes = false; // each eye sees its half of a stereo picture; else both see the left one

    bool operator==(const EnvironmentSetup&) const = default;
};

// Returns how reflectance is coded under this environment's light. Models need it before open().
render::Reflectance reflectanceIn(const environment::Source& source);

// Returns the film to play: NAME.small.mp4 beside `film` if chosen (Auto: on a slow computer) and present.
Path filmFor(const Path& film, FilmChoice choice, bool slowComputer);

class Environment {
  public:
    // Opens an environment, with its first picture. Needs a current GL context.
    static Result<std::unique_ptr<Environment>> open(const EnvironmentSetup& setup,
                                                     const environment::Wait& wait = {});

    // See environment::Player::update().
    bool update(double time_s, bool exactFrame) {
        if (!player_->update(time_s, exactFrame)) return false;
        upload();
        return true;
    }

    const environment::Player& player() const { return *player_; }
    const EnvironmentSetup& setup() const { return setup_; }
    void setLightEvery(int frames) { player_->setLightEvery(frames); }

    // Distances to the surfaces in the frame; null: unknown. In a stereo film, those of the left picture.
    const depth::DepthMap* depth() const { return gpu_[0].depth().map; }
    // eye: 0 left, 1 right.
    const render::EnvironmentGpu& gpu(int eye) const {
        return gpu_[eyesSeeTheSame() ? 0 : static_cast<size_t>(eye)];
    }
    bool eyesSeeTheSame() const { return !setup_.bothEyes || player_->layout() == media::Layout::Mono; }
    glm::mat3 envFromWorld() const;
    render::Exposure exposure(Tone chosen, float exposure_ev) const;
    float upload_ms() const { return upload_ms_; } // time to upload the newest frame
    game::Text lightName() const;
    // Returns the message to the player while the video is damaged, stopped or lost; null: it plays.
    const game::Notice* notice() const;

  private:
    explicit Environment(const EnvironmentSetup& setup) : setup_(setup) {}
    void upload();

    EnvironmentSetup setup_;
    std::unique_ptr<environment::Player> player_;
    std::optional<render::PlanesPass> planes_;  // empty: the processor converts frames
    std::array<render::EnvironmentGpu, 2> gpu_; // per eye; the second only where each eye has its own picture
    float upload_ms_ = 0;
};

} // namespace shoal::app
