// Options of every command but `shoal play`, each struct with its table of settings.
#pragma once

#include "engine/panorama/Panorama.h"
#include "game/settings/SharedOptions.h"

#include <optional>
#include <string>
#include <vector>

namespace shoal::app {

struct ViewOptions {
    std::string model;
    EnvironmentOptions environment;
    LookOptions look{.size = {768, 768}};
    light::DiffuseMethod diffuse = light::DiffuseMethod::Default;
    std::optional<glm::vec3> orbit;  // theta and phi in degrees, radius in metres; empty: fits the model
    std::optional<glm::vec3> target; // metres; empty: the model's middle
    float fov_deg = 45;              // vertical
    Background background = Background::Environment;
    std::string animation; // NAME@SECONDS
    std::string variant;   // of the model's materials; empty: as it is
    float at_s = 0;        // of the video
    std::string out;
    bool headless = false;

    SettingsTable settings() {
        SettingsTable table = {Setting("MODEL", &model, "A glTF 2.0 model: .glb or .gltf").mustBeGiven()};
        append(table, environment.settings());
        append(table, look.settings(true));
        append(
            table,
            {Setting("--diffuse", choice(diffuse),
                     "Diffuse light: default, exact; thesis: a map of 64x32 texels, each the sum over all"),
             Setting("--orbit", vectorSetting(orbit),
                     "Camera around the target: degrees around, degrees from straight up, metres away; "
                     "0,90 looks along -Z")
                 .takes("THETA,PHI,RADIUS"),
             Setting("--target", vectorSetting(target),
                     "What the camera looks at, metres; the model's middle if not given")
                 .takes("X,Y,Z"),
             Setting("--fov", &fov_deg, "Vertical field of view").in("degrees").between(1, 150),
             Setting("--background", choice(background), "env, or none: transparent"),
             Setting("--animation", &animation, "Poses the model at that second of an animation")
                 .takes("NAME@SECONDS"),
             Setting("--variant", &variant, "Shows the model with one of its material variants"),
             Setting("--at", &at_s, "Second of the video to stand in").between(0, 36000),
             Setting("--out", &out, "Writes a picture instead of opening a window").takes("FILE.png"),
             Setting("--headless", &headless, "Opens no window, which --out never does").with({"--out"})});
        return table;
    }
};

struct LightOptions {
    std::string file, out;
    LightFormat format = LightFormat::Pfm;
    light::DiffuseMethod method = light::DiffuseMethod::Default; // Thesis: its glossy maps too
    bool ldrAsIs = false;
    float at_s = 0;

    SettingsTable settings() {
        return {Setting("FILE", &file, "A lat-long HDR picture, photo or video").mustBeGiven(),
                Setting("-o,--out", &out, "Folder for diffuse, glossy_<roughness> and sh.json")
                    .takes("FOLDER")
                    .mustBeGiven(),
                Setting("--method", choice(method),
                        "default: exact lobes; thesis: diffuse light by brute force from 64x32 texels, "
                        "glossy light by 36 samples of a Phong lobe"),
                Setting("--format", choice(format), "Of the pictures: 32-bit pfm, exr, or Radiance hdr"),
                Setting("--ldr-as-is", &ldrAsIs,
                        "Take a photo's or video's values as linear light: no inverse tone mapping"),
                Setting("--at", &at_s, "Second of the video").between(0, 36000)};
    }
};

struct PanoramaOptions {
    std::string photo, out;
    std::optional<double> fov_deg; // horizontal, of the photo

    SettingsTable settings() {
        return {Setting("PHOTO", &photo, "JPEG, PNG, WebP, BMP, PNM; .hdr, .exr, .pfm").mustBeGiven(),
                Setting("-o,--out", &out,
                        "The environment, lat-long, up to 4096x2048 pixels: .png or .jpg; .hdr, .exr or "
                        ".pfm for a high dynamic range photo")
                    .takes("FILE")
                    .mustBeGiven(),
                Setting("--fov", &fov_deg,
                        "Horizontal field of view of the photo, degrees; 65 along its longer side if not "
                        "given. Given, a photo that is twice as wide as high is taken for an ordinary one "
                        "too")
                    .between(panorama::kMinFov_deg, panorama::kMaxFov_deg)};
    }
};

struct CheckOptions {
    std::vector<std::string> files;

    SettingsTable settings() { return {Setting("FILE", &files, "Files to look at").mustBeGiven()}; }
};

struct DevicesOptions {
    HandOptions hands;
    bool test = false;

    SettingsTable settings() {
        SettingsTable table = hands.leapSettings();
        table.push_back(Setting("--test", &test, "Pulse each haptic device and play a sound"));
        return table;
    }
};

} // namespace shoal::app
