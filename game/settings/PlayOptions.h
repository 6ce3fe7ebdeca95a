// Options of `shoal play` with their table: what a player can set, and what tests and measurements need.
#pragma once

#include "engine/audio/Audio.h"
#include "game/settings/SharedOptions.h"

#include <optional>
#include <string>

namespace shoal::app {

struct PlayOptions {
    std::string dive = "reef";
    std::optional<uint64_t> seed; // empty: drawn for a dive in a window, else 1
    std::string file;             // of the environment, whatever it holds
    EnvironmentOptions environment;
    LookOptions look;
    HandOptions hands;
    Skin skin = Skin::Light;
    std::string record;
    StereoOutput stereo = StereoOutput::None;
    bool xr = false;    // in an OpenXR headset
    float fov_deg = 65; // vertical
    float eyeDistance_mm = 64;
    bool fullscreen = false;
    bool vsync = true;
    QualityControl quality = QualityControl::Auto;
    float load_ms = 0; // artificial, for each frame
    bool headless = false;
    float fps = 60; // headless: frames a second of dive time
    std::string screenshot;
    std::optional<float> at_s;
    std::string stats;
    bool timedemo = false;
    bool backdropOnly = false;
    game::Assist assist = game::Assist::Normal;
    bool freeSwim = false;
    float reachHelp = 1;
    render::Composition compose = render::Composition::CameraResponse;
    bool frameTimes = false; // the developer's panel
    bool mute = false;
    bool headphones = false;
    float volume = 0.8f;
    float videoSound = 0.8f; // of the video's own sound, 0 to 1
    float doppler = audio::kDopplerAsInAir;
    float hapticStrength = 1;
    bool captions = true;
    WaterChoice water = WaterChoice::Auto;
    bool snow = true; // specks that drift in the water
    FilmChoice film = FilmChoice::Auto;
    ShadowChoice shadows = ShadowChoice::On; // on the ground that the dive's video shows

    void addTo(SettingsTable& table) {
        table.category = Category::Dive;
        table.add("--dive", &dive, "Name of a dive in content/dives");
        table.add("--seed", &seed,
                  "Seed of everything random in the dive; if not given, each dive in a window draws one, and "
                  "dives without a window have 1");
        table.add("--record", &record, "Writes a replay: seed and every tick's input").takes("FILE");
        table.add("--free-swim", &freeSwim, "No clock and no shark");
        environment.addTo(table);
        table
            .add("FILE", &file,
                 "A 360-degree video, photo or HDR picture to dive in; its content tells which")
            .without({"--video", "--photo", "--env"});
        look.addTo(table, false);
        addPictureTo(table);
        hands.addTo(table);
        table.addKept(
            "--assist", choice(assist),
            "Helps a hand that is nearly right when it closes on a fish; none: only what the fingers "
            "really close around is held");
        table
            .addKept(
                "--reach-help", &reachHelp,
                "Draws the mouse's hand to the distance of the fish it points at: 0 (the wheel alone) to 1")
            .between(0, 1);
        table.addKept("--skin", choice(skin), "How your hands look");
        table.addKept("--haptics", &hapticStrength, "Strength of haptics, 0 (off) to 1").between(0, 1);
        addSoundTo(table);
        addTestsTo(table);
    }

  private:
    void addPictureTo(SettingsTable& table) {
        using enum render::Composition;
        table.addKept("--stereo", choice(stereo), "none, or sbs: left and right eye side by side");
        table
            .add("--xr", &xr,
                 "In a headset, by the OpenXR runtime that is active; the window shows its left eye")
            .without({"--stereo", "--headless"});
        table.addKept("--fov", &fov_deg, "Vertical field of view, degrees").between(20, 130);
        table.addKept("--eye-distance", &eyeDistance_mm, "Between the eyes in stereo, millimetres")
            .between(0, 100);
        table.addKept("--fullscreen", &fullscreen, "Fill the screen (F11 in the game)");
        table.addKept("!--no-vsync", &vsync, "Do not wait for the display");
        table.addKept(
            "--quality", choice(quality),
            "auto draws fewer pixels, then makes light less often, while frames take longer than the "
            "display allows; fixed never does (nor does --headless)");
        table.addKept(
            "--compose",
            choice(compose, {Plain, MatchedResolution, VideoTexels, CameraResponse},
                   {{"auto", CameraResponse}}),
            "How objects come into the video: plain, as finely as the picture is drawn; resolution, as "
            "finely as the video is, and scaled up with it; texels, into the video's own frame; camera, "
            "as its camera would have filmed them (blur, glare, noise, levels, colours; all estimated); "
            "auto: camera");
        table.addKept(
            "--water", choice(water),
            "Dims what is drawn with distance as the environment's water does: auto as the dive says, "
            "or, of another video or photo, where the picture has lost its red; on; off");
        table.addKept("!--no-snow", &snow, "No specks that drift in the water");
        table.addKept("--film", choice(film),
                      "Which version of a dive's film: best; small, for slow machines; auto: small without "
                      "a graphics card or with fewer than four processor cores");
        table.addKept("--shadows", choice(shadows),
                      "Of what swims and of your hands, on the ground that the dive's own video shows");
        table.addKept("!--no-captions", &captions, "Do not name sounds on the screen");
        table.addKept("--frame-times", &frameTimes,
                      "Shows frame times, and which light is used (F1 in the game)");
    }

    void addSoundTo(SettingsTable& table) {
        table.category = Category::Sound;
        table.addKept("--mute", &mute, "No sound");
        table.addKept("--headphones", &headphones, "Sound for headphones (HRTF)");
        table.addKept("--volume", &volume, "Sound volume (+ and - in the game), 0 to 1").between(0, 1);
        table.addKept("--video-sound", &videoSound, "Volume of the video's own sound, 0 to 1").between(0, 1);
        table
            .addKept(
                "--doppler", &doppler,
                "How much what swims past changes its pitch, in times of water's own effect: 0 not at all, "
                "1 as in water, where it is hardly heard; 4.4 as ears know it from air")
            .between(0, 20);
    }

    void addTestsTo(SettingsTable& table) {
        table.category = Category::Measuring;
        table.add("--headless", &headless,
                  "No window, no sound device, no display server; the same pictures");
        table.add("--fps", &fps, "Headless: pictures drawn for each second of the dive").between(1, 1000);
        table.add("--at", &at_s, "Headless: ends after that many seconds of the dive").between(0, 3600);
        table.add("--screenshot", &screenshot, "Writes a picture at --at, or at the end").takes("FILE.png");
        table.add("--stats", &stats, "Writes frame times (milliseconds), counts and the state hash")
            .takes("FILE.json");
        table.add("--timedemo", &timedemo,
                  "Draws as fast as it can: once to warm up, once measured; the video keeps its own rate");
        table
            .add("--load", &load_ms,
                 "Keeps the processor busy for that many milliseconds a frame, to see what --quality auto "
                 "does about it; also with --headless --timedemo, for 60 frames a second")
            .between(0, 1000);
        table.add("--backdrop-only", &backdropOnly,
                  "Draws the environment alone, to compare frame times with");
    }
};

} // namespace shoal::app
