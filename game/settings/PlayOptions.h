// Options of `shoal play` with their table: those of players, and those that tests and measurements need.
// Before them come enumerations, each with the one table of its names on the command line and in the settings
// file, and options that several commands share, each struct with its rows of the table of settings.
// To add a setting, add one member and one row, here or in a tool's own struct.
#pragma once

#include "engine/environment/Player.h"
#include "engine/light/EnvironmentLight.h"
#include "engine/light/InverseToneMap.h"
#include "engine/render/View.h"
#include "game/rules/DiveFile.h"
#include "game/settings/Setting.h"
#include "input/hands/HandTracker.h"

#include <cstdlib>
#include <optional>
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
enum class DiffuseSize { W16, W32, W64, W128, W256, W512, W1024 };

// Returns the width of a diffuse map, texels.
constexpr int widthOf(DiffuseSize size) { return 16 << static_cast<int>(size); }

} // namespace shoal::app

namespace shoal {

template <> inline constexpr std::array kEnumNames<app::Tone> = {"auto", "aces", "linear"};
template <> inline constexpr std::array kEnumNames<render::Glossy> = {"ggx", "phong36"};
template <> inline constexpr std::array kEnumNames<light::DiffuseMethod> = {"default", "thesis"};
template <>
inline constexpr std::array kEnumNames<light::FrameRadiance> = {"auto", "thesis", "linear", "akyuz",
                                                                "landis"};
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
template <>
inline constexpr std::array kEnumNames<app::DiffuseSize> = {"16", "32", "64", "128", "256", "512", "1024"};

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
                  "taken as they are coded; akyuz, landis: operators that it names, which make white 10");
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
            SettingsPage::Hands, "Hand tracking", "--hands", &source,
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

struct ControlOptions {
    hands::Side hand = hands::Side::Right;
    float sensitivity = 1;
    bool invertLook = false;
    Closing closing = Closing::Hold;
    float reachHelp = 1; // 0 to 1
    Turning turning = Turning::Smooth;
    std::string bindings; // keys and buttons as Bindings::parse() reads them; empty: the defaults

    void addTo(SettingsTable& table) {
        using enum SettingsPage;
        table.category = Category::Hands;
        table.addShown(Hands, "Dominant hand", "--dominant-hand",
                       choice(hand, {hands::Side::Right, hands::Side::Left}),
                       "The hand that mouse and gamepad move");
        table.addShown(Hands, "Mouse sensitivity", "--sensitivity", &sensitivity,
                       "How far mouse and gamepad turn the view, in times of the default",
                       {.range = {0.2, 3}});
        table.addShown(Hands, "Invert up and down", "--invert-look", &invertLook,
                       "Mouse and stick forward look down");
        table.addShown(
            Hands, "Help with depth", "--reach-help", &reachHelp,
            "Draws the mouse's hand to the distance of the fish it points at: 0 (the wheel alone) to 1",
            {.range = {0, 1}, .personal = true});
        table.addShown(
            Hands, "Close the hand by", "--closing", choice(closing),
            "hold: the hand is closed while the button is down; toggle: each press closes or opens it");
        table.addShown(Comfort, "Turning", "--turning", choice(turning),
                       "smooth, or snap: in steps of 30 degrees, which more people bear");
        table.addKept("--bindings", &bindings,
                      "Keys and a gamepad's button of actions, as the game's settings write them",
                      {.placeholder = "TEXT"});
    }
};

struct TextSettings {
    LanguageChoice language = LanguageChoice::Auto;
    float scale = 1;
    bool highContrast = false;
    bool captions = true;
    CaptionSize captionSize = CaptionSize::Medium;

    // Returns the language of the screen: the chosen one, or the system's.
    game::Language shownLanguage() const {
        if (language != LanguageChoice::Auto) // which comes before the languages
            return static_cast<game::Language>(static_cast<int>(language) - 1);
        for (const char* variable : {"LC_ALL", "LC_MESSAGES", "LANG"})
            if (const char* locale = std::getenv(variable); locale && *locale)
                return game::languageOf(locale);
        return game::Language::English;
    }

    void addTo(SettingsTable& table) {
        using enum SettingsPage;
        table.category = Category::Picture;
        table.addShown(Text, "Language", "--language", choice(language),
                       "Language of the screen; auto: the system's (LC_MESSAGES)");
        table.addShown(Text, "Text size", "--text-size", &scale, "Size of all text; 1 is the default",
                       {.range = {0.8, 1.6}});
        table.addShown(Text, "High contrast", "--high-contrast", &highContrast, "White text on black");
        table.addShown(Text, "Captions", "!--no-captions", &captions, "Do not name sounds on the screen");
        table.addShown(Text, "Caption size", "--caption-size", choice(captionSize), "Caption size");
    }
};

