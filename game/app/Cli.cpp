#include "game/app/Cli.h"

#include "engine/core/Log.h"
#include "engine/panorama/Panorama.h"
#include "game/app/Commands.h"
#include "game/app/Settings.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <sstream>

namespace shoal::app {

namespace {

// "1280x720" within sane bounds.
void addSize(CLI::App& app, glm::ivec2& size) {
    app.add_option_function<std::string>(
           "--size",
           [&size](const std::string& text) {
               int width = 0, height = 0, end = 0;
               if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &end) != 2 ||
                   static_cast<size_t>(end) != text.size() || width < 16 || height < 16 || width > 8192 ||
                   height > 8192)
                   throw CLI::ValidationError("--size", "wants WIDTHxHEIGHT in pixels, 16x16 to 8192x8192");
               size = {width, height};
           },
           "Picture size in pixels")
        ->type_name("WxH");
}

glm::vec3 threeNumbers(const std::string& option, const std::string& text) {
    glm::vec3 v{0};
    int end = 0;
    if (std::sscanf(text.c_str(), "%f,%f,%f%n", &v.x, &v.y, &v.z, &end) != 3 ||
        static_cast<size_t>(end) != text.size())
        throw CLI::ValidationError(option, "wants three numbers with commas between");
    return v;
}

void addSurround(CLI::App& app, SurroundOptions& options) {
    auto* group = app.add_option_group("Surround", "What stands around you");
    auto* video =
        group
            ->add_option(
                "--video", options.video,
                "A 360-degree video, lat-long: a file; or live: camera:NUMBER, a named pipe, or a URL "
                "(rtsp, http, https, tcp, udp)")
            ->type_name("FILE");
    auto* photo = group
                      ->add_option("--photo", options.photo,
                                   "A 360-degree photo, lat-long; an ordinary one is grown to one")
                      ->type_name("FILE");
    auto* env =
        group->add_option("--env", options.env, "A high dynamic range lat-long picture: .hdr, .exr, .pfm")
            ->type_name("FILE");
    video->excludes(photo)->excludes(env);
    photo->excludes(env);
    group
        ->add_option("--layout", options.layout,
                     "Where a stereo picture keeps its eyes; auto reads the file's metadata")
        ->check(CLI::IsMember({"auto", "mono", "top-bottom", "left-right"}))
        ->capture_default_str();
    group->add_option("--env-yaw", options.envYaw_deg, "Turns the surround to the right, degrees")
        ->check(CLI::Range(-360.0f, 360.0f))
        ->capture_default_str();
}

void addLook(CLI::App& app, LookOptions& options) {
    addSize(app, options.size);
    app.add_option("--exposure", options.exposure_ev, "Brightens objects and backdrop alike, stops (EV)")
        ->check(CLI::Range(-10.0f, 10.0f))
        ->capture_default_str();
    app.add_option("--tone", options.tone,
                   "Display curve: auto undoes the video's own, or aces for HDR surrounds; aces; linear")
        ->check(CLI::IsMember({"auto", "aces", "linear"}))
        ->capture_default_str();
    app.add_option("--glossy", options.glossy,
                   "Glossy light: ggx as glTF defines it, or the thesis' 36 Phong samples")
        ->check(CLI::IsMember({"ggx", "phong36"}))
        ->capture_default_str();
    app.add_option(
           "--occlusion", options.occlusion,
           "on: bodies take light from each other, and folds from themselves; with any OpenGL from 3.3")
        ->check(CLI::IsMember({"off", "on"}))
        ->capture_default_str();
    app.add_option("--samples", options.samples,
                   "Anti-aliasing samples a pixel, 1 to 16; 0: 4, or 1 without a graphics card")
        ->check(CLI::Range(0, 16))
        ->capture_default_str();
}

void addLeap(CLI::App& app, HandOptions& options) {
    app.add_option_function<std::string>(
           "--leap",
           [&options](const std::string& text) {
               const size_t colon = text.rfind(':');
               int port = 0, end = 0;
               if (colon == std::string::npos || colon == 0 ||
                   std::sscanf(text.c_str() + colon, ":%d%n", &port, &end) != 1 ||
                   colon + static_cast<size_t>(end) != text.size() || port < 1 || port > 65535)
                   throw CLI::ValidationError("--leap", "wants HOST:PORT");
               options.leapHost = text.substr(0, colon);
               options.leapPort = static_cast<uint16_t>(port);
           },
           "Where the Leap / Ultraleap tracking service listens; 127.0.0.1:6437 if not given")
        ->type_name("HOST:PORT");
}

