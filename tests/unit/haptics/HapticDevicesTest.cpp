// Tests of the schedule: which report goes to which device, and when.
#include "input/haptics/HapticDevices.h"
#include "FakeBus.h"
#include "tests/Test.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace shoal::haptics {
namespace {

using testing::HasSubstr;

constexpr uint16_t kSony = 0x054c, kDualSense = 0x0ce6, kNintendo = 0x057e, kPro = 0x2009;

TEST(HapticDevices, WritesChangesAndRefreshes) {
    FakeBus fake(kSony, kDualSense);
    fake.plug("keyboard", kNoVendor, 1);
    HapticDevices hapticDevices(fake.bus());
    const auto& written = fake.written["a"];
    hapticDevices.step({}, 0);
    EXPECT_EQ(hapticDevices.ready(), 1u);
    EXPECT_TRUE(written.empty()); // silence needs no telling
    hapticDevices.step(frameOf(1, 40), 0.1);
    ASSERT_EQ(written.size(), 1u);
    EXPECT_EQ(written[0][4], 255);
    hapticDevices.step(frameOf(1, 40), 0.4); // nothing new
    EXPECT_EQ(written.size(), 1u);
    hapticDevices.step(frameOf(1, 40), 0.61); // still running: told again
    EXPECT_EQ(written.size(), 2u);
    hapticDevices.step({}, 0.7);
    ASSERT_EQ(written.size(), 3u);
    EXPECT_EQ(written[2][4], 0);
    hapticDevices.step({}, 5);
    EXPECT_EQ(written.size(), 3u); // silence is not repeated
    EXPECT_TRUE(hapticDevices.allStopped());
}

// Frames come at 1 kHz, each another: every device gets no more than it can take, and in the end the newest.
TEST(HapticDevices, KeepsEachDevicesPaceAndTheNewestWins) {
    for (const DeviceRow& row : kDevices) {
        FakeBus fake(row.vendor, row.product, row.transport);
        HapticDevices hapticDevices(fake.bus());
        std::vector<double> times;
        size_t had = 0;
        double next_s = 0;
        for (int ms = 0; ms <= 900; ++ms) {
            const double now_s = ms * 1e-3;
            next_s = hapticDevices.step(frameOf(ms < 900 ? static_cast<float>(ms % 100) * 0.01f : 0.5f, 40),
                                        now_s);
            for (; had < fake.written["a"].size(); ++had) times.push_back(now_s);
        }
        for (size_t i = 1; i < times.size(); ++i)
            EXPECT_GE(times[i] - times[i - 1], row.minWrite_s - 1e-9) << row.name;
        EXPECT_GE(static_cast<double>(times.size()), 0.9 / (row.minWrite_s + 0.001) - 2)
            << row.name; // and no less
        hapticDevices.step(frameOf(0.5f, 40), 0.9 + std::min(next_s, 0.05));
        const Report last = driverOf(row, row.transport).encode(frameOf(0.5f, 40));
        // All but the bytes that sealing changes: sequence and checksum.
        const auto& written = fake.written["a"].back();
        ASSERT_EQ(written.size(), last.size);
        for (size_t i = 2; i < std::min<size_t>(last.size, 74); ++i)
            EXPECT_EQ(written[i], last.bytes[i]) << row.name;
    }
}

TEST(HapticDevices, TellsWhenToComeBack) {
    FakeBus fake(kNintendo, kPro);
    HapticDevices hapticDevices(fake.bus());
    hapticDevices.step({}, 0); // greeted
    ASSERT_EQ(fake.written["a"].size(), 1u);
    EXPECT_NEAR(hapticDevices.step(frameOf(1, 40), 0.01), 0.02, 1e-9); // 30 ms after the initialReports
    EXPECT_EQ(fake.written["a"].size(), 1u);
    EXPECT_NEAR(hapticDevices.step(frameOf(1, 40), 0.03), 0.05, 1e-9); // then refreshed every 50 ms
    EXPECT_EQ(fake.written["a"].size(), 2u);
    EXPECT_NEAR(hapticDevices.step({}, 0.1), kFindDevices_s - 0.1,
                1e-9); // nothing but the next look for devices
}

TEST(HapticDevices, UnpluggedWhileWritingAndPluggedInElsewhere) {
    FakeBus fake(kSony, kDualSense);
    HapticDevices hapticDevices(fake.bus());
    hapticDevices.step(frameOf(1, 40), 0);
    EXPECT_EQ(hapticDevices.ready(), 1u);
    fake.unplug("a");
    hapticDevices.step(frameOf(0.5f, 40), 0.1);
    EXPECT_EQ(hapticDevices.ready(), 0u);
    EXPECT_EQ(fake.opened, 0u);
    fake.plug("b", kSony, kDualSense);
    hapticDevices.step(frameOf(0.5f, 40), 0.5); // not yet looked again
    EXPECT_TRUE(fake.written["b"].empty());
    hapticDevices.step(frameOf(0.5f, 40), kFindDevices_s + 0.1);
    EXPECT_EQ(fake.written["b"].size(), 1u);
    EXPECT_TRUE(hapticDevices.takeWarnings().empty());
}

TEST(HapticDevices, TwoAtOnceAreBothFeltAndOneGoingDoesNotHarmTheOther) {
    FakeBus fake(kSony, kDualSense);
    fake.plug("b", kSony, kDualSense);
    fake.plug("c", kNintendo, kPro, Transport::Bluetooth);
    HapticDevices hapticDevices(fake.bus());
    hapticDevices.step({}, 0);
    hapticDevices.step(frameOf(1, 40), 0.1);
    EXPECT_EQ(fake.written["a"], fake.written["b"]);
    EXPECT_EQ(fake.written["a"].size(), 1u);
    EXPECT_EQ(fake.written["c"].size(), 2u);
    fake.unplug("a");
    hapticDevices.step(frameOf(0.5f, 40), 0.2);
    EXPECT_EQ(hapticDevices.ready(), 2u);
    EXPECT_EQ(fake.written["b"].size(), 2u);
    EXPECT_EQ(fake.written["c"].size(), 3u);
}

TEST(HapticDevices, AUserWithoutPermissionIsToldTheRuleOnce) {
    FakeBus fake;
    fake.plug("/dev/hidraw7", kSony, kDualSense);
    fake.plugged[0].permitted = false;
    HapticDevices hapticDevices(fake.bus());
    hapticDevices.step({}, 0);
    hapticDevices.step({}, kFindDevices_s);
    const auto complaints = hapticDevices.takeWarnings();
    ASSERT_EQ(complaints.size(), 1u);
    EXPECT_THAT(complaints[0], HasSubstr("/dev/hidraw7"));
    EXPECT_THAT(complaints[0], HasSubstr("70-shoal-haptics.rules"));
    EXPECT_THAT(complaints[0], HasSubstr(R"(KERNEL=="hidraw*", KERNELS=="*:054C:0CE6.*", TAG+="uaccess")"));
    EXPECT_THAT(hapticDevices.list().at(0).problem, HasSubstr("may not be opened"));
    fake.plugged[0].permitted = true; // the rule was put in, and udev ran
    hapticDevices.step({}, 2 * kFindDevices_s);
    EXPECT_EQ(hapticDevices.ready(), 1u);
    EXPECT_EQ(hapticDevices.list().at(0).problem, "");
}

TEST(HapticDevices, StopsTheMotorsAtTheEnd) {
    FakeBus fake(kSony, kDualSense);
    {
        HapticDevices hapticDevices(fake.bus());
        hapticDevices.step(frameOf(1, 40), 0);
        EXPECT_FALSE(hapticDevices.allStopped());
    }
    ASSERT_EQ(fake.written["a"].size(), 2u);
    EXPECT_EQ(fake.written["a"][1][4], 0);
    EXPECT_EQ(fake.opened, 0u);
}

TEST(HapticDevices, AStopIsReadyBeforeAnythingRuns) {
    FakeBus fake(kSony, kDualSense, Transport::Bluetooth);
    HapticDevices hapticDevices(fake.bus());
    hapticDevices.step({}, 0);
    ASSERT_EQ(fake.guarded["a"].size(), 1u);
    hapticDevices.step(frameOf(1, 40), 0.1);
    hapticDevices.step({}, 0.2);
    // The same but for the sequence number and, with it, the checksum.
    auto stop = fake.guarded["a"][0], written = fake.written["a"].back();
    stop.resize(74);
    written.resize(74);
    written[1] = 0;
    EXPECT_EQ(stop, written);
}

TEST(HapticDevices, SequenceNumbersRise) {
    FakeBus fake(kSony, kDualSense, Transport::Bluetooth);
    HapticDevices hapticDevices(fake.bus());
    for (int i = 0; i < 20; ++i) hapticDevices.step(frameOf(i % 2 ? 1.0f : 0.5f, 40), i * 0.02);
    ASSERT_EQ(fake.written["a"].size(), 20u);
    for (size_t i = 0; i < 20; ++i) EXPECT_EQ(fake.written["a"][i][1], i % 16 << 4);
}

// A pad that is reachable by HID and by the kernel's own driver.
TEST(HapticDevices, APadIsMovedThroughOneOfItsTwoPaths) {
    FakeBus fake;
    fake.plug("hid", kSony, kDualSense);
    fake.plug("event", kSony, kDualSense, Transport::ForceFeedback);
    for (FakeBus::Node& node : fake.plugged) node.info.device = "/sys/devices/pad";
    HapticDevices devices(fake.bus());
    devices.step({}, 0);
    EXPECT_EQ(fake.opened, 1u);
    EXPECT_EQ(devices.list()[0].path, "hid");

    // HID is not let in: the kernel's driver it is.
    FakeBus refused = fake;
    refused.opened = 0;
    refused.plugged[0].permitted = false;
    HapticDevices others(refused.bus());
    others.step(frameOf(1, 40), 0);
    ASSERT_EQ(refused.opened, 1u);
    ASSERT_EQ(refused.written["event"].size(), 1u);
    EXPECT_EQ(refused.written["event"][0], (std::vector<uint8_t>{0xFF, 0xFF, 0, 0})); // all on the strong one
}

// A DualSense on USB that keeps the values of its strong motor, and that can be slow to write to.
struct Watched : FakeBus {
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<int> strong;
    std::atomic<bool> slow{false}, entered{false};

    Watched() : FakeBus(kSony, kDualSense) {
        onWrite = [this](std::span<const uint8_t> report) {
            entered = true;
            slow.wait(true); // a device that takes its time
            const std::lock_guard lock(mutex);
            strong.push_back(report[4]);
            changed.notify_all();
        };
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
