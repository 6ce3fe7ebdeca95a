// The glove's firmware, as far as it is plain arithmetic, and the game's side of the same report.
#include "FakeBus.h"

#include "content/glove/GloveCore.h"
#include "input/haptics/HapticDevices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shoal::haptics {
namespace {

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
    const Report report = driver.sealed(frame, 9);
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

} // namespace
} // namespace shoal::haptics
