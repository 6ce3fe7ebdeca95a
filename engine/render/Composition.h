// Choices of how a picture is composed, as settings name them.
#pragma once

namespace shoal::render {

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

// A pass that can be left out, to find out which one draws what.
enum class SkippedPass { None, Background, Objects, Particles, Shadows, Overlay };

// What objects are drawn as, to find out where their light comes from.
enum class ShownQuantity {
    Light,
    Normals,   // world; -1 to 1 as black to white
    Roughness, // of the surface, with its map
    Occlusion, // share of the diffuse light that is left
    Diffuse,   // light, without the base colour
    Depth      // 1 / (1 + metres from the eye)
};

} // namespace shoal::render
