// Tests of the thread that writes to the devices.
#include "FakeBus.h"

#include "input/haptics/HapticDevices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace shoal::haptics {
namespace {

// A DualSense on USB that keeps the values of its strong motor, and that can be slow to write to.
struct Watched {
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<int> strong;
    std::atomic<bool> slow{false}, entered{false};

    struct Device final : HidDevice {
        explicit Device(Watched& owner) : watched(owner) {}
        bool write(std::span<const uint8_t> report) override {
            watched.entered = true;
            watched.slow.wait(true); // a device that takes its time
            const std::lock_guard lock(watched.mutex);
            watched.strong.push_back(report[4]);
            watched.changed.notify_all();
            return true;
        }
        Watched& watched;
    };
    HidBus bus() {
        return {[] {
                    return std::vector<HidInfo>{{"x", 0x054c, 0x0ce6, Transport::Usb, ""}};
                },
                [this](const std::string&) { return std::make_unique<Device>(*this); }};
    }
    std::vector<int> told() {
        const std::lock_guard lock(mutex);
        return strong;
    }
};

// Submits until a condition holds: on a busy machine a frame may be too old before it comes to the device.
template <class Enough> void submitUntil(HapticOutput& output, float amplitude, Enough&& enough) {
    while (!enough()) {
        output.submit(frameOf(amplitude, 40));
        std::this_thread::yield();
    }
}

TEST(HapticOutput, TheNewestFrameReachesTheDevice) {
    Watched device;
    HapticOutput output(device.bus());
    submitUntil(output, 1, [&] { return !device.told().empty(); });
    EXPECT_EQ(device.told().front(), 255);
}

TEST(HapticOutput, ADeviceThatHangsHoldsNobodyUpAndThenGetsTheNewest) {
    constexpr int kNewest = 102, kBetween = 153; // 0.2 + 0.8 / 4 and / 2, of 255
    Watched device;
    HapticOutput output(device.bus());
    device.slow = true;
    submitUntil(output, 1, [&] { return device.entered.load(); });
    for (int i = 0; i < 1000; ++i)
        output.submit(frameOf(0.5f, 40)); // each returns though the device does not
    EXPECT_THAT(device.told(), testing::IsEmpty());
    output.submit(frameOf(0.25f, 40));
    device.slow = false;
    device.slow.notify_all();
    submitUntil(output, 0.25f, [&] { return std::ranges::count(device.told(), kNewest) > 0; });
    EXPECT_EQ(device.told().front(), 255);
    EXPECT_EQ(std::ranges::count(device.told(), kBetween), 0) << "none of the thousand";
}

TEST(HapticOutput, AStalledProgramIsNotFelt) {
    Watched device;
    HapticOutput output(device.bus());
    submitUntil(output, 1, [&] { return !device.told().empty(); });
    std::unique_lock lock(device.mutex); // no further frame comes: the motor stops by itself
    device.changed.wait(lock, [&] { return device.strong.back() == 0; });
    EXPECT_EQ(device.strong.front(), 255);
}

TEST(HapticOutput, EndsWithStillMotors) {
    Watched device;
    {
        HapticOutput output(device.bus());
        submitUntil(output, 1, [&] { return !device.told().empty(); });
    }
    EXPECT_EQ(device.told().front(), 255);
    EXPECT_EQ(device.told().back(), 0);
}

} // namespace
} // namespace shoal::haptics
