// The commands of the program, each tool with its options and their table of settings.
#pragma once

#include "engine/occlusion/Ollfb.h"
#include "engine/panorama/Panorama.h"
#include "game/settings/PlayOptions.h"

#include <csignal>
#include <optional>
#include <string>
#include <vector>

namespace shoal::app {

struct ViewOptions {
    std::string model;
    EnvironmentOptions environment;
    LookOptions look{.size = {768, 768}};
    light::DiffuseMethod diffuse = light::DiffuseMethod::Default;
    DiffuseSize diffuseSize = DiffuseSize::W64;
    occlusion::Ollfb::Options layers;
    std::optional<glm::vec3> orbit;  // theta and phi in degrees, radius in metres; empty: fits the model
    std::optional<glm::vec3> target; // metres; empty: the model's middle
    float fov_deg = 45;              // vertical
    int samples = 4;                 // for anti-aliasing
    Background background = Background::Environment;
    std::string animation; // NAME or NAME@SECONDS
    std::string variant;   // material variant of the model; empty: the default
    float at_s = 0;        // time of the video
    std::string out;
    bool headless = false;

    void addTo(SettingsTable& table) {
        table.add("MODEL", &model, "A glTF 2.0 model: .glb or .gltf", {.required = true});
        environment.addTo(table);
        look.addTo(table, true);
        table.category = Category::General;
        table.add("--diffuse", choice(diffuse),
                  "Diffuse light: default, exact; thesis: a map in which each texel is the sum over all");
        table.add("--diffuse-size", choice(diffuseSize),
                  "Width of that map, texels, twice its height; 1024 takes a minute a frame",
                  {.needs = {"--diffuse"}});
        table.add("--ollfb-views", &layers.views,
                  "Views in layered fragment buffers; of ollfb-thesis 6 n^2: 54, 96, 150 and so on",
                  {.range = {6, 1536}, .needs = {"--occlusion"}});
        table.add("--ollfb-size", &layers.resolution, "Width of each of these views, pixels",
                  {.range = {8, 256}, .needs = {"--occlusion"}});
        table.add("--orbit", vectorSetting(orbit),
                  "Camera around the target: degrees around, degrees from straight up, metres away; 0,90 "
                  "looks along -Z",
                  {.placeholder = "THETA,PHI,RADIUS"});
        table.add("--target", vectorSetting(target),
                  "Point that the camera looks at, metres; the model's middle if not given",
                  {.placeholder = "X,Y,Z"});
        table.add("--fov", &fov_deg, "Vertical field of view, degrees", {.range = {1, 150}});
        table.add("--samples", &samples, "Anti-aliasing samples a pixel", {.range = {1, 16}});
        table.add("--background", choice(background), "env, or none: transparent");
        table.add("--animation", &animation, "Poses the model at that second of an animation",
                  {.placeholder = "NAME@SECONDS"});
        table.add("--variant", &variant, "Shows the model with one of its material variants");
        table.add("--at", &at_s, "Second of the video to stand in", {.range = {0, 36000}});
        table.add("--out", &out, "Writes a picture instead of opening a window", {.placeholder = "FILE.png"});
        table.add("--headless", &headless, "Opens no window, which --out never does", {.needs = {"--out"}});
    }
};

struct LightOptions {
    std::string file, out;
    LightFormat format = LightFormat::Pfm;
    light::DiffuseMethod method = light::DiffuseMethod::Default; // Thesis: the thesis' glossy maps too
    DiffuseSize diffuseSize = DiffuseSize::W64;
    std::vector<float> roughness; // ascending; empty: those of light::glossyPlans()
    light::FrameRadiance frames = light::FrameRadiance::Auto;
    std::string layer;
    float at_s = 0;