inline constexpr const char* kFirstDive = "reef";

struct PlayOptions {
    std::string dive;             // empty: kFirstDive
    std::optional<uint64_t> seed; // empty: random for a dive in a window, else 1
    std::string file;             // file of the environment, of any kind
    EnvironmentOptions environment;
    LookOptions look;
    HandOptions hands;
    Skin skin = Skin::Light;
    Start start = Start::Auto;
    ControlOptions controls;
    bool firstSteps = true;          // first steps come before the next dive, which begins when they are over
    float speed = 1;                 // game time over clock time
    Posture posture = Posture::Auto; // in a headset
    bool reducedMotion = false;      // only the player and the animals move
    bool vignette = false;           // dark edges while the view turns
    TextSettings text;
    std::string record;
    StereoOutput stereo = StereoOutput::None;
    bool xr = false;          // in an OpenXR headset
    bool passthrough = false; // in a headset: the player's own room in place of the film
    float fov_deg = 65;       // vertical
    float eyeDistance_mm = 64;
    bool fullscreen = false;
    bool vsync = true;
    QualityControl quality = QualityControl::Auto;
    bool headless = false;
    float fps = 60; // headless: frames a second of dive time
    std::string screenshot;
    std::optional<float> at_s;
    std::string stats;
    bool timedemo = false;
    game::Assist assist = game::Assist::Normal;
    bool freeSwim = false;
    render::Composition compose = render::Composition::CameraResponse;
    bool frameTimes = false; // the developer's panel
    bool mute = false;
    bool headphones = false;
    float volume = 0.8f;
    float effects = 1;  // volume of all sounds but music and the video's, 0 to 1
    float music = 0.7f; // volume of the dive's music, 0 to 1
    bool freeSwimMusic = true;
    float videoSound = 0.8f; // volume of the video's own sound, 0 to 1
    float hapticStrength = 1;
    WaterChoice water = WaterChoice::Auto;
    bool snow = true; // specks that drift in the water
    FilmChoice film = FilmChoice::Auto;
    DecodeChoice decode = DecodeChoice::Auto;
    ShadowChoice shadows = ShadowChoice::On; // shadows on the surfaces of a film with distances

