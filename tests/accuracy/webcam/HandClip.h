// Synthetic clips of our own hand models before a webcam, with known poses.
#pragma once

#include "engine/gl/Target.h"
#include "engine/platform/Window.h"
#include "game/views/CreatureModels.h"
#include "input/hands/HandFilter.h"
#include "input/hands/HandRig.h"

#include <opencv2/core.hpp>

#include <functional>
#include <map>
#include <optional>

namespace shoal::hands::test {

enum class Behind { Grey, Gradient, Wood, Room };

// A hand at one moment; camera's frame (x right in the picture, y up, the camera looks along -z).
struct Shown {
    glm::vec3 palm{0, 0, -0.5f}; // metres
    Gesture gesture = Gesture::Open;
    float roll = 0; // radians, in the picture
    float tilt = 0; // radians, the fingers towards the camera
};

HandPose shownHand(const HandRig& rig, Side side, const Shown& shown);

class HandClip {
  public:
    // Fails without OpenGL.
    static Result<HandClip> make(cv::Size size, float horizontalFov);

    // Draws the hands alone, with their coverage in alpha. Caches the first hundred pictures, since most rows
    // show the same hands.
    ImageRgba8 hands(const std::array<std::optional<HandPose>, 2>& poses);
    // Returns the hands before a background, blue first, with sensor noise. paint: adds to the background.
    cv::Mat picture(const ImageRgba8& hands, Behind behind, const std::function<void(cv::Mat&)>& paint = {});

  private:
    HandClip() = default;
    std::optional<platform::Headless> context_; // first: it dies last
    std::optional<app::CreatureModels> creatureModels_;
    std::optional<render::ObjectPass> pass_;
    std::optional<render::EnvironmentGpu> environment_;
    std::optional<gl::Target> target_;
    std::array<cv::Mat, 4> behind_;        // by Behind
    std::map<uint64_t, ImageRgba8> drawn_; // by a hash of the poses
    cv::Size size_;
    float verticalFov_ = 0.8f;
    cv::RNG random_{1};
};

} // namespace shoal::hands::test
