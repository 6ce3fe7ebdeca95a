// The soft shadow that a body of ellipsoids casts on what a film shows; no OpenGL.
//
// Seen from a place, the light is a cap of even radiance. On a plane at right angles to the direction to the
// light, the cap is a disc and each ellipsoid's silhouette an ellipse. The share of a disc that lies before a
// line at t radii from its middle is
//     C(t) = 1/2 + (t sqrt(1 - t^2) + asin t) / pi,
// so that a strip hides exactly C(t1) - C(t0) of it. The silhouettes' union is cut into rectangles, each of
// which is taken to hide the product of what its two strips hide: integrated over level ground, a body takes
// no more light than its silhouette does.
//
// Shafts in the water are not dimmed: single scattering loses at most 9 % of the luminance around a shark at
// 1.5 m, over 6 to 30 degrees, where the film itself changes by 10 to 20 % in half a second.
#pragma once

#include "engine/depth/DepthMap.h"
#include "engine/light/FindLights.h"
#include "engine/occlusion/Ellipsoid.h"
#include "engine/render/View.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace shoal::render {

struct CastingLight {
    glm::vec3 towards{0, 1, 0}; // unit, world frame
    float tangent = 0;          // tangent of its angular radius
    glm::vec3 share{0};         // share of level ground's irradiance that it gives, 0 to 1
    float presence = 1;         // factor for the light that shadows take, 0 to 1

    // Returns 1 if the light's lower edge is well above the horizon, falling to 0 for a low light: its share
    // on level ground does not tell its share on other surfaces.
    float raised() const;
    // Returns the tangent, but at least about twice the sun's.
    float discTangent() const { return std::max(tangent, 0.01f); }
    // Returns whether it is so wide that its shadows show no form.
    bool isWide() const { return tangent > 0.8f; }
    // Returns the light's share of the irradiance of a surface; cosine: between the surface's normal and the
    // direction to the light. All other light is taken to be the same as on level ground.
    glm::vec3 shareAt(float cosine) const;
};

// Returns the light found in a film as one that casts shadows, of presence 0 if none stands out.
CastingLight castingLight(const light::ShadowLight& found, const glm::mat3& worldFromEnv);

// Returns all other light as one that casts shadows: a cap of 45 degrees around the zenith. A small body
// right above level ground hides of it what it hides of an even sky's irradiance, its solid angle over pi.
CastingLight restBeside(const CastingLight& light);

// The surfaces that a frame of a film shows, known by its distances.
struct FilmSurface {
    const depth::DepthMap* map = nullptr;     // not null
    const depth::DepthRange* range = nullptr; // of the map; not null for FilmShadows
    glm::mat3 envFromWorld{1};                // a rotation
    glm::vec3 cameraWorld{0.0f};              // position of the film's camera
};

// Returns C(t) as above within 0.003: a polynomial, without calls.
inline float discBefore(float t) {
    const float c = std::min(std::max(t, -1.0f), 1.0f), c2 = c * c;
    return 0.5f + c * (0.65733645f + c2 * (-0.27372406f + c2 * (0.32543878f - c2 * 0.20905117f)));
}

// A strip across a body's silhouette as seen from the light: a rectangle.
struct FlatPiece {
    glm::vec3 middle{0};          // world frame
    glm::vec3 along{0}, aside{0}; // unit, at right angles to the way to the light and to each other
    float halfAlong_m = 0, halfAside_m = 0;
};

// Replaces out by pieces that all have the same along and aside. body: world frame.
void flatten(std::span<const occlusion::Ellipsoid> body, const CastingLight& light,
             std::vector<FlatPiece>& out);

// Returns the share of the light that a body hides from a place, 0 to 1. body: flattened for this light;
// place: world frame.
float covered(std::span<const FlatPiece> body, const CastingLight& light, const glm::vec3& place);

constexpr float kMinDisc_m = 1e-3f;  // least radius of the light's disc, where a body touches a place
constexpr float kMinShadow = 0.012f; // least share of light that is drawn: three of 255 display values

constexpr float kShadowReach_m = 8; // how far shadows fall; they fade over the last third

// Returns how many metres the shadow of a place falls, along the light, to the first surface that the film
// shows; negative if it meets nothing known within kShadowReach_m.
float fallOf(const FilmSurface& film, const glm::vec3& placeWorld, const CastingLight& light);

} // namespace shoal::render