void addHands(CLI::App& app, HandOptions& options) {
    app.add_option(
           "--hands", options.source,
           "mouse; leap (Leap Motion, Ultraleap); auto: the best of these that is there, which is the "
           "default with a window; webcam, webcam:NUMBER, or webcam:FILE (a clip of hands); openxr (a "
           "headset's, which --xr means); script:FILE (a "
           "playthrough); replay:FILE. Where a device sees no hands, the mouse has them")
        ->type_name("SOURCE");
    addLeap(app, options);
    app.add_option("--leap-mount", options.leapMount,
                   "desk: the device lies on the desk and looks up; head: it is on a headset and looks ahead")
        ->check(CLI::IsMember({"desk", "head"}))
        ->capture_default_str();
}

void addPlay(CLI::App& app, PlayOptions& options) {
    app.add_option("--dive", options.dive, "Name of a dive in content/dives")->capture_default_str();
    app.add_option("--seed", options.seed, "Seed of everything random in the dive")->capture_default_str();
    addSurround(app, options.surround);
    addLook(app, options.look);
    addHands(app, options.hands);
    app.add_option("--skin", options.skin, "How your hands look")
        ->check(CLI::IsMember(std::vector<std::string>(kSkins.begin(), kSkins.end())))
        ->capture_default_str();
    app.add_option("--record", options.record, "Writes a replay: seed, settings and every tick's input")
        ->type_name("FILE");
    auto* stereo = app.add_option("--stereo", options.stereo, "none, or sbs: left and right eye side by side")
                       ->check(CLI::IsMember({"none", "sbs"}))
                       ->capture_default_str();
    auto* xr =
        app.add_flag("--xr", options.xr,
                     "In a headset, by the OpenXR runtime that is active; the window shows its left eye");
    xr->excludes(stereo);
    app.add_option("--fov", options.fov_deg, "Vertical field of view, degrees")
        ->check(CLI::Range(20.0f, 130.0f))
        ->capture_default_str();
    app.add_option("--eye-distance", options.eyeDistance_mm, "Between the eyes in stereo, millimetres")
        ->check(CLI::Range(0.0f, 100.0f))
        ->capture_default_str();
    app.add_flag("--fullscreen", options.fullscreen, "Fill the screen (F11 in the game)");
    app.add_flag("!--no-vsync", options.vsync, "Do not wait for the display");
    app.add_option("--quality", options.quality,
                   "auto draws fewer pixels, then makes light less often, while frames take longer than the "
                   "display allows; fixed never does (nor does --headless)")
        ->check(CLI::IsMember({"auto", "fixed"}))
        ->capture_default_str();
    app.add_option("--load", options.load_ms,
                   "Keeps the processor busy for that many milliseconds a frame, to see what --quality auto "
                   "does about it; also with --headless --timedemo, for 60 frames a second")
        ->check(CLI::Range(0.0f, 1000.0f));
    app.add_flag("--headless", options.headless,
                 "No window, no sound device, no display server; the same pictures")
        ->excludes(xr);
    app.add_option("--fps", options.fps, "Headless: pictures drawn for each second of the dive")
        ->check(CLI::Range(1.0f, 1000.0f))
        ->capture_default_str();
    app.add_option("--screenshot", options.screenshot, "Writes a picture at --at, or at the end")
        ->type_name("FILE.png");
    app.add_option("--at", options.at_s, "Headless: ends after that many seconds of the dive")
        ->check(CLI::Range(0.0f, 3600.0f));
    app.add_option("--stats", options.stats, "Writes frame times (milliseconds), counts and the state hash")
        ->type_name("FILE.json");
    app.add_flag("--timedemo", options.timedemo,
                 "Draws as fast as it can: once to warm up, once measured; the video keeps its own rate");
    app.add_option(
           "--compose", options.compose,
           "How objects come into the video: plain, as finely as the picture is drawn; resolution, as "
           "finely as the video is, and scaled up with it; texels, into the video's own frame; camera, as "
           "its camera would have filmed them (blur, glare, noise, levels, colours; all estimated); auto: "
           "camera")
        ->check(CLI::IsMember({"auto", "plain", "resolution", "texels", "camera"}))
        ->capture_default_str();
    app.add_flag("--backdrop-only", options.backdropOnly,
                 "Draws the surround alone, to compare frame times with");
    app.add_flag("--mute", options.mute, "No sound");
    app.add_flag("--headphones", options.headphones, "Sound for headphones (HRTF)");
    app.add_option("--volume", options.volume, "Sound volume, 0 to 1")
        ->check(CLI::Range(0.0f, 1.0f))
        ->capture_default_str();
    app.add_option("--video-sound", options.videoSound, "Volume of the video's own sound, 0 to 1")
        ->check(CLI::Range(0.0f, 1.0f))
        ->capture_default_str();
    app.add_option(
           "--doppler", options.doppler,
           "How much what swims past changes its pitch, in times of water's own effect: 0 not at all, 1 "
           "as in water, where it is hardly heard; 4.4 as ears know it from air")
        ->check(CLI::Range(0.0f, 20.0f))
        ->capture_default_str();
    app.add_option("--haptics", options.hapticStrength, "Strength of haptics, 0 (off) to 1")
        ->check(CLI::Range(0.0f, 1.0f))
        ->capture_default_str();
    app.add_flag("!--no-captions", options.captions, "Do not name sounds on the screen");
    app.add_option(
           "--water", options.water,
           "Dims what is drawn with distance as the surround's water does: auto as the dive says, or, of "
           "another video or photo, where the picture has lost its red; on; off")
        ->check(CLI::IsMember({"auto", "on", "off"}))
        ->capture_default_str();
    app.add_flag("!--no-snow", options.snow, "No specks that drift in the water");
    app.add_option("--shadows", options.shadows,
                   "Of what swims and of your hands, on the ground that the dive's own video shows")
        ->check(CLI::IsMember({"on", "off"}))
        ->capture_default_str();
}

