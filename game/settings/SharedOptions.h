// Enumerated settings, each with the one table of its names on the command line and in the settings file; and
// options that several commands share, each struct with its rows of the table of settings. Adding a setting:
// one member and one row, here or in the command's own struct.
#pragma once

#include "engine/environment/Player.h"
#include "engine/light/EnvironmentLight.h"
#include "engine/light/InverseToneMap.h"
#include "engine/render/View.h"
#include "game/rules/DiveFile.h"
#include "game/settings/Setting.h"
#include "input/hands/HandTracker.h"

#include <string>

namespace shoal::app {

enum class Tone { Auto, Aces, Linear };

// Method of ambient occlusion within a body and between bodies.
enum class Occlusion {
    Off,
    Ellipsoids,
    Ollfb,       // one body at rest: rays through its layered fragment buffers (engine/occlusion/Ollfb.h)
    OllfbThesis, // the same as the thesis does it
};

enum class StereoOutput { None, SideBySide };
enum class QualityControl { Auto, Fixed };
enum class WaterChoice { Auto, On, Off };
enum class ShadowChoice { On, Off };
enum class FilmChoice { Auto, Best, Small };
enum class DecodeChoice { Auto, Software };
enum class Skin { Light, Medium, Dark, Glove };
enum class HandSourceKind { Auto, Mouse, Leap, Webcam, OpenXr, Script, Replay };
enum class Closing { Hold, Toggle }; // how a button closes the hand
enum class Turning { Smooth, Snap };
enum class Posture { Auto, Seated, Standing }; // Auto: from the height of the eyes that the headset measures
enum class CaptionSize { Small, Medium, Large };
enum class LanguageChoice { Auto, English, German, French }; // Auto: the system's
enum class Start { Auto, Title, Dive };
enum class Background { Environment, None };
enum class LightFormat { Pfm, Exr, Hdr };

} // namespace shoal::app

namespace shoal {

template <> inline constexpr std::array kEnumNames<app::Tone> = {"auto", "aces", "linear"};
template <> inline constexpr std::array kEnumNames<render::Glossy> = {"ggx", "phong36"};
template <> inline constexpr std::array kEnumNames<light::DiffuseMethod> = {"default", "thesis"};
template <> inline constexpr std::array kEnumNames<light::FrameRadiance> = {"auto", "thesis", "linear"};
template <>
inline constexpr std::array kEnumNames<app::Occlusion> = {"off", "ellipsoids", "ollfb", "ollfb-thesis"};
template <>
inline constexpr std::array kEnumNames<render::Composition> = {"background", "plain", "resolution", "texels",
                                                               "camera"};
template <>
inline constexpr std::array kEnumNames<render::SkippedPass> = {
    "none", "background", "objects", "particles", "shadows", "depth", "bounce", "overlay"};
template <>
inline constexpr std::array kEnumNames<render::ShownQuantity> = {"light",     "normals", "roughness",
                                                                 "occlusion", "diffuse", "depth"};
template <> inline constexpr std::array kEnumNames<render::Backend> = {"auto", "opengl", "software"};
template <> inline constexpr std::array kEnumNames<app::StereoOutput> = {"none", "sbs"};
template <> inline constexpr std::array kEnumNames<app::QualityControl> = {"auto", "fixed"};
template <> inline constexpr std::array kEnumNames<app::WaterChoice> = {"auto", "on", "off"};
template <> inline constexpr std::array kEnumNames<app::ShadowChoice> = {"on", "off"};
template <> inline constexpr std::array kEnumNames<app::FilmChoice> = {"auto", "best", "small"};
template <> inline constexpr std::array kEnumNames<app::DecodeChoice> = {"auto", "software"};
// Variants of the hands' models
template <> inline constexpr std::array kEnumNames<app::Skin> = {"light", "medium", "dark", "glove"};
template <>
inline constexpr std::array kEnumNames<app::HandSourceKind> = {"auto",   "mouse",  "leap",  "webcam",
                                                               "openxr", "script", "replay"};
template <> inline constexpr std::array kEnumNames<hands::Side> = {"left", "right"};
template <> inline constexpr std::array kEnumNames<app::Closing> = {"hold", "toggle"};
template <> inline constexpr std::array kEnumNames<app::Turning> = {"smooth", "snap"};
template <> inline constexpr std::array kEnumNames<app::Posture> = {"auto", "seated", "standing"};
template <> inline constexpr std::array kEnumNames<app::CaptionSize> = {"small", "medium", "large"};
template <>
inline constexpr std::array kEnumNames<app::LanguageChoice> = {"auto", "english", "german", "french"};
template <> inline constexpr std::array kEnumNames<app::Start> = {"auto", "title", "dive"};
template <> inline constexpr std::array kEnumNames<hands::LeapMount> = {"desk", "head"};
template <> inline constexpr std::array kEnumNames<app::Background> = {"env", "none"};
// Also the files' extensions
template <> inline constexpr std::array kEnumNames<app::LightFormat> = {"pfm", "exr", "hdr"};

} // namespace shoal

namespace shoal::app {

struct EnvironmentOptions : environment::Source { // if none is given, the dive's own video
    float envYaw_deg = 0; // column u of the environment appears (u - 0.5) * 360 + this to the right of -Z

    bool isOwnVideo() const { return video.empty() && photo.empty() && env.empty(); }
    environment::Source orOwn(const Path& ownVideo) const {
        environment::Source source = *this;
        if (isOwnVideo()) source.video = ownVideo.string();
        return source;
    }

