// Tests of the table of devices and of the drivers' arithmetic. reports.txt has the bytes of whole reports.
#include "FakeBus.h"
#include "content/glove/GloveCore.h"
#include "engine/core/Files.h"
#include "input/haptics/HapticDevices.h"
#include "tests/Test.h"

namespace shoal::haptics {
namespace {

Driver driverNamed(const std::string& name, Transport transport) {
    for (const DeviceRow& row : kDevices)
        if (row.name == name) return driverOf(row, transport);
    ADD_FAILURE() << "no " << name;
    return {};
}

TEST(Motors, LowGoesToTheStrongOneAndHighToTheWeak) {
    const Motors low = motorsOf(frameOf(1, 40)), high = motorsOf(frameOf(1, 250)),
                 between = motorsOf(frameOf(1, 130));
    EXPECT_EQ(low.strong, 1);
    EXPECT_EQ(low.weak, 0);
    EXPECT_EQ(high.strong, 0);
    EXPECT_EQ(high.weak, 1);
    EXPECT_FLOAT_EQ(between.strong, 0.5f); // half way from 60 to 200 Hz
    EXPECT_FLOAT_EQ(between.weak, 0.5f);
}

TEST(Motors, ManyFingersAreNotOneBlow) {
    HapticFrame frame;
    for (Actuation& actuation : frame.actuators) actuation = {0.3f, 40};
    EXPECT_FLOAT_EQ(motorsOf(frame).strong, 0.3f);
    frame.body = {0.7f, 40};
    EXPECT_FLOAT_EQ(motorsOf(frame).strong, 0.7f);
}

TEST(Motors, AreDrivenAboveWhatCanBeFelt) {
    EXPECT_EQ(driveOf(0), 0);
    EXPECT_FLOAT_EQ(driveOf(1), 1);
    EXPECT_FLOAT_EQ(driveOf(0.5f), 0.6f); // 0.2 + 0.8 / 2
    EXPECT_EQ(driveOf(7), 1);
    EXPECT_EQ(driveOf(-1), 0);
    EXPECT_EQ(driveOf(std::nanf("")), 0);
}

// Frames with invalid numbers must reach a motor only as bounded strength.
TEST(Devices, NonsenseIsBounded) {
    const float inf = std::numeric_limits<float>::infinity();
    for (const DeviceRow& row : kDevices)
        for (const Transport transport : {Transport::Usb, Transport::Bluetooth}) {
            const Driver driver = driverOf(row, transport);
            EXPECT_EQ(driver.encode(frameOf(std::nanf(""), 40)), driver.encode({})) << row.name;
            EXPECT_EQ(driver.encode(frameOf(inf, 40)), driver.encode(frameOf(1, 40))) << row.name;
            EXPECT_EQ(driver.encode(frameOf(-3, 40)), driver.encode({})) << row.name;
            EXPECT_NE(driver.encode(frameOf(1, 1e9f)), driver.encode({})) << row.name;
            EXPECT_NE(driver.encode(frameOf(1, 40)), driver.encode({})) << row.name;
            EXPECT_NE(driver.encode(frameOf(1, 0)), driver.encode({})) << row.name;
        }
}

// The known packets: all other bytes 0.
TEST(Sony, ChecksumsAreAsRecorded) {
    const auto checksum = [](const char* name, const std::map<int, uint8_t>& bytes) {
        Report report{.size = 78};
        for (const auto& [at, byte] : bytes) report.bytes[at] = byte;
        driverNamed(name, Transport::Bluetooth).seal(report, 0);
        return std::vector<uint8_t>(report.bytes.begin() + 74, report.bytes.end());
    };
    EXPECT_THAT(checksum("DualSense", {{0, 0x31}, {2, 0x10}, {3, 0x03}, {5, 0x40}, {6, 0x40}}),
                testing::ElementsAre(0xf2, 0xf8, 0x89, 0x41));
    EXPECT_THAT(checksum("DualShock 4", {{0, 0x11}, {1, 0xC0}, {3, 0x01}, {6, 0x40}, {7, 0x80}}),
                testing::ElementsAre(0x34, 0xd9, 0x31, 0x0a));
}

TEST(Switch, AmplitudesAreThoseOfTheTable) {
    // Number and amplitude: ends and joints of the table's three ranges.
    const std::pair<int, float> rows[] = {
        {0, 0.0f},       {1, 0.007843f},  {2, 0.011823f},  {3, 0.014061f},  {8, 0.033442f},  {14, 0.094592f},
        {15, 0.112491f}, {16, 0.117471f}, {17, 0.122671f}, {30, 0.215442f}, {31, 0.224982f}, {32, 0.229908f},
        {33, 0.234943f}, {50, 0.339534f}, {64, 0.459817f}, {99, 0.981378f}, {100, 1.002867f}};
    for (const auto& [index, amplitude] : rows)
        EXPECT_EQ(switchAmplitudeIndex(amplitude), index) << amplitude;
    EXPECT_EQ(switchAmplitudeIndex(1.8f), 100); // beyond the coil is in danger
    int before = 0;
    for (float amplitude = 0; amplitude <= 1; amplitude += 0.001f) {
        EXPECT_GE(switchAmplitudeIndex(amplitude), before);
        before = switchAmplitudeIndex(amplitude);
    }
}

TEST(Switch, TonesAreThoseOfTheTable) {
    using Bytes = std::array<uint8_t, 4>;
    const Actuation none;
    EXPECT_EQ(encodeSwitchTones(none, none), (Bytes{0x00, 0x01, 0x40, 0x40})); // the neutral one
    // 320 Hz 00 01, 160 Hz 40; 0.501 is 88 and 00 62, 0.512 is 8a and 80 62.
    EXPECT_EQ(encodeSwitchTones({0.501433f, 320}, none), (Bytes{0x00, 0x89, 0x40, 0x40}));
    EXPECT_EQ(encodeSwitchTones(none, {0.501433f, 160}), (Bytes{0x00, 0x01, 0x40, 0x62}));
    EXPECT_EQ(encodeSwitchTones(none, {0.512413f, 160}), (Bytes{0x00, 0x01, 0xC0, 0x62}));
    EXPECT_EQ(encodeSwitchTones({0.501433f, 795}, none), (Bytes{0xA8, 0x89, 0x40, 0x40})); // a8 01
    EXPECT_EQ(encodeSwitchTones({0.501433f, 82}, none), (Bytes{0x04, 0x88, 0x40, 0x40}));
    EXPECT_EQ(encodeSwitchTones({0.501433f, 9000}, none), (Bytes{0xFC, 0x89, 0x40, 0x40})); // the last
    EXPECT_EQ(encodeSwitchTones(none, {0.501433f, 5}), (Bytes{0x00, 0x01, 0x01, 0x62}));    // the first
}

TEST(Switch, TheBodyIsFeltInBothHands) {
    const Report report = driverNamed("Switch Pro Controller", Transport::Usb).encode({.body = {1, 41}});
    EXPECT_EQ(report.bytes[5], 0x72);
    EXPECT_EQ(report.bytes[9], 0x72);
}

TEST(Devices, EachIsThereOnce) {
    std::set<std::tuple<uint16_t, uint16_t, Transport>> seen;
    for (const DeviceRow& row : kDevices) {
        EXPECT_NE(row.vendor, kNoVendor) << row.name;
        EXPECT_TRUE(seen.insert({row.vendor, row.product, row.transport}).second) << row.name;
    }
}

TEST(Devices, EachHasItsRule) {
    const auto rules = tests::valueOf(readText(dataRoot() / "content/udev/70-shoal-haptics.rules"));
    for (const DeviceRow& row : kDevices) {
        char rule[120];
        std::snprintf(rule, sizeof rule,
                      "\nKERNEL==\"hidraw*\", KERNELS==\"*:%04X:%04X.*\", TAG+=\"uaccess\"\n", row.vendor,
                      row.product);
        EXPECT_NE(rules.find(rule), std::string::npos) << row.name << rule;
    }
}

TEST(Devices, EachIsDocumented) {
    const auto text = readText(dataRoot() / "input" / "README.md");
    if (!text) GTEST_SKIP() << "installed without sources";
    for (const DeviceRow& row : kDevices) EXPECT_NE(text->find(row.name), std::string::npos) << row.name;
    EXPECT_NE(text->find(kGlove.name), std::string::npos);
}

TEST(Devices, AnXboxControllerOnACableIsTheKernelsAlone) {
    EXPECT_FALSE(recognise({"x", 0x045e, 0x0b13, Transport::Usb, ""}));
    EXPECT_TRUE(recognise({"x", 0x045e, 0x0b13, Transport::Bluetooth, ""}));
}

// The glove's firmware, as far as it is plain arithmetic, and the game's side of the same report.

std::array<uint8_t, glove::kReportBytes> reportOf(uint8_t sequence, uint8_t amplitude) {
    std::array<uint8_t, glove::kReportBytes> report{sequence};
    report[1 + 4] = amplitude;
    report[1 + glove::kActuators + 4] = 50;
    return report;
}

bool hear(glove::State& state, uint8_t sequence, uint8_t amplitude, uint32_t now_ms) {
    const auto report = reportOf(sequence, amplitude);
    return glove::receive(state, report.data(), report.size(), now_ms);
}

TEST(Glove, UnderstandsWhatTheGameSends) {
    HapticFrame frame;
    frame.actuators[0] = {1, 40};
    frame.actuators[7] = {0.5f, 250};
    frame.body = {0.25f, 60};
    const Driver driver = driverOf(kGlove, Transport::Usb);
    const Report report = driver.sealed(driver.encode(frame), 9);
    ASSERT_EQ(report.bytes[0], 0); // hidapi's word for a report without a number; it is not sent
    glove::State state;
    ASSERT_TRUE(glove::receive(state, report.bytes.data() + 1, report.size - 1, 5));
    EXPECT_EQ(state.sequence, 9);
    for (int i = 0; i < glove::kActuators; ++i) {
        const int expected = i == 0 ? 255 : i == 7 ? 128 : i % 6 == hands::kPalmPart ? 64 : 0;
        EXPECT_EQ(state.amplitude[i], expected) << i;
    }
    EXPECT_EQ(state.frequency[0], 20);
    EXPECT_EQ(state.frequency[7], 125);
    EXPECT_EQ(state.frequency[5], 30);
}

HidInfo gloveInfo() {
    return {.path = "g", .vendor = kNoVendor, .usagePage = glove::kUsagePage, .usage = glove::kUsage};
}

TEST(Glove, IsRecognisedByItsUsageWhoeverBuiltIt) {
    EXPECT_EQ(recognise(gloveInfo()), &kGlove);
    HidInfo other = gloveInfo();
    ++other.usagePage; // another vendor's
    EXPECT_FALSE(recognise(other));
}

TEST(Glove, StopsAfterATenthOfASecondOfSilence) {
    glove::State state;
    ASSERT_TRUE(hear(state, 1, 200, 1000));
    glove::watch(state, 1099);
    EXPECT_EQ(state.amplitude[4], 200);
    glove::watch(state, 1100);
    EXPECT_EQ(state.amplitude[4], 0);
    // And where the clock wraps.
    ASSERT_TRUE(hear(state, 2, 200, 0xFFFFFFF0u));
    glove::watch(state, 0x00000010u); // 32 ms later
    EXPECT_EQ(state.amplitude[4], 200);
    glove::watch(state, 0x00000060u);
    EXPECT_EQ(state.amplitude[4], 0);
}

TEST(Glove, TheGameSpeaksOftenEnoughForTheWatchdog) {
    FakeBus fake;
    fake.plugged.push_back({gloveInfo(), {}});
    HapticDevices hapticDevices(fake.bus());
    glove::State state;
    size_t had = 0;
    for (uint32_t ms = 0; ms < 2000; ms += 10) { // a frame that never changes
        hapticDevices.step(frameOf(0.5f, 100, 4), ms * 1e-3);
        for (; had < fake.written["g"].size(); ++had)
            ASSERT_TRUE(glove::receive(state, fake.written["g"][had].data() + 1, glove::kReportBytes, ms));
        glove::watch(state, ms);
        ASSERT_GT(state.amplitude[4], 0) << ms;
    }
    EXPECT_LE(had, 2000u / 40 + 1); // yet no more than needed
}

TEST(Glove, OldReportsAndForeignOnesAreIgnored) {
    glove::State state;
    ASSERT_TRUE(hear(state, 250, 100, 0));
    EXPECT_FALSE(hear(state, 250, 50, 1)); // the same again
    EXPECT_FALSE(hear(state, 249, 50, 1)); // overtaken
    EXPECT_TRUE(hear(state, 3, 50, 2));    // it wraps
    EXPECT_FALSE(hear(state, 200, 70, 3));
    EXPECT_EQ(state.amplitude[4], 50);
    EXPECT_TRUE(hear(state, 0, 0, 4)); // silence is always obeyed
    EXPECT_EQ(state.amplitude[4], 0);
    EXPECT_TRUE(hear(state, 200, 70, 200)); // a host that started anew
    const auto report = reportOf(201, 90);
    EXPECT_FALSE(glove::receive(state, report.data(), report.size() - 1, 201));
    EXPECT_FALSE(glove::receive(state, report.data(), 0, 201));
    EXPECT_EQ(state.amplitude[4], 70);
}

TEST(Glove, AnActuatorSwingsAsOftenAndAsFarAsTold) {
    glove::State state;
    ASSERT_TRUE(hear(state, 1, 200, 0)); // finger 4, 100 Hz
    int starts = 0, maximum = 0, before = 0;
    double sum = 0;
    for (uint32_t i = 0; i < glove::kSampleRate_Hz; ++i) {
        const int now = glove::nextSample(state, 4);
        starts += before < 100 && now >= 100;
        maximum = std::max(maximum, now);
        sum += now;
        before = now;
        ASSERT_EQ(glove::nextSample(state, 3), 0);
    }
    EXPECT_NEAR(starts, 100, 1); // steps of 65536 / 10000 are cut to whole ones: below 1 %
    EXPECT_EQ(maximum, 200);
    EXPECT_NEAR(sum / glove::kSampleRate_Hz, 100, 1); // sin^2 is half on average
    for (int i = 0; i < 64; ++i)
        EXPECT_NEAR(glove::kWave[i], 255 * std::pow(std::sin(std::numbers::pi * i / 64), 2), 0.51) << i;
}

TEST(Vibration, TheStrongestFingerOfEachHandCounts) {
    HapticFrame frame;
    frame.actuators[1] = {0.3f, 140};
    frame.actuators[hands::kPalmPart] = {0.8f, 40};
    frame.actuators[kActuatorsPerHand + 2] = {0.5f, 250};
    EXPECT_EQ(vibrationOf(frame, 0).amplitude, 0.8f);
    EXPECT_EQ(vibrationOf(frame, 0).frequency_Hz, 40);
    EXPECT_EQ(vibrationOf(frame, 1).amplitude, 0.5f);
    EXPECT_EQ(vibrationOf(frame, 1).frequency_Hz, 250);
    EXPECT_EQ(vibrationOf({}, 0).amplitude, 0);
}

TEST(Vibration, NoNumberIsNothingAndTooMuchIsAll) {
    HapticFrame frame;
    frame.actuators[0].amplitude = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(vibrationOf(frame, 0).amplitude, 0);
    frame.actuators[1].amplitude = 7;
    EXPECT_EQ(vibrationOf(frame, 0).amplitude, 1);
}

TEST(Vibration, NewsAtOnceTheSameAgainInTimeSilenceOnce) {
    VibrationTimer timer;
    EXPECT_FALSE(timer.due({0, 0}, 0)); // silent, and was
    EXPECT_TRUE(timer.due({0.5f, 100}, 0.010));
    EXPECT_FALSE(timer.due({0.51f, 100}, 0.020)); // not felt
    EXPECT_TRUE(timer.due({0.7f, 100}, 0.030));
    EXPECT_TRUE(timer.due({0.7f, 200}, 0.040));
    EXPECT_FALSE(timer.due({0.7f, 200}, 0.080));
    EXPECT_TRUE(timer.due({0.7f, 200}, 0.041 + kVibrationAgain_s));
    EXPECT_TRUE(timer.due({0, 0}, 0.095));
    EXPECT_FALSE(timer.due({0, 0}, 9));
}

} // namespace
} // namespace shoal::haptics
