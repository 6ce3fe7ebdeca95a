// Photo mode: the dive stands still, the camera is free, nothing is written over the picture; a press saves
// it and the whole surroundings as PNG files in the player's folder for pictures.
#pragma once

#include "engine/core/Files.h"
#include "game/rules/Snapshot.h"
#include "game/session/Controls.h"
#include "game/session/LookAngles.h"
#include "game/views/SceneRenderer.h"

namespace shoal::app {

class PhotoMode {
  public:
    // From where the player looks.
    explicit PhotoMode(const game::Snapshot& shown);

    // fov_deg: of the picture, which the wheel changes.
    void move(const Controls& controls, float sensitivity, float dt_s, float& fov_deg);
    // The snapshot as the free camera sees it.
    const game::Snapshot& shown() const { return shown_; }

    static constexpr float kReach_m = 1.5f; // the camera goes from where the player is: farther, the film's
                                            // own place would show

  private:
    game::Snapshot shown_;
    glm::vec3 origin_;
    LookAngles look_;
};

// The scene in every direction: lat-long, twice as wide as high.
Result<ImageRgb8> drawAround(SceneRenderer& renderer, glm::vec3 eyeWorld, int width);

// A new file's name in the folder for pictures, by date and time: shoal-2026-11-22-213045.png; what: "-360"
// or
// "".
Path newPictureFile(std::string_view what);

} // namespace shoal::app
