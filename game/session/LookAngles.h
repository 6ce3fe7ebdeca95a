// Direction of a view that the player turns by hand: yaw about the world's up, then pitch.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::app {

constexpr float kDragTurn_rad = 0.0032f; // turn of the view for a pixel that the mouse is dragged

struct LookAngles {
    static constexpr float kPitchMax_rad = 1.45f;

    float yaw_rad = 0, pitch_rad = 0; // to the right, up

    static LookAngles of(const glm::quat& worldFromView) {
        const glm::vec3 ahead = worldFromView * glm::vec3(0, 0, -1);
        LookAngles angles;
        angles.turnBy({std::atan2(ahead.x, -ahead.z), std::asin(std::clamp(ahead.y, -1.0f, 1.0f))});
        return angles;
    }
    void turnBy(glm::vec2 rad) { // +x right, +y up
        yaw_rad = std::remainder(yaw_rad + rad.x, 2 * std::numbers::pi_v<float>);
        pitch_rad = std::clamp(pitch_rad + rad.y, -kPitchMax_rad, kPitchMax_rad);
    }
    glm::quat worldFromView() const {
        return glm::angleAxis(-yaw_rad, glm::vec3(0, 1, 0)) * glm::angleAxis(pitch_rad, glm::vec3(1, 0, 0));
    }
};

} // namespace shoal::app