    void addTo(SettingsTable& table) {
        table.add("FILE", &file, "A lat-long HDR picture, photo or video", {.required = true});
        table.add("-o,--out", &out, "Folder for diffuse, glossy_<roughness> and sh.json",
                  {.placeholder = "FOLDER", .required = true});
        table.add("--method", choice(method),
                  "default: exact lobes; thesis: diffuse light by brute force from as many texels as it has, "
                  "glossy light by 36 samples of a Phong lobe");
        table.add("--diffuse-size", choice(diffuseSize),
                  "Width of the diffuse map, texels, twice its height; 1024 by the thesis takes a minute");
        table.add("--roughness", listSetting(roughness, 0.01f, 1),
                  "Perceptual roughness (glTF's) of each glossy map; 16 for each factor of ten if not given",
                  {.placeholder = "R,R..."});
        table.add("--format", choice(format), "Format of the pictures: 32-bit pfm, exr, or Radiance hdr");
        table.add(
            "--light", choice(frames),
            "Meaning of a photo's or video's values. auto: decoded sRGB, and what the camera clipped "
            "by the light that the ground sends back, but thesis with --method thesis; linear: decoded "
            "sRGB (both: PQ and HLG as measured); thesis: its inverse tone mapping; akyuz, landis: operators "
            "that it names, which make white 10");
        table.add("--layer", &layer, "Layer of an OpenEXR picture, if it has several",
                  {.placeholder = "NAME"});
        table.add("--at", &at_s, "Second of the video", {.range = {0, 36000}});
    }
};

struct PanoramaOptions {
    std::string photo, out, layer;
    std::optional<float> fov_deg; // horizontal, of the photo
    bool full = false;

    void addTo(SettingsTable& table) {
        table.add("PHOTO", &photo, "JPEG, PNG, WebP, AVIF, TIFF, BMP, PNM; .hdr, .exr, .pfm",
                  {.required = true});
        table.add("-o,--out", &out,
                  "The environment, lat-long, up to 4096x2048 pixels: .png or .jpg; .hdr, .exr or .pfm for a "
                  "high dynamic range photo",
                  {.placeholder = "FILE", .required = true});
        table.add("--fov", &fov_deg,
                  "Horizontal field of view of the photo, degrees; 65 along its longer side if not given. "
                  "Given, a photo that is twice as wide as high is taken for an ordinary one too",
                  {.range = {panorama::kMinFov_deg, panorama::kMaxFov_deg}});
        table.add("--full", &full,
                  "Carves the photo up and down to 180 degrees too, as the thesis does, in place of 90 with "
                  "sky and ground extrapolated");
        table.add("--layer", &layer, "Layer of an OpenEXR photo, if it has several", {.placeholder = "NAME"});
    }
};

struct CheckOptions {
    std::vector<std::string> files;
    std::string layer;

    void addTo(SettingsTable& table) {
        table.add("FILE", &files, "Files to look at", {.required = true});
        table.add("--layer", &layer, "Layer of OpenEXR pictures, if they have several",
                  {.placeholder = "NAME"});
    }
};

struct DevicesOptions {
    HandOptions hands;
    bool test = false;

    void addTo(SettingsTable& table) {
        hands.addLeapTo(table);
        table.add("--test", &test, "Pulse each haptic device and play a sound");
    }
};

// The signal that asked play() to stop and to write its files first; 0: none. The program's exit status is
// then 128 more, as shells have it. The signal handler may touch only this.
inline volatile std::sig_atomic_t stopSignal = 0;

// Plays a dive until the player leaves, it ends by itself, or SIGINT, SIGTERM or SIGHUP comes.
Status play(const PlayOptions& options);
Status view(const ViewOptions& options);
Status light(const LightOptions& options);
Status panorama(const PanoramaOptions& options);
// Prints a line for each file: "usable: FILE: KIND" to standard output, or "not usable: FILE: REASON" to
// standard error. Returns the exit status, 1 if a file is not usable.
int check(const CheckOptions& options);
int devices(const DevicesOptions& options);

} // namespace shoal::app