void addView(CLI::App& app, ViewOptions& options) {
    app.add_option("MODEL", options.model, "A glTF 2.0 model: .glb or .gltf")->required();
    addSurround(app, options.surround);
    addLook(app, options.look);
    app.add_option_function<std::string>(
           "--orbit",
           [&options](const std::string& text) {
               options.orbit = threeNumbers("--orbit", text);
               options.orbitGiven = true;
           },
           "Camera around the target: degrees around, degrees from straight up, metres away; 0,90 looks "
           "along -Z")
        ->type_name("THETA,PHI,RADIUS");
    app.add_option_function<std::string>(
           "--target",
           [&options](const std::string& text) { options.target = threeNumbers("--target", text); },
           "What the camera looks at, metres; the model's middle if not given")
        ->type_name("X,Y,Z");
    app.add_option("--fov", options.fov_deg, "Vertical field of view, degrees")
        ->check(CLI::Range(1.0f, 150.0f))
        ->capture_default_str();
    app.add_option("--background", options.background, "env, or none: transparent")
        ->check(CLI::IsMember({"env", "none"}))
        ->capture_default_str();
    app.add_option("--animation", options.animation, "Poses the model at that second of an animation")
        ->type_name("NAME@SECONDS");
    app.add_option("--variant", options.variant, "Dresses the model in one of its material variants");
    app.add_option("--at", options.at_s, "Second of the video to stand in")
        ->check(CLI::Range(0.0f, 36000.0f));
    app.add_option("--out", options.out, "Writes a picture instead of opening a window")
        ->type_name("FILE.png");
}

void addLight(CLI::App& app, LightOptions& options) {
    app.add_option("FILE", options.file, "A lat-long HDR picture, photo or video")->required();
    app.add_option("-o,--out", options.out, "Folder for diffuse, glossy_<roughness> and sh.json")
        ->required()
        ->type_name("FOLDER");
    app.add_option("--method", options.method, "Which light to make")
        ->check(CLI::IsMember({"thesis"}))
        ->capture_default_str();
    app.add_option("--format", options.format, "Of the pictures: 32-bit pfm, exr, or Radiance hdr")
        ->check(CLI::IsMember({"pfm", "exr", "hdr"}))
        ->capture_default_str();
    app.add_flag("--ldr-as-is", options.ldrAsIs,
                 "Take a photo's or video's values as linear light: no inverse tone mapping");
    app.add_option("--at", options.at_s, "Second of the video")->check(CLI::Range(0.0f, 36000.0f));
}

