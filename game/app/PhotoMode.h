// Photo mode: the dive stands still, the camera is free and no text covers the picture; a press saves it and
// a lat-long of all directions as PNG files in the player's folder for pictures.
#pragma once

#include "engine/core/Files.h"
#include "game/rules/Snapshot.h"
#include "game/session/Controls.h"
#include "game/texts/Texts.h"
#include "game/views/SceneRenderer.h"

namespace shoal::app {

class PhotoMode {
  public:
    // The camera starts at the player's view. bindings: the keys that move the camera.
    PhotoMode(const game::Snapshot& shown, float fov_deg, bool byGamepad, const Bindings& bindings);

    enum class Command { None, Picture, Leave };
    // Moves the camera and returns the player's command; once a frame. fov_deg: the picture's, which the
    // wheel changes.
    Command step(const Controls& controls, float sensitivity, float dt_s, float& fov_deg);
    // The dive's snapshot, with the free camera as the viewer.
    const game::Snapshot& shown() const { return shown_; }
    float fovBefore_deg() const { return fovBefore_deg_; }

    // Saves the picture and a lat-long of all directions, and sets the notice.
    void save(const ImageRgb8& picture, SceneRenderer& renderer);
    // The notice to show; null: none.
    const game::Notice* notice() const { return notice_ ? &*notice_ : nullptr; }
    void clearNotice() { notice_.reset(); }

    static constexpr float kReach_m = 0.5f; // farthest from the player: beyond, the film has holes

  private:
    void move(const Controls& controls, float sensitivity, float dt_s, float& fov_deg);

    game::Snapshot shown_;
    glm::vec3 origin_;
    LookAngles look_;
    float fovBefore_deg_;
    std::optional<game::Notice> notice_;
};

// Draws the scene in all directions as a lat-long picture, twice as wide as high.
Result<ImageRgb8> drawAround(SceneRenderer& renderer, glm::vec3 eyeWorld, int width);

} // namespace shoal::app
