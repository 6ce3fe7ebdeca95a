// One eye: where it stands, where it looks, what it covers.
#pragma once

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

#include <cmath>

namespace shoal::render {

struct View {
    glm::vec3 eyeWorld{0};
    glm::quat worldFromEye{1, 0, 0, 0}; // the eye looks along its -Z, +Y up
    float verticalFov = 1.0f;           // radians
    float aspect = 16.0f / 9.0f;        // width / height
    float near_m = 0.05f, far_m = 100.0f;
    // Centre of the image plane at distance 1, for frusta off axis (headsets); right and up positive.
    glm::vec2 shift{0};

    int heightPixels = 0; // of the picture: what is smaller than these is not drawn; 0: all there is

    glm::vec2 halfExtent() const {
        const float y = std::tan(verticalFov / 2);
        return {y * aspect, y};
    }
    glm::mat4 clipFromWorld() const {
        const glm::vec2 half = halfExtent() * near_m, centre = shift * near_m;
        const glm::mat4 clipFromEye = glm::frustum(centre.x - half.x, centre.x + half.x, centre.y - half.y,
                                                   centre.y + half.y, near_m, far_m);
        return clipFromEye * glm::mat4_cast(glm::conjugate(worldFromEye)) *
               glm::translate(glm::mat4(1), -eyeWorld);
    }
};

// How radiance becomes display values. Numbers as in shaders/render/Output.glsl.
enum class ToneCurve { InverseOfVideo = 0, Aces = 1, Linear = 2 };

// How glossy light is looked up.
enum class Glossy {
    Prefiltered, // GGX, as glTF defines it
    PhongRings,  // the thesis' 36 samples of a Phong lobe
};

struct Exposure {
    ToneCurve curve = ToneCurve::InverseOfVideo;
    float exposure_ev = 0; // objects and background alike

    float scale() const { return std::exp2(exposure_ev); }
};

} // namespace shoal::render
