#include "input/haptics/HapticOutput.h"
#include "input/haptics/Rack.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>

namespace shoal::haptics {
namespace {

HapticFrame frameOf(float amplitude, float frequency_Hz) {
    HapticFrame frame;
    frame.actuators[3] = {amplitude, frequency_Hz};
    return frame;
}

TEST(Motors, SilenceIsExactlyZero) { EXPECT_EQ(motorsOf({}), Motors{}); }

TEST(Motors, LowGoesToTheStrongOneAndHighToTheWeak) {
    EXPECT_EQ(motorsOf(frameOf(1, 40)), (Motors{255, 0}));
    EXPECT_EQ(motorsOf(frameOf(1, 250)), (Motors{0, 255}));
    const Motors between = motorsOf(frameOf(1, 130)); // half way: each motor at half amplitude, 0.2 + 0.8 / 2
    EXPECT_EQ(between, (Motors{153, 153}));
}

TEST(Motors, NonsenseIsBounded) {
    EXPECT_EQ(motorsOf(frameOf(7, 40)).strong, 255);
    EXPECT_EQ(motorsOf(frameOf(std::nanf(""), 40)), Motors{});
}

TEST(Reports, AreWhatTheDevicesExpect) {
    const Report sense = encodeDualSenseUsb({0x80, 0x40});
    ASSERT_EQ(sense.size, 48u);
    EXPECT_EQ(sense.bytes[0], 0x02);
    EXPECT_EQ(sense.bytes[1], 0x03);
    EXPECT_EQ(sense.bytes[3], 0x40);
    EXPECT_EQ(sense.bytes[4], 0x80);
    const Report shock = encodeDualShock4Usb({0x80, 0x40});
    ASSERT_EQ(shock.size, 32u);
    EXPECT_EQ(shock.bytes[0], 0x05);
    EXPECT_EQ(shock.bytes[1], 0x01);
    EXPECT_EQ(shock.bytes[4], 0x40);
    EXPECT_EQ(shock.bytes[5], 0x80);
}

// A bus that notes what is done to it.
struct FakeBus {
    std::vector<HidInfo> plugged;
    std::vector<std::vector<uint8_t>> written;
    bool permitted = true, alive = true;
    int open = 0;

    HidBus bus() {
        return {[this] { return plugged; },
                [this](const std::string& path) -> Result<int> {
                    if (!permitted) return Error{path, "may not be opened"};
                    ++open;
                    return 0;
                },
                [this](int, std::span<const uint8_t> report) {
                    if (alive) written.emplace_back(report.begin(), report.end());
                    return alive;
                },
                [this](int) { --open; }};
    }
};

TEST(Rack, WritesChangesAtTheDevicesPaceAndRefreshes) {
    FakeBus fake;
    fake.plugged = {{"/dev/hidraw0", 0x054c, 0x0ce6}, {"/dev/hidraw1", 0x1234, 0x5678}};
    Rack rack(fake.bus());
    rack.step({}, 0);
    EXPECT_EQ(rack.ready(), 1u);
    EXPECT_TRUE(fake.written.empty()); // silence needs no telling
    rack.step(frameOf(1, 40), 0.1);
    ASSERT_EQ(fake.written.size(), 1u);
    EXPECT_EQ(fake.written[0][4], 255);
    rack.step(frameOf(0.5f, 40), 0.104); // too soon
    EXPECT_EQ(fake.written.size(), 1u);
    rack.step(frameOf(0.5f, 40), 0.109);
    EXPECT_EQ(fake.written.size(), 2u);
    rack.step(frameOf(0.5f, 40), 0.4); // nothing new
    EXPECT_EQ(fake.written.size(), 2u);
    rack.step(frameOf(0.5f, 40), 0.61); // still running: told again
    EXPECT_EQ(fake.written.size(), 3u);
    rack.step({}, 0.7);
    ASSERT_EQ(fake.written.size(), 4u);
    EXPECT_EQ(fake.written[3][4], 0);
    rack.step({}, 5);
    EXPECT_EQ(fake.written.size(), 4u); // silence is not repeated
}

TEST(Rack, DevicesComeAndGo) {
    FakeBus fake;
    Rack rack(fake.bus());
    rack.step(frameOf(1, 40), 0);
    EXPECT_EQ(rack.ready(), 0u);
    fake.plugged = {{"/dev/hidraw0", 0x054c, 0x09cc}};
    rack.step(frameOf(1, 40), 0.5); // not yet looked again
    EXPECT_EQ(rack.ready(), 0u);
    rack.step(frameOf(1, 40), 1.1);
    EXPECT_EQ(rack.ready(), 1u);
    fake.alive = false;
    rack.step({}, 1.2);
    EXPECT_EQ(rack.ready(), 0u);
    EXPECT_EQ(fake.open, 0);
    fake.alive = true;
    rack.step({}, 2.2);
    EXPECT_EQ(rack.ready(), 1u);
}

TEST(Rack, RefusedDevicesAreComplainedAboutOnce) {
    FakeBus fake;
    fake.plugged = {{"/dev/hidraw0", 0x054c, 0x0ce6}};
    fake.permitted = false;
    Rack rack(fake.bus());
    rack.step({}, 0);
    rack.step({}, 1.5);
    EXPECT_EQ(rack.takeComplaints().size(), 1u);
}

TEST(Rack, StopsTheMotorsAtTheEnd) {
    FakeBus fake;
    fake.plugged = {{"/dev/hidraw0", 0x054c, 0x0ce6}};
    {
        Rack rack(fake.bus());
        rack.step(frameOf(1, 40), 0);
    }
    ASSERT_EQ(fake.written.size(), 2u);
    EXPECT_EQ(fake.written[1][4], 0);
    EXPECT_EQ(fake.open, 0);
}

TEST(HapticOutput, TheNewestFrameReachesTheDevice) {
    auto strongest = std::make_shared<std::atomic<int>>(0);
    HidBus bus{[] {
                   return std::vector<HidInfo>{{"x", 0x054c, 0x0ce6}};
               },
               [](const std::string&) -> Result<int> { return 0; },
               [strongest](int, std::span<const uint8_t> report) {
                   strongest->store(report[4]);
                   strongest->notify_all();
                   return true;
               },
               [](int) {}};
    HapticOutput output(bus);
    output.submit(frameOf(1, 40));
    strongest->wait(0);
    EXPECT_EQ(strongest->load(), 255);
}

} // namespace
} // namespace shoal::haptics
