// What the command line asks for, one struct per command. Declared, explained and bounded in Cli.cpp, and
// only there.
#pragma once

#include "engine/audio/Audio.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <vector>

namespace shoal::app {

struct SurroundOptions {
    std::string video, photo, env; // at most one; empty: the dive's own video
    std::string layout = "auto";   // auto, mono, top-bottom, left-right
    float envYaw_deg = 0; // column u of the surround appears (u - 0.5) * 360 + this to the right of -Z
};

// The dive's own video is what is shown.
inline bool isOwnVideo(const SurroundOptions& options) {
    return options.video.empty() && options.photo.empty() && options.env.empty();
}

struct LookOptions {
    float exposure_ev = 0;
    std::string tone = "auto";  // auto, aces, linear
    std::string glossy = "ggx"; // ggx, phong36
    int samples = 0;            // for anti-aliasing; 0: 4, or 1 on a software renderer
    glm::ivec2 size{1280, 720};
    std::string occlusion = "on"; // off, on
};

struct HandOptions {
    std::string source; // auto, mouse, leap, webcam[:FILE or number], openxr, script:FILE, replay:FILE;
                        // empty: auto in a window, else mouse
    std::string leapHost = "127.0.0.1";
    uint16_t leapPort = 6437;
    std::string leapMount = "desk"; // desk, head
};

struct PlayOptions {
    std::string dive = "reef";
    uint64_t seed = 1;
    SurroundOptions surround;
    LookOptions look;
    HandOptions hands;
    std::string skin = "light"; // one of kSkins
    std::string record;
    std::string stereo = "none"; // none, sbs
    bool xr = false;             // in an OpenXR headset
    float fov_deg = 65;          // vertical
    float eyeDistance_mm = 64;
    bool fullscreen = false;
    bool vsync = true;
    std::string quality = "auto"; // auto, fixed
    float load_ms = 0;            // artificial, for each frame
    bool headless = false;
    float fps = 60; // headless: frames a second of dive time
    std::string screenshot;
    std::optional<float> at_s;
    std::string stats;
    bool timedemo = false;
    bool backdropOnly = false;
    std::string compose = "auto"; // auto, plain, resolution, texels, camera
    bool mute = false;
    bool headphones = false;
    float volume = 0.8f;
    float videoSound = 0.8f; // of the video's own sound, 0 to 1
    float doppler = audio::kDopplerAsInAir;
    float hapticStrength = 1;
    bool captions = true;
    std::string water = "auto"; // auto, on, off
    bool snow = true;           // specks that drift in the water
    std::string shadows = "on"; // on, off: what swims darkens the ground that the dive's video shows
};

struct ViewOptions {
    std::string model;
    SurroundOptions surround;
    LookOptions look{0, "auto", "ggx", 0, {768, 768}};
    glm::vec3 orbit{0, 90, 0}; // theta and phi in degrees, radius in metres; radius 0: fits the model
    bool orbitGiven = false;
    std::optional<glm::vec3> target; // metres; empty: the model's middle
    float fov_deg = 45;              // vertical
    std::string background = "env";  // env, none
    std::string animation;           // NAME@SECONDS
    std::string variant;             // of the model's materials; empty: as it is
    float at_s = 0;                  // of the video
    std::string out;
};

struct LightOptions {
    std::string file, out;
    std::string format = "pfm"; // pfm, exr, hdr
    std::string method = "thesis";
    bool ldrAsIs = false;
    float at_s = 0;
};

struct PanoramaOptions {
    std::string photo, out;
    std::optional<double> fov_deg; // horizontal, of the photo
};

struct CheckOptions {
    std::vector<std::string> files;
};

struct DevicesOptions {
    HandOptions hands;
    bool test = false;
};

} // namespace shoal::app
