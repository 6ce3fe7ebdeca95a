// Selects, from the lights found in single frames, the one that throws the shadows now: it moves smoothly,
// fades where it is lost, and gives way to another only when that has been stronger for a while.
#pragma once

#include "engine/light/FindLights.h"

namespace shoal::light {

struct ShadowLight {
    FoundLight light;
    glm::vec3 groundIrradiance{0}; // from FoundLights, smoothed in the same way
    float presence = 0;            // 0: none, 1: fully there; a factor for its shadows
};

// Returns the difference between two scenes, 0 to 1: the mean over the sphere of |a - b| / (a + b) of their
// luminances (Lance and Williams 1967), in which bright parts do not outweigh the rest.
float sceneDistance(const FoundLights& a, const FoundLights& b);

// Follows the shadow light. The result depends only on the frames shown and the times between them.
class LightOverTime {
  public:
    // Updates the shadow light from the lights found in the frame now shown; dt_s: since the last call. The
    // same light is followed with a time constant of 0.15 s, at most at 22 degrees a second. A light that
    // jumps by more than 15 degrees (or, if larger, 0.7 of its radius) is lost: it fades out, and the
    // strongest light replaces it. In the first frame and after a cut the strongest light is taken at once.
    const ShadowLight& follow(const FoundLights& found, float dt_s);

  private:
    void take(const FoundLights& found, float presence);

    ShadowLight now_;
    FoundLights last_;
    bool begun_ = false;
    float strongerFor_s_ = 0; // how long another light has been much stronger
};

} // namespace shoal::light
