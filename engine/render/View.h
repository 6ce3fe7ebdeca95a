// One eye: where it stands, where it looks, what it covers; and the choices of how its picture is drawn.
#pragma once

#include "engine/math/Sphere.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

#include <cmath>
#include <cstdint>

namespace shoal::render {

struct View {
    glm::vec3 eyeWorld{0};
    glm::quat worldFromEye{1, 0, 0, 0}; // the eye looks along its -Z, +Y up
    float verticalFov = 1.0f;           // radians
    float aspect = 16.0f / 9.0f;        // width / height
    // Nearer than an arm passes the eye that is in the picture at a field of view of 130 degrees.
    float near_m = 0.02f, far_m = 100.0f;
    // Centre of the image plane at distance 1, for frusta off axis (headsets); right and up positive.
    glm::vec2 shift{0};

    int heightPixels = 0; // of the picture: what is smaller than these is not drawn; 0: all there is

    bool operator==(const View&) const = default;
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

// Whether the sphere reaches into the view's pyramid. Errs towards yes at the pyramid's edges.
bool sees(const View& view, const Sphere& sphere);

// How a video's coded values are radiance.
enum class FrameCoding {
    Srgb,
    Thesis, // light::radianceFromDisplay()
};

// How radiance becomes display values: shaders/render/Output.glsl.
enum class ToneCurve {
    InverseOfVideo, // the inverse of the frames' coding
    Aces,
    Linear // clips, and codes as sRGB
};

// How glossy light is looked up.
enum class Glossy {
    Prefiltered, // GGX, as glTF defines it
    PhongRings,  // the thesis' 36 samples of a Phong lobe
};

struct Exposure {
    ToneCurve curve = ToneCurve::InverseOfVideo;
    float exposure_ev = 0;                    // objects and background alike
    FrameCoding frames = FrameCoding::Thesis; // as the light was made: light::FrameRadiance

    float scale() const { return std::exp2(exposure_ev); }
    bool isLinear() const { // as the shaders' TONE_LINEAR is
        return curve == ToneCurve::Linear ||
               (curve == ToneCurve::InverseOfVideo && frames == FrameCoding::Srgb);
    }
    // Frames are shown as they are coded: the curve undoes their decoding.
    bool keepsFrames() const {
        return (curve == ToneCurve::InverseOfVideo || (isLinear() && frames == FrameCoding::Srgb)) &&
               exposure_ev == 0;
    }
};

// How virtual objects are combined with the filmed background.
enum class Composition {
    BackgroundOnly,    // no objects
    Plain,             // objects at the resolution of the picture
    MatchedResolution, // objects at the resolution of the video, where that is coarser, and enlarged as it is
    VideoTexels,       // objects in the texels of the video's frame, displayed with it
    CameraResponse     // as VideoTexels, with the blur, glare, noise, levels and chroma of the video's camera
};

// Which implementation samples the background and paints the frame's texels. OpenGL draws the objects in
// either case.
enum class Backend {
    Auto, // Software where the OpenGL driver renders on the processor
    OpenGL,
    Software
};

// What is seen where no object is.
enum class Surroundings {
    Film,
    Room // what a headset's cameras see of the player's room: the picture is clear there, alpha 0
};

// A pass that can be left out, to find out which one draws what, and what it costs. Depth: what of the film
// is nearer than an object does not hide it, nor are there shadows and bounce light; the same animals swim
// where they would. Bounce: what rock near the animals adds to their light, or takes.
enum class SkippedPass { None, Background, Objects, Particles, Shadows, Depth, Bounce, Overlay };

// What objects are drawn as, to find out where their light comes from.
enum class ShownQuantity {
    Light,
    Normals,   // world; -1 to 1 as black to white
    Roughness, // of the surface, with its map
    Occlusion, // share of the diffuse light that is left
    Diffuse,   // light, without the base colour
    Depth      // 1 / (1 + metres from the eye)
};

// A frame as it is drawn: display-coded rows of it or of one eye's part of it, from the top: blue, green, red
// and a byte that is 255. Drivers keep such texels as they come; three bytes a pixel they would turn into
// these first.
struct DisplayFrame {
    const uint8_t* pixels = nullptr;
    int width = 0, height = 0;
    int rowPixels = 0; // from one row to the next, in pixels

    bool operator==(const DisplayFrame&) const = default;
};

} // namespace shoal::render
