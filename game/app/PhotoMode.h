// Photo mode: the dive stands still, the camera is free, nothing is written over the picture; a press saves
// it and the whole surroundings as PNG files in the player's folder for pictures.
#pragma once

#include "engine/core/Files.h"
#include "game/rules/Snapshot.h"
#include "game/session/Controls.h"
#include "game/session/LookAngles.h"
#include "game/texts/Texts.h"
#include "game/views/SceneRenderer.h"

namespace shoal::app {

class PhotoMode {
  public:
    // From where the player looks. bindings: the keys that move the camera.
    PhotoMode(const game::Snapshot& shown, float fov_deg, bool byGamepad, const Bindings& bindings);

    enum class Command { None, Picture, Leave };
    // Once a frame: moves the camera, and tells what the player wants. fov_deg: of the picture, which the
    // wheel changes.
    Command step(const Controls& controls, const platform::WindowInput& input, float sensitivity, float dt_s,
                 float& fov_deg);
    // The snapshot as the free camera sees it.
    const game::Snapshot& shown() const { return shown_; }
    float fovBefore_deg() const { return fovBefore_deg_; }

    // Writes the picture, and one of all directions, and says so.
    void save(const ImageRgb8& picture, SceneRenderer& renderer);
    // To be shown; null: nothing.
    const game::Notice* notice() const { return notice_ ? &*notice_ : nullptr; }
    void clearNotice() { notice_.reset(); }

    static constexpr float kReach_m = 0.5f; // the camera goes from where the player is: farther, what the
                                            // film's camera did not see leaves holes

  private:
    void move(const Controls& controls, float sensitivity, float dt_s, float& fov_deg);

    game::Snapshot shown_;
    glm::vec3 origin_;
    LookAngles look_;
    float fovBefore_deg_;
    std::optional<game::Notice> notice_;
};

// The scene in every direction: lat-long, twice as wide as high.
Result<ImageRgb8> drawAround(SceneRenderer& renderer, glm::vec3 eyeWorld, int width);

} // namespace shoal::app
