// Finds the few bright places of an environment that throw shadows, such as the sun or Snell's window, in
// every frame's radiance pyramid.
//
// A texel counts as light if its luminance lies more than sqrt(3) standard deviations above the mean of the
// sphere (a threshold as in Rhee, Petikam, Allen and Chalmers 2017, "MR360: Mixed Reality Rendering for 360
// Panoramic Videos"). No part of a linear gradient does, and at most a quarter of any sphere (Cantelli's
// inequality): an overcast sky is no light. A window starts at the texel with most flux, shifts to the mode
// (mean shift: Cheng 1995) and adapts its size to the light in it (Bradski 1998, "Computer Vision Face
// Tracking for Use in a Perceptual User Interface"); spherical moments give the light's position and size.
//
// Haze, clouds and horizon shape the glow around a clipped sun. In a window no wider than a sun with its
// glow, texels are therefore weighted by the fifth power of their excess over the mean, and the window
// shrinks to the brightest. A wider window contains half a scene: its centre is that of all its light.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace shoal::light {

struct FoundLight {
    glm::vec3 direction{0, 1, 0}; // towards it, unit length, env frame
    float radius = 0;             // angular radius in radians, of a uniform cap with the same spread
    glm::vec3 irradiance{0};      // of this light alone, on a plane that faces it
    float share = 0;              // share of the luminance of all light on that plane, 0 to 1
};

constexpr size_t kMaxLights = 3;
constexpr size_t kThumbWidth = 32, kThumbHeight = 16;

struct FoundLights {
    std::array<FoundLight, kMaxLights> lights; // the first `count`, the strongest first
    size_t count = 0;
    glm::vec3 groundIrradiance{0};                         // on level ground, from the whole sphere
    std::array<float, kThumbWidth * kThumbHeight> thumb{}; // luminance, lat-long: for sceneDistance()
};

struct BrightTexel {
    glm::vec3 direction{0};
    float weight = 0; // flux above the sphere's mean, times the share to which the texel counts as light
    float above = 0;  // luminance above the sphere's mean
};

// Keeps tables and scratch: allocates nothing after the first call. One thread at a time.
class LightFinder {
  public:
    LightFinder();
    void find(const RadiancePyramid& radiance, FoundLights& out);

  private:
    void addIfBright(const glm::vec3& direction, float luminance, float solidAngle_sr,
                     std::vector<BrightTexel>& texels) const;
    void gatherNear(const glm::vec3& middle, float reach, const ImageRgbF& fine);
    void settle(FoundLight& light, float window) const;
    void sharpen(float reach, FoundLight& light);
    FoundLight seek(const glm::vec3& seed, const ImageRgbF& fine, float& reach);
    void weigh(const ImageRgbF& coarse, float reach, FoundLight& light) const;

    const std::vector<glm::vec3> directions_, fineDirections_; // of texels of the coarse and fine level
    std::vector<float> luminance_;                             // by texel of the coarse level
    std::vector<BrightTexel> bright_, near_; // texels of the coarse level; near a light, of the fine level
    float mean_ = 0, deviation_ = 0;         // mean and deviation of luminance over the sphere
};

struct ShadowLight {
    FoundLight light;
    glm::vec3 groundIrradiance{0}; // from FoundLights, smoothed in the same way
    float presence = 0;            // 0: none, 1: fully there; a factor for its shadows
};

// Selects, from the lights found in single frames, the one that throws the shadows now: it moves smoothly,
// fades where it is lost, and gives way to another only when that has been stronger for a while.
//
// The result depends only on the frames shown and the times between them.
class LightOverTime {
  public:
    // Updates the shadow light from the lights found in the frame now shown; dt_s: since the last call. The
    // same light is followed with a time constant of 0.15 s, at most at 22 degrees a second. A light that
    // jumps by more than 15 degrees (or, if larger, 0.7 of its radius) is lost: it fades out, and the
    // strongest light replaces it. In the first frame and after a cut the strongest light is taken at once.
    const ShadowLight& follow(const FoundLights& found, float dt_s);

  private:
    const ShadowLight& take(const FoundLights& found, float presence);

    ShadowLight now_;
    FoundLights last_;
    bool begun_ = false;
    float strongerFor_s_ = 0; // how long another light has been much stronger
};

} // namespace shoal::light
