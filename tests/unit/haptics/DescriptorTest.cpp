// Report descriptors, and the simple haptic controllers found in them.
#include "FakeBus.h"

#include "engine/core/Random.h"
#include "input/haptics/HapticDevices.h"

#include <gtest/gtest.h>

namespace shoal::haptics {
namespace {

// A pen with a haptic collection: feature report 11 lists three waveforms (ordinals 3 to 5) of 16 bits, then
// three durations; output report 12 has a trigger of 4 bits, 4 bits of padding, an intensity of 1 to 200,
// repeats, cutoff.
const std::vector<uint8_t> kPen = {
    0x05, 0x0D, 0x09, 0x02, 0xA1, 0x01,             // digitizers, pen, application
    0x85, 0x01, 0x09, 0x42, 0x15, 0x00, 0x25, 0x01, // an input of its own
    0x75, 0x01, 0x95, 0x01, 0x81, 0x02, 0x95, 0x07, 0x81, 0x03, 0x05, 0x0E,
    0x09, 0x01, 0xA1, 0x02, 0x85, 0x11,                                     // simple haptic controller
    0x09, 0x10, 0xA1, 0x02, 0x05, 0x0A, 0x19, 0x03, 0x29, 0x05, 0x75, 0x10, // waveform list
    0x95, 0x03, 0xB1, 0x02, 0xC0, 0x0B, 0x11, 0x00, 0x0E, 0x00, 0xA1, 0x02, // duration list, named in full
    0x19, 0x03, 0x29, 0x05, 0xB1, 0x02, 0xC0, 0x85, 0x12, 0x05, 0x0E, 0x09, // trigger
    0x21, 0x25, 0x05, 0x75, 0x04, 0x95, 0x01, 0x91, 0x02, 0x91, 0x03, 0x75, // padding
    0x08, 0x09, 0x23, 0x15, 0x01, 0x26, 0xC8, 0x00, 0x91, 0x02, 0x09, 0x24, // intensity, repeats
    0x15, 0x00, 0x25, 0x07, 0x91, 0x02, 0x09, 0x28, 0x26, 0xFF, 0x00, 0x91, // cutoff
    0x02, 0xC0, 0xC0};

std::vector<uint8_t> listOf(std::array<uint16_t, 3> waveforms, uint16_t duration_ms) {
    std::vector<uint8_t> report{0x11};
    const auto put = [&](uint16_t value) {
        report.push_back(static_cast<uint8_t>(value));
        report.push_back(static_cast<uint8_t>(value >> 8));
    };
    for (const uint16_t waveform : waveforms) put(waveform);
    for (int i = 0; i < 3; ++i) put(duration_ms);
    return report;
}

std::optional<SimpleHaptic> penWith(const std::vector<uint8_t>& feature) {
    return findSimpleHaptic(readReportDescriptor(kPen), [&](std::span<uint8_t> report) {
        if (feature.empty() || report[0] != feature[0]) return size_t{0};
        std::copy_n(feature.begin(), std::min(feature.size(), report.size()), report.begin());
        return std::min(feature.size(), report.size());
    });
}

TEST(ReportDescriptor, TellsWhereThingsLie) {
    const ReportLayout layout = readReportDescriptor(kPen);
    EXPECT_EQ(layout.bytes(ReportKind::Input, 1), 1u);
    EXPECT_EQ(layout.bytes(ReportKind::Feature, 0x11), 12u);
    EXPECT_EQ(layout.bytes(ReportKind::Output, 0x12), 4u);
    ASSERT_EQ(layout.fields.size(), 11u);
    const ReportField& intensity = layout.fields[8];
    EXPECT_EQ(intensity.usage, usage(0x0E, 0x23));
    EXPECT_EQ(intensity.firstBit, 8u);
    EXPECT_EQ(intensity.logicalMin, 1);
    EXPECT_EQ(intensity.logicalMax, 200);
    EXPECT_TRUE(intensity.isWithin(usage(0x0D, 0x02)));
    EXPECT_TRUE(layout.fields[5].isWithin(usage(0x0E, 0x11)));
    EXPECT_FALSE(layout.fields[5].isWithin(usage(0x0E, 0x10)));
}

TEST(ReportDescriptor, FieldsAreReadBackAcrossBytes) {
    ReportField field{.firstBit = 5, .bits = 11};
    std::array<uint8_t, 3> bytes = {0xFF, 0xFF, 0xFF};
    setField(field, 0x2A5, bytes);
    EXPECT_EQ(getField(field, bytes), 0x2A5u);
    EXPECT_EQ(bytes[0] & 0x1F, 0x1F); // its neighbours are as they were
    EXPECT_EQ(bytes[2], 0xFF);
    field.firstBit = 20; // half beyond the end
    setField(field, 0x7FF, bytes);
    EXPECT_EQ(getField(field, bytes), 0xFu);
}

TEST(ReportDescriptor, PushedStateComesBack) {
    const ReportLayout layout = readReportDescriptor(std::array<uint8_t, 22>{
        0x05, 0x0E, 0x75, 0x08, 0x95, 0x01, 0xA4, 0x75, 0x20, 0x85, 0x07, 0xB4, // push, another, pop
        0xFE, 0x02, 0x00, 0x99, 0x99,                                           // a long item is passed over
        0x09, 0x21, 0x91, 0x02, 0xC0});
    EXPECT_EQ(layout.bytes(ReportKind::Output, 0), 1u);
    ASSERT_EQ(layout.fields.size(), 1u);
    EXPECT_EQ(layout.fields[0].usage, usage(0x0E, 0x21));
}

// Up to the last usage that there can be: counting on would begin at 0 again.
TEST(ReportDescriptor, ARangeThatEndsWithTheNumbersEnds) {
    const std::array<uint8_t, 22> bytes = {0x1b, 0xf0, 0xff, 0xff, 0xff, 0x2b, 0xff, 0xff, 0xff, 0xff, 0x75,
                                           0x01, 0x95, 0x10, 0x81, 0x02, 0x75, 0x01, 0x95, 0x01, 0x81, 0x03};
    const ReportLayout layout = readReportDescriptor(bytes);
    ASSERT_EQ(layout.fields.size(), 16u);
    EXPECT_EQ(layout.fields.back().usage, 0xffffffffu);
    EXPECT_EQ(layout.bytes(ReportKind::Input, 0), 3u);
}

// Whatever a device says: no crash, no hang, no memory beyond the bounds (the sanitizers watch).
TEST(ReportDescriptor, AnyBytesWillDo) {
    Random random(7);
    const auto byte = [&](size_t limit) {
        return static_cast<size_t>(random.between(0, static_cast<float>(limit)));
    };
    for (int i = 0; i < 20000; ++i) {
        std::vector<uint8_t> bytes = kPen;
        for (size_t k = 0; k < 1 + byte(8); ++k)
            bytes[std::min(byte(bytes.size()), bytes.size() - 1)] = static_cast<uint8_t>(byte(256));
        if (i % 4 == 0) bytes.resize(byte(bytes.size()));
        const ReportLayout layout = readReportDescriptor(bytes);
        EXPECT_LE(layout.fields.size(), 1024u);
        const auto found = findSimpleHaptic(layout, [&](std::span<uint8_t> report) {
            EXPECT_LE(report.size(), 4097u);
            for (uint8_t& each : report.subspan(1)) each = static_cast<uint8_t>(byte(256));
            return report.size();
        });
        if (found) {
            EXPECT_LE(found->encode(frameOf(0.5f, 40)).size, kMaxReportBytes);
        }
        isGlove(layout);
    }
}

TEST(SimpleHaptic, PicksTheBestOfItsList) {
    auto all = penWith(listOf({0x1003, 0x1005, 0x1004}, 0)); // click, rumble, buzz
    ASSERT_TRUE(all);
    EXPECT_EQ(all->slow.ordinal, 4);
    EXPECT_EQ(all->quick.ordinal, 5);
    EXPECT_FALSE(all->oneShot());
    auto buzzOnly = penWith(listOf({0x1004, 0x1003, 0x2001}, 0)); // one is the maker's own
    ASSERT_TRUE(buzzOnly);
    EXPECT_EQ(buzzOnly->slow.ordinal, 3);
    EXPECT_EQ(buzzOnly->quick.ordinal, 3);
    auto strokes = penWith(listOf({0x1006, 0x1007, 0x1003}, 0)); // press, release, click
    ASSERT_TRUE(strokes);
    EXPECT_EQ(strokes->slow.ordinal, 5);
    EXPECT_TRUE(strokes->oneShot());
    EXPECT_FALSE(penWith(listOf({0x1001, 0x1002, 0x2001}, 0))); // nothing, stop, the maker's own
    EXPECT_FALSE(penWith({}));                                  // does not answer
    EXPECT_FALSE(penWith({0x11}));                              // answers nothing
}

TEST(SimpleHaptic, SaysItWithTheFieldsItHas) {
    const auto pen = penWith(listOf({0x1003, 0x1005, 0x1004}, 0));
    ASSERT_TRUE(pen);
    const auto bytes = [](const Report& report) {
        return std::vector<uint8_t>(report.view().begin(), report.view().end());
    };
    EXPECT_EQ(bytes(pen->encode(frameOf(1, 40))), (std::vector<uint8_t>{0x12, 0x04, 200, 0, 255}));
    EXPECT_EQ(bytes(pen->encode(frameOf(0.5f, 250))),
              (std::vector<uint8_t>{0x12, 0x05, 101, 0, 255})); // 1 + 199 / 2
    EXPECT_EQ(bytes(pen->encode({})), (std::vector<uint8_t>{0x12, 0x02, 0, 0, 0}));
}

struct Plugged {
    FakeBus fake;
    explicit Plugged(std::vector<uint8_t> feature) {
        fake.plugged.push_back({{"pen", 0x1234, 0x5678, Transport::Usb, "A pen"}, kPen, std::move(feature)});
    }
};

TEST(SimpleHaptic, WhatSoundsForATimeIsRenewedBeforeItEnds) {
    Plugged pen(listOf({0x1003, 0x1005, 0x1004}, 200));
    HapticDevices hapticDevices(pen.fake.bus());
    EXPECT_NEAR(hapticDevices.step(frameOf(1, 40), 0), 0.1, 1e-6);
    hapticDevices.step(frameOf(1, 40), 0.1);
    EXPECT_EQ(pen.fake.written["pen"].size(), 2u);
    EXPECT_EQ(hapticDevices.list().at(0).name, "A pen on USB");
}

TEST(SimpleHaptic, WhatCanOnlyBeStruckIsStruckWhenATouchBegins) {
    Plugged pen(listOf({0x1003, 0x1006, 0x1007}, 10));
    HapticDevices hapticDevices(pen.fake.bus());
    const auto& written = pen.fake.written["pen"];
    double now_s = 0;
    const auto feel = [&](float amplitude) { hapticDevices.step(frameOf(amplitude, 160), now_s += 0.03); };
    for (const float amplitude : {0.8f, 0.6f, 0.4f, 0.2f, 0.0f, 0.0f}) feel(amplitude); // a touch fades away
    EXPECT_EQ(written.size(), 1u);
    for (const float amplitude : {0.3f, 0.25f, 0.7f, 0.5f}) feel(amplitude); // two more
    EXPECT_EQ(written.size(), 3u);
    EXPECT_TRUE(hapticDevices.allStopped());
}

TEST(SimpleHaptic, OneWithoutWaveformsIsComplainedAbout) {
    Plugged pen({});
    HapticDevices hapticDevices(pen.fake.bus());
    hapticDevices.step({}, 0);
    ASSERT_EQ(hapticDevices.takeWarnings().size(), 1u);
    EXPECT_EQ(pen.fake.opened(), 0u);
}

} // namespace
} // namespace shoal::haptics
