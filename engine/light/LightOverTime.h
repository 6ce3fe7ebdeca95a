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

// Returns how much two scenes differ, 0 to 1: the mean over the sphere of |a - b| / (a + b) of their
// luminances (Lance and Williams 1967), so that bright parts do not outweigh the rest.
float sceneDistance(const FoundLights& a, const FoundLights& b);

// The result depends on nothing but the frames shown and the times between them.
class LightOverTime {
  public:
    // Follows the lights found in the frame now shown; dt_s: since the last call. The same light is followed
    // with a time constant of 0.15 s, at most at 22 degrees a second; one that is more than 15 degrees ahead
    // (or most of its radius) is lost: it fades, and is taken up anew where it then is. After a cut, and at
    // first, the strongest light is taken as it is.
    const ShadowLight& follow(const FoundLights& found, float dt_s);

  private:
    void take(const FoundLights& found, float presence);

    ShadowLight now_;
    FoundLights last_;
    bool begun_ = false;
    float strongerFor_s_ = 0; // how long another light has been much stronger
};

} // namespace shoal::light