    void addTo(SettingsTable& table) {
        using enum SettingsPage;
        table.category = Category::Dive;
        table.add("--dive", &dive, "Name of a dive in content/dives; reef if not given", {.personal = true});
        table.add("--start", choice(start),
                  "First screen of the game: title or dive; auto: title, where a person plays in a window "
                  "and has named no dive; in a headset the dive begins at once");
        table.addShown(Comfort, "Show the first steps", "!--no-first-steps", &firstSteps,
                       "A player's first dive begins at once, without the steps that teach how to catch");
        table.addShown(Comfort, "Game speed", "--speed", &speed, "Speed of the game; 1 is that of a clock",
                       {.range = {0.5, 1}});
        table.addShown(Comfort, "Posture", "--posture", choice(posture),
                       "Seated in a headset brings fish to where you reach them without a step; auto: as you "
                       "are when a dive begins, where the headset knows the floor, else standing",
                       {.personal = true});
        table.add("--seed", &seed,
                  "Seed of everything random in the dive; if not given, each dive in a window draws one, and "
                  "dives without a window have 1",
                  {.personal = true});
        table.add("--record", &record, "Writes a replay: seed and every tick's input",
                  {.placeholder = "FILE"});
        table.add("--free-swim", &freeSwim, "No clock and no shark", {.personal = true});
        environment.addTo(table);
        table.add("FILE", &file,
                  "A 360-degree video, photo or HDR picture to dive in; its content tells which",
                  {.excludes = {"--video", "--photo", "--env"}});
        look.addTo(table, false);
        table.category = Category::Picture;
        table.addShown(
            Comfort, "Reduced motion", "--reduced-motion", &reducedMotion,
            "Nothing moves by itself but the video and the animals: no drifting view, no particles");
        table.addShown(Comfort, "Dark edges while turning", "--vignette", &vignette,
                       "Dark edges while the view turns, against sickness");
        table.addShown(Picture, "Stereo", "--stereo", choice(stereo),
                       "none, or sbs: left and right eye side by side");
        table.add("--xr", &xr,
                  "Plays in a headset, by the OpenXR runtime that is active; the window shows its left eye",
                  {.excludes = {"--stereo", "--headless"}});
        table.addShown(Picture, "Your own room", "--passthrough", &passthrough,
                       "Shows your own room in a headset, around the animals in place of the film, which "
                       "goes on lighting them (F2 in the game)");
        table.addShown(Picture, "Field of view", "--fov", &fov_deg, "Vertical field of view, degrees",
                       {.range = {20, 130}});
        table.addKept("--eye-distance", &eyeDistance_mm, "Between the eyes in stereo, millimetres",
                      {.range = {0, 100}});
        table.addShown(Picture, "Fullscreen", "--fullscreen", &fullscreen,
                       "Fill the screen (F11 in the game)");
        table.addKept("!--no-vsync", &vsync, "Do not wait for the display");
        table.addShown(Picture, "Picture quality", "--quality", choice(quality),
                       "auto draws fewer pixels, then makes light less often, while frames take longer than "
                       "the display allows; fixed never does (nor does --headless)");
        table.addShown(
            Picture, "Animals in the film", "--compose",
            choice(compose, {render::Composition::Plain, render::Composition::MatchedResolution,
                             render::Composition::CameraResponse}),
            "How objects come into the video: plain, as finely as the picture is drawn; resolution, as "
            "finely as the video is, and scaled up with it; camera, into the video's own frame, as its "
            "camera would have filmed them (blur, glare, noise, levels, colours; all estimated)");
        table.addKept("--water", choice(water),
                      "Dims what is drawn with distance as the environment's water does: auto as the dive "
                      "says, or, of another video or photo, where the picture has lost its red; on; off");
        table.addShown(Comfort, "Specks in the water", "!--no-snow", &snow,
                       "No particles that drift in the water");
        table.addShown(Picture, "Film size", "--film", choice(film),
                       "Which version of a dive's film: best; small, for slow machines; auto: small without "
                       "a graphics card or with fewer than four processor cores");
        table.addKept("--decode", choice(decode),
                      "Decodes films by the graphics card that draws, where it can (VAAPI, CUDA): auto; "
                      "software, on the processor");
        table.addKept("--shadows", choice(shadows),
                      "Shadows of animals and of your hands on what the film shows, where it has a track of "
                      "distances; of what swims, on the floor of your own room, where the headset knows it");
        table.addShown(Picture, "Technical details", "--frame-times", &frameTimes,
                       "Shows frame times, and which light is used (F1 in the game)");
        hands.addTo(table);
        table.addShown(Hands, "Help with catching", "--assist", choice(assist),
                       "Helps a hand that is nearly right when it closes on a fish; none: only what the "
                       "fingers really close around is held",
                       {.personal = true});
        table.addShown(Hands, "Skin", "--skin", choice(skin), "How your hands look");
        controls.addTo(table);
        table.category = Category::Hands;
        table.addShown(Hands, "Vibration strength", "--haptics", &hapticStrength,
                       "Strength of haptics, 0 (off) to 1", {.range = {0, 1}});
        text.addTo(table);
        table.category = Category::Sound;
        table.addKept("--mute", &mute, "No sound");
        table.addShown(Sound, "Volume", "--volume", &volume, "Sound volume (+ and - in the game), 0 to 1",
                       {.range = {0, 1}});
        table.addShown(Sound, "Effects volume", "--effects-volume", &effects,
                       "Volume of all sounds but music and the video's own, 0 to 1", {.range = {0, 1}});
        table.addShown(Sound, "Music volume", "--music", &music,
                       "Volume of the music that a dive in its own film has, 0 to 1", {.range = {0, 1}});
        table.addShown(Sound, "Music in free swim", "!--no-free-swim-music", &freeSwimMusic,
                       "No music in free swim");
        table.addShown(Sound, "Film volume", "--video-sound", &videoSound,
                       "Volume of the video's own sound, 0 to 1", {.range = {0, 1}});
        table.addShown(Sound, "Headphones", "--headphones", &headphones, "Sound for headphones (HRTF)");
        table.category = Category::Measuring;
        table.add("--headless", &headless,
                  "No window, no sound device, no display server; the same pictures, drawn for --screenshot "
                  "and --timedemo alone");
        table.add("--fps", &fps, "Headless: pictures drawn for each second of the dive",
                  {.range = {1, 1000}});
        table.add("--at", &at_s, "Headless: ends after that many seconds of the dive", {.range = {0, 3600}});
        table.add("--screenshot", &screenshot, "Writes a picture at --at, or at the end",
                  {.placeholder = "FILE.png"});
        table.add(
            "--stats", &stats,
            "Writes frame times (milliseconds; of pictures, where some are drawn), counts and the state "
            "hash",
            {.placeholder = "FILE.json"});
        table.add(
            "--timedemo", &timedemo,
            "Draws as fast as it can, first five seconds to warm up; the video keeps its own rate. Prints "
            "the time of each part of a frame");
    }
};

} // namespace shoal::app
