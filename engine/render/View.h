// An eye's position, direction and field of view; and the choices of how its picture is drawn.
#pragma once

#include "engine/core/Image.h"
#include "engine/math/Sphere.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

#include <cmath>
#include <cstdint>

namespace shoal::render {

class PlanesPass;

struct View {
    glm::vec3 eyeWorld{0};
    glm::quat worldFromEye{1, 0, 0, 0}; // the eye looks along its -Z, +Y up
    float verticalFov = 1.0f;           // radians
    float aspect = 16.0f / 9.0f;        // width / height
    // near_m: arms at a field of view of 130 degrees stay farther from the eye than this.
    float near_m = 0.02f, far_m = 100.0f;
    // Centre of the image plane at distance 1, for frusta off axis (headsets); right and up positive.
    glm::vec2 shift{0};

    int heightPixels = 0; // height of the picture: details too fine for it are left out; 0: none are left out

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

// Returns whether the sphere reaches into the view's pyramid; may return true just outside of its edges.
inline bool sees(const View& view, const Sphere& sphere) {
    const glm::vec3 inEye = glm::conjugate(view.worldFromEye) * (sphere.centre - view.eyeWorld);
    if (-inEye.z < view.near_m - sphere.radius || -inEye.z > view.far_m + sphere.radius) return false;
    const glm::vec2 half = view.halfExtent();
    // Returns whether it is outside of the plane across = slope * ahead.
    const auto beyond = [&](float across, float slope) {
        return (across + slope * inEye.z) / std::sqrt(1 + slope * slope) > sphere.radius;
    };
    return !(beyond(inEye.x, half.x + view.shift.x) || beyond(-inEye.x, half.x - view.shift.x) ||
             beyond(inEye.y, half.y + view.shift.y) || beyond(-inEye.y, half.y - view.shift.y));
}

// Returns whether the pyramid of `wide` holds that of `view`; an eye up to 1 cm away counts as the same.
inline bool holds(const View& wide, const View& view) {
    constexpr float kSamePlace_m = 0.01f;
    if (glm::distance(wide.eyeWorld, view.eyeWorld) > kSamePlace_m) return false;
    const glm::quat wideFromEye = glm::conjugate(wide.worldFromEye) * view.worldFromEye;
    for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
        const glm::vec3 ray = wideFromEye * glm::vec3(corner * view.halfExtent() + view.shift, -1);
        if (ray.z >= 0) return false;
        const glm::vec2 off = glm::abs(glm::vec2(ray) / -ray.z - wide.shift) - wide.halfExtent();
        if (off.x > 0 || off.y > 0) return false;
    }
    return true;
}

// Decoding of a video's coded values to radiance.
enum class FrameCoding {
    Srgb,
    Thesis, // light::radianceFromDisplay()
};

// Conversion of radiance to display values: shaders/render/Output.glsl.
enum class ToneCurve {
    InverseOfVideo, // the inverse of the frames' coding
    Aces,
    Linear // clips, and codes as sRGB
};

// Method of looking up glossy light.
enum class Glossy {
    Prefiltered, // GGX, as glTF defines it
    PhongRings,  // the thesis' 36 samples of a Phong lobe
};

struct Exposure {
    ToneCurve curve = ToneCurve::InverseOfVideo;
    float exposure_ev = 0;                    // objects and background alike
    FrameCoding frames = FrameCoding::Thesis; // coding that the light was made with: light::FrameRadiance

    float scale() const { return std::exp2(exposure_ev); }
    bool isLinear() const { // as the shaders' TONE_LINEAR
        return curve == ToneCurve::Linear ||
               (curve == ToneCurve::InverseOfVideo && frames == FrameCoding::Srgb);
    }
    // Returns whether frames are shown as they are coded: the curve undoes their decoding.
    bool keepsFrames() const {
        return (curve == ToneCurve::InverseOfVideo || (isLinear() && frames == FrameCoding::Srgb)) &&
               exposure_ev == 0;
    }
};

// The defines of the first bits of variants of shaders that include render/Output.glsl, in this order.
#define SHOAL_TONE_DEFINES "TONE_ACES", "TONE_LINEAR", "FRAME_SRGB"
constexpr int kToneFeatures = 3;

inline unsigned toneFeatures(const Exposure& exposure) {
    return (exposure.curve == ToneCurve::Aces ? 1u << 0 : 0u) | (exposure.isLinear() ? 1u << 1 : 0u) |
           (exposure.frames == FrameCoding::Srgb ? 1u << 2 : 0u);
}

// Method of combining virtual objects with the filmed background.
enum class Composition {
    BackgroundOnly,    // no objects
    Plain,             // objects at the resolution of the picture
    MatchedResolution, // objects at the resolution of the video, where that is coarser, and enlarged as it is
    VideoTexels,       // objects in the texels of the video's frame, displayed with it
    CameraResponse     // as VideoTexels, with the blur, glare, noise, levels and chroma of the video's camera
};

// The implementation that samples the background and paints the frame's texels. OpenGL draws the objects in
// either case.
enum class Backend {
    Auto, // Software where the OpenGL driver renders on the processor
    OpenGL,
    Software
};

// The picture's content where there is no object.
enum class Surroundings {
    Film,
    Room // the player's room, from the headset's cameras: the picture is clear there, alpha 0
};

// A pass that can be left out, to find out what it draws and costs. Depth: nearer parts of the film do not
// hide objects, and there are no shadows and no bounce light; animals still swim around them. Bounce: rock
// near the animals neither adds to their light nor takes from it.
enum class SkippedPass { None, Background, Objects, Particles, Shadows, Depth, Bounce, Overlay };

// The quantity that objects show, to find out where their light comes from.
enum class ShownQuantity {
    Light,
    Normals,   // world; -1 to 1 as black to white
    Roughness, // of the surface, with its map
    Occlusion, // share of the diffuse light that is left
    Diffuse,   // light, without the base colour
    Depth      // 1 / (1 + metres from the eye)
};

// A video frame to be drawn, or one eye's part of it: coded display values from the top row; blue, green, red
// and a byte of 255. Drivers store texels in this format; they would have to convert pixels of three bytes.
struct DisplayFrame {
    const uint8_t* pixels = nullptr;
    int width = 0, height = 0;
    int rowPixels = 0; // stride of rows, in pixels
    // Unless null, this draws the pixels, of a part of its frame that begins at `first`.
    PlanesPass* planes = nullptr;
    glm::ivec2 first{0};

    bool operator==(const DisplayFrame&) const = default;
};

inline DisplayFrame frameOf(const Image<uint8_t, 4>& texels) {
    return {texels.pixels.data(), texels.width, texels.height, texels.width};
}

} // namespace shoal::render
