// How long a touch takes from the tick of its contact to the bytes on their way to the device. Measured and
// printed, not asserted: other programs share the machine.
#include "engine/core/Files.h"
#include "game/feedback/HapticFeedback.h"
#include "input/haptics/HapticDevices.h"
#include "tests/playthrough/Play.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <thread>

namespace shoal::game {
namespace {

using Clock = std::chrono::steady_clock;

// A DualSense on USB (at most one report each 4 ms) that notes when it is written to.
struct Stamped {
    std::mutex mutex;
    std::vector<Clock::time_point> written;

    struct Device final : haptics::HidDevice {
        explicit Device(Stamped& owner) : stamped(owner) {}
        bool write(std::span<const uint8_t>) override {
            const std::lock_guard lock(stamped.mutex);
            stamped.written.push_back(Clock::now());
            return true;
        }
        Stamped& stamped;
    };
    haptics::HidBus bus() {
        return {[] {
                    return std::vector<haptics::HidInfo>{{"x", 0x054c, 0x0ce6, haptics::Transport::Usb, ""}};
                },
                [this](const std::string&) { return std::make_unique<Device>(*this); }};
    }
};

// Plays a script with a hand among the fish at its true pace: the one place that must wait for a clock, for
// at another pace the device's limit would count otherwise.
TEST(Latency, FromTheTickOfContactToTheBytesWritten) {
    auto script = loadScript(dataRoot() / "tests/playthrough/two_hands.toml");
    ASSERT_TRUE(script) << script.error().message();
    const auto files = loadDiveFiles(script->dive);
    ASSERT_TRUE(files) << files.error().message();
    const auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    ASSERT_TRUE(rig) << rig.error().message();
    script->timeout_s = 6;

    Stamped device;
    std::vector<Clock::time_point> touched; // when the tick of the contact began
    {
        haptics::HapticOutput output(device.bus());
        HapticFeedback feel;
        Clock::time_point tickBegan = Clock::now();
        playScript(*script, *rig, *files, [&](const Snapshot& now, const Events& events) {
            const bool touch = std::any_of(events.begin(), events.end(),
                                           [](const Event& event) { return event.kind == EventKind::Touch; });
            if (touch) touched.push_back(tickBegan);
            output.submit(feel.frame(now, events, sim::kTick_s, 1));
            tickBegan +=
                std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(sim::kTick_s));
            std::this_thread::sleep_until(tickBegan);
            tickBegan = std::max(tickBegan, Clock::now() - std::chrono::milliseconds(1));
        });
    }
    std::vector<double> latency_ms;
    for (const Clock::time_point when : touched) {
        const auto next = std::lower_bound(device.written.begin(), device.written.end(), when);
        if (next != device.written.end())
            latency_ms.push_back(std::chrono::duration<double, std::milli>(*next - when).count());
    }
    ASSERT_FALSE(latency_ms.empty());
    std::sort(latency_ms.begin(), latency_ms.end());
    const auto quantile = [&](double q) {
        return latency_ms[static_cast<size_t>(q * static_cast<double>(latency_ms.size() - 1))];
    };
    std::printf(
        "%zu touches: contact to bytes written, median %.2f ms, 99th percentile %.2f ms, worst %.2f ms\n",
        latency_ms.size(), quantile(0.5), quantile(0.99), quantile(1));
}

} // namespace
} // namespace shoal::game
