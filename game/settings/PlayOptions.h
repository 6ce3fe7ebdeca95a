// Options of `shoal play` with their table: what a player can set, and what tests and measurements need.
#pragma once

#include "engine/audio/Audio.h"
#include "game/settings/SharedOptions.h"

#include <optional>
#include <string>

namespace shoal::app {

struct PlayOptions {
    std::string dive = "reef";
    uint64_t seed = 1;
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
    bool snow = true;                        // specks that drift in the water
    ShadowChoice shadows = ShadowChoice::On; // on the ground that the dive's video shows

    SettingsTable settings() {
        SettingsTable table = diveSettings();
        append(table, environment.settings());
        append(table, look.settings(false));
        append(table, pictureSettings());
        append(table, hands.settings());
        append(table, handSettings());
        append(table, soundSettings());
        append(table, testSettings());
        return table;
    }

  private:
    SettingsTable diveSettings() {
        return inCategory(Category::Dive, {Setting("--dive", &dive, "Name of a dive in content/dives"),
                                           Setting("--seed", &seed, "Seed of everything random in the dive"),
                                           Setting("--record", &record,
                                                   "Writes a replay: seed, settings and every tick's input")
                                               .takes("FILE")});
    }

    SettingsTable pictureSettings() {
        return inCategory(
            Category::Picture,
            {Setting("--stereo", choice(stereo), "none, or sbs: left and right eye side by side").keep(),
             Setting("--xr", &xr,
                     "In a headset, by the OpenXR runtime that is active; the window shows its left eye")
                 .without({"--stereo", "--headless"}),
             Setting("--fov", &fov_deg, "Vertical field of view").in("degrees").between(20, 130).keep(),
             Setting("--eye-distance", &eyeDistance_mm, "Between the eyes in stereo")
                 .in("millimetres")
                 .between(0, 100)
                 .keep(),
             Setting("--fullscreen", &fullscreen, "Fill the screen (F11 in the game)").keep(),
             Setting("!--no-vsync", &vsync, "Do not wait for the display").keep(),
             Setting("--quality", choice(quality),
                     "auto draws fewer pixels, then makes light less often, while frames take longer "
                     "than the display allows; fixed never does (nor does --headless)")
                 .keep(),
             Setting("--compose",
                     choice(compose,
                            {render::Composition::Plain, render::Composition::MatchedResolution,
                             render::Composition::VideoTexels, render::Composition::CameraResponse},
                            {{"auto", render::Composition::CameraResponse}}),
                     "How objects come into the video: plain, as finely as the picture is drawn; "
                     "resolution, as finely as the video is, and scaled up with it; texels, into the "
                     "video's own frame; camera, as its camera would have filmed them (blur, glare, "
                     "noise, levels, colours; all estimated); auto: camera")
                 .keep(),
             Setting("--water", choice(water),
                     "Dims what is drawn with distance as the environment's water does: auto as the dive "
                     "says, or, of another video or photo, where the picture has lost its red; on; off")
                 .keep(),
             Setting("!--no-snow", &snow, "No specks that drift in the water").keep(),
             Setting("--shadows", choice(shadows),
                     "Of what swims and of your hands, on the ground that the dive's own video shows")
                 .keep(),
             Setting("!--no-captions", &captions, "Do not name sounds on the screen").keep(),
             Setting("--frame-times", &frameTimes,
                     "Shows frame times, and which light is used (F1 in the game)")
                 .keep()});
    }

    SettingsTable handSettings() {
        return inCategory(Category::Hands,
                          {Setting("--skin", choice(skin), "How your hands look").keep(),
                           Setting("--haptics", &hapticStrength, "Strength of haptics, 0 (off) to 1")
                               .between(0, 1)
                               .keep()});
    }

    SettingsTable soundSettings() {
        return inCategory(
            Category::Sound,
            {Setting("--mute", &mute, "No sound").keep(),
             Setting("--headphones", &headphones, "Sound for headphones (HRTF)").keep(),
             Setting("--volume", &volume, "Sound volume (+ and - in the game)")
                 .in("0 to 1")
                 .between(0, 1)
                 .keep(),
             Setting("--video-sound", &videoSound, "Volume of the video's own sound")
                 .in("0 to 1")
                 .between(0, 1)
                 .keep(),
             Setting("--doppler", &doppler,
                     "How much what swims past changes its pitch, in times of water's own effect: 0 not "
                     "at all, 1 as in water, where it is hardly heard; 4.4 as ears know it from air")
                 .between(0, 20)
                 .keep()});
    }

    SettingsTable testSettings() {
        return inCategory(
            Category::Measuring,
            {Setting("--headless", &headless,
                     "No window, no sound device, no display server; the same pictures"),
             Setting("--fps", &fps, "Headless: pictures drawn for each second of the dive").between(1, 1000),
             Setting("--at", &at_s, "Headless: ends after that many seconds of the dive").between(0, 3600),
             Setting("--screenshot", &screenshot, "Writes a picture at --at, or at the end")
                 .takes("FILE.png"),
             Setting("--stats", &stats, "Writes frame times (milliseconds), counts and the state hash")
                 .takes("FILE.json"),
             Setting("--timedemo", &timedemo,
                     "Draws as fast as it can: once to warm up, once measured; the video keeps its own "
                     "rate"),
             Setting("--load", &load_ms,
                     "Keeps the processor busy for that many milliseconds a frame, to see what --quality "
                     "auto does about it; also with --headless --timedemo, for 60 frames a second")
                 .between(0, 1000),
             Setting("--backdrop-only", &backdropOnly,
                     "Draws the environment alone, to compare frame times with")});
    }
};

} // namespace shoal::app
