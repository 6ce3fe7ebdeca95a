// shoal devices: lists hands, haptic devices and sound outputs; --test makes them pulse and sound.
#include "game/tools/Commands.h"

#include "engine/audio/Audio.h"
#include "engine/core/Files.h"
#include "engine/media/live/LiveFeed.h"
#include "engine/xr/Headset.h"
#include "input/hands/HandRig.h"
#include "input/hands/HandTracker.h"
#include "input/haptics/HapticDevices.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>
#include <utility>

namespace shoal::app {

using Clock = std::chrono::steady_clock;

// Sends the haptic devices a frame for a while, at their own pace.
static void feel(haptics::HapticDevices& hapticDevices, const haptics::HapticFrame& frame,
                 Clock::time_point began, double for_s) {
    const Clock::time_point start = Clock::now();
    for (double left_s = for_s; left_s > 0; left_s = for_s - haptics::secondsSince(start))
        std::this_thread::sleep_for(std::chrono::duration<double>(
            std::min(left_s, hapticDevices.step(frame, haptics::secondsSince(began)))));
}

// Pulses each actuator in turn, by its name, first low and then high; then the body.
static void pulseEach(haptics::HapticDevices& hapticDevices, Clock::time_point began) {
    constexpr double kPulse_s = 0.2, kPause_s = 0.15;
    for (size_t i = 0; i <= haptics::kActuatorCount; ++i) {
        const bool body = i == haptics::kActuatorCount;
        std::printf("  now: %s\n", body ? "body" : haptics::kActuatorNames[i]);
        std::fflush(stdout);
        for (const float frequency_Hz : {40.0f, 250.0f}) {
            haptics::HapticFrame frame;
            (body ? frame.body : frame.actuators[i]) = {1, frequency_Hz};
            feel(hapticDevices, frame, began, kPulse_s);
        }
        feel(hapticDevices, {}, began, kPause_s);
    }
}

static void haptic(bool test) {
    std::printf("Haptics\n");
    const Clock::time_point began = Clock::now();
    haptics::HapticDevices hapticDevices(haptics::withForceFeedback(haptics::hidapiBus()));
    hapticDevices.step({}, 0);
    const auto devices = hapticDevices.list();
    for (const haptics::HapticDevices::Listed& device : devices)
        std::printf("  %s at %s, %s: %s\n", device.name.c_str(), device.path.c_str(), device.motors,
                    device.problem.empty() ? "ready" : device.problem.c_str());
    if (devices.empty()) std::printf("  none plugged in\n");
    if (test && hapticDevices.ready() > 0) pulseEach(hapticDevices, began);
}

// Lists the cameras by name only: opening one would turn it on.
static void listCameras(const char* prefix, const char* none) {
    const auto cameras = media::listCameras();
    for (const auto& [number, name] : cameras) std::printf("  %s:%d: %s\n", prefix, number, name.c_str());
    if (cameras.empty()) std::printf("  %s\n", none);
}

static void sound(bool test) {
    std::printf("Sound\n");
    const auto outputs = audio::listOutputs();
    for (const std::string& output : outputs) std::printf("  %s\n", output.c_str());
    if (outputs.empty()) std::printf("  none\n");
    auto audio = audio::Audio::open({});
    if (!audio) {
        std::printf("  the default output: %s\n", audio.error().message().c_str());
        return;
    }
    std::printf("  the default output: ready%s\n", audio->headphones() ? ", for headphones" : "");
    auto clip = audio::readClip(dataRoot() / "content/sounds/catch.flac");
    if (!test || !clip) return;
    const int catching = audio->add(std::move(*clip));
    for (const auto& [name, side] : {std::pair{"left", -1.0f}, std::pair{"right", 1.0f}}) {
        std::printf("  now: %s\n", name);
        std::fflush(stdout);
        const audio::Sound shot{.clip = catching, .position = {side, 0, -0.3f}};
        audio->update({}, {}, {&shot, 1});
        std::this_thread::sleep_for(std::chrono::milliseconds(1300));
    }
}

static void listHandSources(const HandOptions& options) {
    std::printf("Hands\n  mouse: always\n");
    const auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    if (!rig) return;
    const auto leap = hands::makeLeapTracker(options.leap, *rig);
    hands::HandFrame frame;
    leap->stream().take(frame, std::chrono::milliseconds(500)); // a running service answers at once
    const hands::DeviceState state = leap->stream().state();
    std::printf("  leap: %s%s\n", state.present ? "ready, " : "", state.description.c_str());
    listCameras("webcam", "webcam: none plugged in");
}

int devices(const DevicesOptions& options) {
    listHandSources(options.hands);
    const auto runtime = xr::activeRuntime();
    std::printf("  openxr: %s\n",
                runtime ? (*runtime + "; play with --xr").c_str() : runtime.error().reason.c_str());
    std::printf("Cameras, for --video and --hands webcam\n");
    listCameras("camera", "none");
    haptic(options.test);
    sound(options.test);
    return 0;
}

} // namespace shoal::app
