// shoal devices: what hands, haptic devices and sound outputs there are; --test makes them pulse and sound.
#include "game/app/Commands.h"

#include "engine/audio/Audio.h"
#include "engine/core/Files.h"
#include "game/app/TrackedHands.h"
#include "input/haptics/Rack.h"

#include <chrono>
#include <cstdio>
#include <thread>

namespace shoal::app {

namespace {

using haptics::HapticFrame;

void pulse(const haptics::HidBus& bus) {
    haptics::Rack rack(bus);
    double now_s = 0;
    const auto feel = [&](float amplitude, float frequency_Hz) {
        HapticFrame frame;
        frame.actuators[0] = {amplitude, frequency_Hz};
        rack.step(frame, now_s);
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        now_s += 0.3;
    };
    feel(1, 40);
    feel(0, 40);
    feel(1, 250);
    feel(0, 250);
}

void sound() {
    auto audio = audio::Audio::open({});
    auto clip = audio::readClip(dataRoot() / "content/sounds/catch.flac");
    if (!audio || !clip) return;
    const audio::Shot left{.clip = audio->add(*clip), .position = {-1, 0, -1}};
    audio->update({}, {}, {&left, 1});
    std::this_thread::sleep_for(std::chrono::milliseconds(1300));
}

} // namespace

int devices(const DevicesOptions& options) {
    listHandSources(options.hands);
    std::printf("Haptics\n");
    const haptics::HidBus bus = haptics::hidapiBus();
    bool any = false;
    for (const haptics::HidInfo& info : bus.list()) {
        const haptics::Controller* controller = haptics::findController(info.vendor, info.product);
        if (!controller) continue;
        any = true;
        auto handle = bus.open(info.path);
        std::printf("  %s at %s: %s\n", controller->name, info.path.c_str(),
                    handle ? "ready" : handle.error().reason.c_str());
        if (handle) bus.close(*handle);
    }
    if (!any) std::printf("  none plugged in\n");
    std::printf("Sound\n");
    const auto outputs = audio::listOutputs();
    for (const std::string& output : outputs) std::printf("  %s\n", output.c_str());
    if (outputs.empty()) std::printf("  none\n");
    if (options.test) {
        pulse(bus);
        sound();
    }
    return 0;
}

} // namespace shoal::app
