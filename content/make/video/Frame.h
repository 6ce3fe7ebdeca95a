// Drawing of a frame's radiance, before the camera turns it into display values.
#pragma once

#include "content/make/video/Drawn.h"
#include "content/make/video/Noise.h"
#include "content/make/video/Sea.h"
#include "content/make/video/Veil.h"
#include "content/make/video/World.h"

namespace shoal::reef {

class Filming {
  public:
    Filming(const Scene& scene, const Route& route, World& world);
    // Draws a lat-long frame without snow; its env frame is the world frame moved to the camera. turn: time
    // in films. edges: more rays where neighbours differ. beside: offset from the camera's path, metres.
    Drawn draw(float turn, int width, bool edges, const vec3& beside = vec3(0));
    // Returns the frame at a time between two drawn ones, `share` of the way from a to b: reprojects both by
    // their distances and blends them.
    Drawn between(const Drawn& a, const Drawn& b, float share, float turn) const;
    // Adds marine snow, and plankton that glows.
    void addSpecks(Drawn& drawn, float turn) const {
        addSnow(drawn, turn);
        addPlankton(drawn, turn);
    }

  private:
    void addSnow(Drawn& drawn, float turn) const;
    void addPlankton(Drawn& drawn, float turn) const;
    struct Sample {
        vec3 radiance{0};
        float distance = 0;
    };
    Sample look(const vec2& uv, float pixelAngle) const;
    vec3 surfaceFromBelow(const vec3& dir, float distance, float pixelAngle) const;
    vec3 shade(Hit& hit, float footprint) const;

    const Scene& scene_;
    const Route& route_;
    World& world_;
    Sea sea_;
    Caustics caustics_;
    Veil veil_;
    NoiseVolume lumps_{NoiseVolume::Kind::Lumps}, cells_{NoiseVolume::Kind::Cells};
    vec3 camera_{0};
};

} // namespace shoal::reef