void addPanorama(CLI::App& app, PanoramaOptions& options) {
    app.add_option("PHOTO", options.photo, "JPEG, PNG, WebP, BMP, PNM; .hdr, .exr, .pfm")->required();
    app.add_option("-o,--out", options.out,
                   "The surround, lat-long, up to 4096x2048 pixels: .png or .jpg; .hdr, .exr or .pfm for a "
                   "high dynamic range photo")
        ->required()
        ->type_name("FILE");
    app.add_option("--fov", options.fov_deg,
                   "Horizontal field of view of the photo, degrees; 65 along its longer side if not given. "
                   "Given, a photo that is twice as wide as high is taken for an ordinary one too")
        ->check(CLI::Range(shoal::panorama::kLeastFov_deg, shoal::panorama::kLargestFov_deg));
}

} // namespace

int run(int argc, char** argv) {
    CLI::App app{"Shoal: catch fish inside a 360-degree video that lights them.\n"
                 "Without a command it plays: `shoal` is `shoal play`.",
                 "shoal"};
    app.set_version_flag("--version", SHOAL_VERSION);
    app.require_subcommand(0, 1);
    bool verbose = false;
    app.add_flag("--verbose", verbose, "Say more on standard error");

    // Before parsing, so that the command line has the last word.
    log::setUp(false);
    const Settings settings = loadSettings();
    PlayOptions playOptions;
    playOptions.volume = settings.volume;
    playOptions.hapticStrength = settings.hapticStrength;
    playOptions.headphones = settings.headphones;
    playOptions.captions = settings.captions;
    playOptions.snow = settings.snow;
    playOptions.skin = settings.skin;
    ViewOptions viewOptions;
    LightOptions lightOptions;
    PanoramaOptions panoramaOptions;
    CheckOptions checkOptions;
    DevicesOptions devicesOptions;
    auto* playCommand = app.add_subcommand("play", "Play a dive (the default)")->fallthrough();
    addPlay(*playCommand, playOptions);
    auto* viewCommand = app.add_subcommand("view", "Light any glTF model in any surroundings")->fallthrough();
    addView(*viewCommand, viewOptions);
    auto* lightCommand =
        app.add_subcommand("light", "Write the light of a surround, for other engines")->fallthrough();
    addLight(*lightCommand, lightOptions);
    auto* panoramaCommand =
        app.add_subcommand("panorama", "Grow an ordinary photo to a full surround")->fallthrough();
    addPanorama(*panoramaCommand, panoramaOptions);
    auto* checkCommand =
        app.add_subcommand("check", "Is this video, photo, model, dive, playthrough or replay usable?");
    checkCommand->add_option("FILE", checkOptions.files, "Files to look at")->required();
    auto* devicesCommand =
        app.add_subcommand("devices", "List hands, cameras, haptic devices and sound outputs");
    addLeap(*devicesCommand, devicesOptions.hands);
    devicesCommand->add_flag("--test", devicesOptions.test, "Pulse each haptic device and play a sound");

    // `shoal --size 640x360` means `shoal play --size 640x360`.
    std::vector<std::string> words(argv + 1, argv + argc);
    const bool named = !words.empty() && (words[0] == "play" || words[0] == "view" || words[0] == "light" ||
                                          words[0] == "panorama" || words[0] == "check" ||
                                          words[0] == "devices" || words[0] == "--help" || words[0] == "-h" ||
                                          words[0] == "--version" || words[0] == "--verbose");
    if (!named) words.insert(words.begin(), "play");
    std::reverse(words.begin(), words.end()); // as CLI11 wants them
    try {
        app.parse(words);
    } catch (const CLI::ParseError& error) {
        std::ostringstream out, err;
        const int status = app.exit(error, out, err);
        std::fputs(out.str().c_str(), stdout);
        if (status == 0) return 0;
        std::fprintf(stderr, "shoal: %s (shoal --help lists what there is)\n", error.what());
        return 2;
    }
    if (verbose) log::setUp(true);
    if (*viewCommand) return view(viewOptions);
    if (*lightCommand) return light(lightOptions);
    if (*panoramaCommand) return panorama(panoramaOptions);
    if (*checkCommand) return check(checkOptions);
    if (*devicesCommand) return devices(devicesOptions);
    return play(playOptions);
}

} // namespace shoal::app