    void addTo(SettingsTable& table) {
        table.category = Category::Environment;
        table.add("--video", &video,
                  "A 360-degree video, lat-long: a file; or live: camera:NUMBER, a named pipe, or a URL "
                  "(rtsp, http, https, tcp, udp)",
                  {.placeholder = "FILE", .excludes = {"--photo", "--env"}});
        table.add("--photo", &photo, "A 360-degree photo, lat-long; an ordinary one is grown to one",
                  {.placeholder = "FILE", .excludes = {"--env"}});
        table.add("--env", &env, "A high dynamic range lat-long picture: .hdr, .exr, .pfm",
                  {.placeholder = "FILE"});
        table.add("--layer", &layer, "Layer of an OpenEXR picture, if it has several",
                  {.placeholder = "NAME"});
        table.add(
            "--layout", choice(layout),
            "Layout of a stereo picture's two eyes, the left one first; auto reads the file's metadata");
        table.add("--light", choice(light),
                  "Meaning of a video's or photo's values. auto: decoded sRGB, and how bright the light "
                  "was that the camera clipped by what the ground sends back of it; linear: decoded sRGB "
                  "(both: PQ and HLG as measured); thesis: its inverse tone mapping, with colours of objects "
                  "taken as they are coded");
        table.add("!--no-depth", &depth,
                  "Leaves the video's distances (NAME.depth.mkv beside NAME.mp4) alone: nothing of it hides "
                  "what swims, and for two eyes it is endlessly far");
        table.add("--env-yaw", &envYaw_deg, "Turns the environment to the right, degrees",
                  {.range = {-360, 360}});
    }
};

struct LookOptions {
    glm::ivec2 size{1280, 720};
    float exposure_ev = 0;
    Tone tone = Tone::Auto;
    render::Glossy glossy = render::Glossy::Prefiltered;
    Occlusion occlusion = Occlusion::Ellipsoids;
    render::Backend backend = render::Backend::Auto;
    render::ShownQuantity shown = render::ShownQuantity::Light;
    render::SkippedPass skip = render::SkippedPass::None;

    // oneBody: the command shows a single model at rest, for which there are more methods of occlusion.
    void addTo(SettingsTable& table, bool oneBody) {
        std::vector<Occlusion> occlusions = {Occlusion::Ellipsoids, Occlusion::Off};
        std::string occlusionHelp = "ellipsoids (also called on): bodies take light from each other, and "
                                    "their folds from themselves; with any OpenGL from 3.3";
        if (oneBody) {
            occlusions.insert(occlusions.end(), {Occlusion::Ollfb, Occlusion::OllfbThesis});
            occlusionHelp +=
                "; ollfb: the model shadows and reflects itself, by rays through layered fragment buffers, "
                "while it is still; ollfb-thesis: as the thesis has them; both need OpenGL 4.3";
        }
        table.category = Category::Picture;
        table.add("--size", sizeSetting(size), "Picture size in pixels", {.placeholder = "WxH"});
        table.addKept("--exposure", &exposure_ev, "Brightens objects and background alike, stops (EV)",
                      {.range = {-10, 10}});
        table.add("--tone", choice(tone),
                  "Display curve: auto undoes the decoding of the video, or aces for HDR environments; aces; "
                  "linear");
        table.add("--glossy", choice(glossy),
                  "Glossy light: ggx as glTF defines it, or the thesis' 36 Phong samples");
        table.addKept("--occlusion", choice(occlusion, occlusions), occlusionHelp);
        table.add("--backend", choice(backend),
                  "Backend that samples the background and puts objects into it: opengl; software, on the "
                  "processor, with the same pictures but for rounding (OpenGL draws the objects in either "
                  "case); auto: software where the OpenGL driver itself renders on the processor");
        table.add("--show", choice(shown),
                  "Draws objects as one quantity of their light, to see where it comes from; occlusion: the "
                  "share of diffuse light that is left; depth: 1 / (1 + metres)");
        table.add("--skip", choice(skip),
                  "Leaves a pass out, to see what it draws; without the background, objects that are "
                  "composed into it go too; objects: their shadows and the particles as well");
    }
};

// A session's source of hands.
struct HandSourceChoice {
    HandSourceKind kind = HandSourceKind::Mouse;
    std::string argument; // a webcam's number or clip, a script's or a replay's file; may be empty
};

struct HandOptions {
    std::string source; // "KIND" or "KIND:ARGUMENT"; empty: auto in a window, else mouse
    hands::LeapOptions leap;
    float size = 1; // size of the player's hands relative to the rig's

    void addTo(SettingsTable& table) {
        table.category = Category::Hands;
        table.addShown(
            SettingsPage::Hands, "Hand source", "--hands", &source,
            "mouse; leap (Leap Motion, Ultraleap); auto: the best of these that is there, which is "
            "the default with a window; webcam, webcam:NUMBER, or webcam:FILE (a clip of hands); "
            "openxr (a headset's, which --xr means); script:FILE (a playthrough); replay:FILE. The "
            "mouse moves the hands where a device sees none",
            {.placeholder = "SOURCE", .suggestions = {"auto", "mouse", "leap", "webcam"}});
        table.addShown(SettingsPage::Hands, "Hand size (webcam)", "--hand-size", &size,
                       "Size of your hands before a webcam, which cannot tell; 1 is a hand 19 cm long",
                       {.range = {hands::kHandSizeMin, hands::kHandSizeMax}});
        addLeapTo(table);
        table.addKept(
            "--leap-mount", choice(leap.mount),
            "desk: the device lies on the desk and looks up; head: it is on a headset and looks ahead");
    }
    void addLeapTo(SettingsTable& table) { // address of the tracking service, for `shoal devices` too
        table.addKept("--leap", addressSetting(leap.host, leap.port),
                      "Address of the Leap / Ultraleap tracking service; 127.0.0.1:6437 if not given",
                      {.placeholder = "HOST:PORT"});
    }
};

} // namespace shoal::app
