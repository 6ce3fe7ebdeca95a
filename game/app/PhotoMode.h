// In photo mode the dive stands still and the camera is free. The picture shows no text, and it shows the
// player's hands only if the player wants them. A press saves the picture and a lat-long of all directions as
// PNG files in the player's folder for pictures.
#pragma once

#include "engine/core/Image.h"
#include "game/rules/Snapshot.h"
#include "game/session/Controls.h"
#include "game/views/ArmPose.h"

namespace shoal::app {

class SceneRenderer;

class PhotoMode {
  public:
    // The camera starts at the player's view. bindings: the keys that move the camera.
    PhotoMode(const game::Snapshot& from, float fov_deg, bool byGamepad, const Bindings& bindings);

    enum class Command { None, Picture, Leave };
    // Moves the camera and returns the player's command; once a frame. fov_deg: changed by the wheel.
    Command step(const Controls& controls, float sensitivity, float dt_s, float& fov_deg);
    // Saves the picture and a lat-long of all directions, and sets the notice.
    void save(const ImageRgb8& picture, SceneRenderer& renderer);

    game::Snapshot shown; // the dive's, with the free camera as the viewer
    Head player;          // head of the player, from which the arms are drawn
    float fovBefore_deg;
    std::optional<game::Notice> notice; // to show now

  private:
    std::array<bool, 2> hands_; // which hands the dive shows; the player can switch them on
    LookAngles look_;
};

} // namespace shoal::app
