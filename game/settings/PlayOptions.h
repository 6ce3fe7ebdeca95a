// Options of `shoal play` with their table: what a player can set, and what tests and measurements need.
#pragma once

#include "game/settings/SharedOptions.h"

#include <cstdlib>
#include <optional>
#include <string>

namespace shoal::app {

// Settings of mouse, keys and gamepad.
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
        table.addShown(Hands, "Invert looking up and down", "--invert-look", &invertLook,
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

// Settings of text on the screen.
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
        table.addShown(Text, "Size of captions", "--caption-size", choice(captionSize), "Size of captions");
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
    float effects = 1;       // volume of all sounds but the video's, 0 to 1
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
        table.addShown(Picture, "Quality", "--quality", choice(quality),
                       "auto draws fewer pixels, then makes light less often, while frames take longer than "
                       "the display allows; fixed never does (nor does --headless)");
        table.addShown(
            Picture, "Compositing", "--compose",
            choice(compose, {render::Composition::Plain, render::Composition::MatchedResolution,
                             render::Composition::CameraResponse}),
            "How objects come into the video: plain, as finely as the picture is drawn; resolution, as "
            "finely as the video is, and scaled up with it; camera, into the video's own frame, as its "
            "camera would have filmed them (blur, glare, noise, levels, colours; all estimated)");
        table.addKept("--water", choice(water),
                      "Dims what is drawn with distance as the environment's water does: auto as the dive "
                      "says, or, of another video or photo, where the picture has lost its red; on; off");
        table.addShown(Comfort, "Drifting particles", "!--no-snow", &snow,
                       "No particles that drift in the water");
        table.addShown(Picture, "Version of the film", "--film", choice(film),
                       "Which version of a dive's film: best; small, for slow machines; auto: small without "
                       "a graphics card or with fewer than four processor cores");
        table.addKept("--decode", choice(decode),
                      "Decodes films by the graphics card that draws, where it can (VAAPI, CUDA): auto; "
                      "software, on the processor");
        table.addKept("--shadows", choice(shadows),
                      "Shadows of animals and of your hands on what the film shows, where it has a track of "
                      "distances; of what swims, on the floor of your own room, where the headset knows it");
        table.addShown(Picture, "Performance", "--frame-times", &frameTimes,
                       "Shows frame times, and which light is used (F1 in the game)");
        hands.addTo(table);
        table.addShown(Hands, "Help with catching", "--assist", choice(assist),
                       "Helps a hand that is nearly right when it closes on a fish; none: only what the "
                       "fingers really close around is held",
                       {.personal = true});
        table.addShown(Hands, "Skin", "--skin", choice(skin), "How your hands look");
        controls.addTo(table);
        table.category = Category::Hands;
        table.addShown(Hands, "Strength of vibration", "--haptics", &hapticStrength,
                       "Strength of haptics, 0 (off) to 1", {.range = {0, 1}});
        text.addTo(table);
        table.category = Category::Sound;
        table.addKept("--mute", &mute, "No sound");
        table.addShown(Sound, "Volume", "--volume", &volume, "Sound volume (+ and - in the game), 0 to 1",
                       {.range = {0, 1}});
        table.addShown(Sound, "Volume of effects", "--effects-volume", &effects,
                       "Volume of all sounds but the video's own, 0 to 1", {.range = {0, 1}});
        table.addShown(Sound, "Volume of the film", "--video-sound", &videoSound,
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
