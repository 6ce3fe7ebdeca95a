// For `shoal devices`: the sources of hands.
#include "game/app/TrackedHands.h"

#include "engine/core/Files.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace shoal::app {

void listHandSources(const HandOptions& options) {
    std::printf("Hands\n  mouse: always\n");
    const auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    if (!rig) return;
    hands::LeapHands leap({options.leapHost, options.leapPort, false}, *rig);
    leap.stream().wait(std::chrono::milliseconds(500)); // a service that is there answers at once
    const hands::DeviceState state = leap.stream().state();
    std::printf("  leap: %s%s\n", state.present ? "ready, " : "", state.words.c_str());
    // Their names only: to open one would turn it on.
    bool any = false;
    std::error_code code;
    std::vector<Path> cameras;
    for (const auto& entry : std::filesystem::directory_iterator("/sys/class/video4linux", code))
        cameras.push_back(entry.path());
    std::sort(cameras.begin(), cameras.end());
    for (const Path& camera : cameras) {
        const auto index = readText(camera / "index", 64), name = readText(camera / "name", 4096);
        if (!index || !name || index->substr(0, 1) != "0") continue; // others give no pictures
        any = true;
        std::printf("  webcam:%s: %s", camera.filename().string().substr(5).c_str(), name->c_str());
    }
    if (!any) std::printf("  webcam: none plugged in\n");
}

} // namespace shoal::app
