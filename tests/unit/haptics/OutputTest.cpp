// The thread that writes.
#include "FakeBus.h"

#include "input/haptics/HapticDevices.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace shoal::haptics {
namespace {

using Clock = std::chrono::steady_clock;

// A DualSense on USB, of which another thread can see the strong motor, and that can be slow to write to.
struct Watched {
    std::atomic<int> strong{0};
    std::atomic<int> writes{0}, second{-1}; // what the second of them said
    std::atomic<bool> slow{false}, entered{false};

    HidBus bus() {
        return {.list =
                    [] {
                        return std::vector<HidInfo>{{"x", 0x054c, 0x0ce6, Transport::Usb, ""}};
                    },
                .descriptor = [](const std::string&) { return std::vector<uint8_t>(); },
                .open = [](const std::string&) -> Result<int> { return 0; },
                .write =
                    [this](int, std::span<const uint8_t> report) {
                        entered = true;
                        entered.notify_all();
                        slow.wait(true); // a device that takes its time
                        if (++writes == 2) second = report[4];
                        strong = report[4];
                        strong.notify_all();
                        return true;
                    },
                .readFeature = [](int, std::span<uint8_t>) { return size_t{0}; },
                .guard = [](int, std::span<const uint8_t>) {},
                .close = [](int) {}};
    }
};

TEST(HapticOutput, TheNewestFrameReachesTheDevice) {
    Watched device;
    HapticOutput output(device.bus());
    output.submit(frameOf(1, 40));
    device.strong.wait(0);
    EXPECT_EQ(device.strong, 255);
}

TEST(HapticOutput, ADeviceThatHangsHoldsNobodyUpAndThenGetsTheNewest) {
    Watched device;
    HapticOutput output(device.bus());
    device.slow = true;
    output.submit(frameOf(1, 40));
    device.entered.wait(false);
    for (int i = 0; i < 1000; ++i)
        output.submit(frameOf(0.5f, 40)); // each returns though the device does not
    EXPECT_EQ(device.writes, 0);
    output.submit(frameOf(0.25f, 40));
    device.slow = false;
    device.slow.notify_all();
    device.strong.wait(0);
    device.strong.wait(255);
    EXPECT_EQ(device.second, 102); // 0.2 + 0.8 / 4 of 255: none of the thousand between
}

TEST(HapticOutput, AStalledProgramIsNotFelt) {
    Watched device;
    HapticOutput output(device.bus());
    output.submit(frameOf(1, 40));
    device.strong.wait(0);
    device.strong.wait(255); // no further frame comes: the wait ends by itself
    EXPECT_EQ(device.strong, 0);
}

TEST(HapticOutput, EndsWithStillMotors) {
    Watched device;
    {
        HapticOutput output(device.bus());
        output.submit(frameOf(1, 40));
        device.strong.wait(0);
    }
    EXPECT_EQ(device.strong, 0);
}

} // namespace
} // namespace shoal::haptics
