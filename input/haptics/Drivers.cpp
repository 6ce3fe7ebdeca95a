// Drivers of haptic devices, and the distribution of a frame to their motors.
#include "input/haptics/DeviceTable.h"
#include "input/haptics/GloveReport.h"

#include <algorithm>
#include <cmath>
#include <zlib.h>

namespace shoal::haptics {

static_assert(glove::kActuators == kActuatorCount);

constexpr float kLow_Hz = 60, kHigh_Hz = 200;
constexpr float kMinFelt = 0.2f; // share of a motor's range at which it starts

Motors motorsOf(std::span<const Actuation> actuations) {
    Motors motors;
    for (const Actuation& each : actuations) {
        const float quick = std::clamp((each.frequency_Hz - kLow_Hz) / (kHigh_Hz - kLow_Hz), 0.0f, 1.0f);
        motors.strong = std::max(motors.strong, each.amplitude * (1 - quick)); // this order drops NaN
        motors.weak = std::max(motors.weak, each.amplitude * quick);
    }
    return motors;
}

Motors motorsOf(const HapticFrame& frame) {
    const Motors hands = motorsOf(frame.actuators), body = motorsOf({&frame.body, 1});
    return {std::max(hands.strong, body.strong), std::max(hands.weak, body.weak)};
}

std::span<const Actuation> handOf(const HapticFrame& frame, int hand) {
    return std::span(frame.actuators)
        .subspan(static_cast<size_t>(hand) * kActuatorsPerHand, kActuatorsPerHand);
}

// Returns the strongest of a hand's actuations and the body's with a frequency from min_Hz to below limit_Hz;
// amplitude 0 if none.
static Actuation strongestOf(const HapticFrame& frame, int hand, float min_Hz = 0,
                             float limit_Hz = INFINITY) {
    Actuation best;
    const auto compare = [&](const Actuation& each) {
        if (each.frequency_Hz >= min_Hz && each.frequency_Hz < limit_Hz) best = stronger(best, each);
    };
    std::ranges::for_each(handOf(frame, hand), compare);
    compare(frame.body);
    return best;
}

float driveOf(float amplitude) {
    if (!(amplitude > 1.0f / 512)) return 0; // NaN too
    return kMinFelt + (1 - kMinFelt) * std::min(amplitude, 1.0f);
}

Actuation vibrationOf(const HapticFrame& frame, int hand) {
    Actuation strongest = strongestOf(frame, hand);
    strongest.amplitude = std::min(strongest.amplitude, 1.0f);
    return strongest;
}

bool VibrationTimer::due(const Actuation& now, double now_s) {
    constexpr float kAmplitudeStep = 0.04f, kFrequencyStep_Hz = 8; // smaller steps are not felt
    const bool on = now.amplitude > 0, was = sent_.amplitude > 0;
    const bool news =
        on != was || (on && (std::abs(now.amplitude - sent_.amplitude) > kAmplitudeStep ||
                             std::abs(now.frequency_Hz - sent_.frequency_Hz) > kFrequencyStep_Hz));
    if (!news && !(on && now_s - sent_s_ >= kVibrationAgain_s)) return false;
    sent_ = now;
    sent_s_ = now_s;
    return true;
}

static uint8_t scaled(float amplitude, float full) {
    return static_cast<uint8_t>(std::lround(driveOf(amplitude) * full));
}

// Adds the CRC-32 that Sony wants over Bluetooth, of the whole packet; 0xA2 is an output report's header.
static void addSonyChecksum(Report& report, uint8_t /*sequence*/) {
    constexpr uint8_t kHeader = 0xA2;
    constexpr size_t kAt = 74;
    uLong crc = crc32(0, &kHeader, 1);
    crc = crc32(crc, report.bytes.data(), kAt);
    for (size_t i = 0; i < 4; ++i) report.bytes[kAt + i] = static_cast<uint8_t>(crc >> (8 * i));
}

// Returns whether the newer bit enables vibration: from firmware 2.21 on, and on every DualSense Edge.
// Feature report 0x20 holds the firmware's version.
static bool hasNewVibration(const HidInfo& info, HidDevice& device) {
    constexpr uint16_t kEdge = 0x0df2, kFrom = 2 << 8 | 21;
    constexpr size_t kVersionAt = 44;
    if (info.product == kEdge) return true;
    std::array<uint8_t, 64> bytes{0x20};
    return device.readFeature(bytes) == bytes.size() &&
           (bytes[kVersionAt] | bytes[kVersionAt + 1] << 8) >= kFrom;
}

static void sealDualSenseBluetooth(Report& report, uint8_t sequence) {
    report.bytes[1] = static_cast<uint8_t>(sequence << 4);
    addSonyChecksum(report, sequence);
}

// Bytes: id; motors to enable (all four); left trigger, right trigger, strong and weak motor, in per cent; on
// for 2.55 s; no pause; repeats, so that it runs until the next report. Each trigger serves a hand's fingers.
static Report xbox(const HapticFrame& frame) {
    const Motors motors = motorsOf(frame);
    return {{0x03, 0x0F, scaled(motorsOf(handOf(frame, 0)).weak, 100),
             scaled(motorsOf(handOf(frame, 1)).weak, 100), scaled(motors.strong, 100),
             scaled(motors.weak, 100), 0xFF, 0, 0xEB},
            9};
}

// Appends the strengths of the strong and of the weak motor, 16 bits each, little-endian.
static Report withMotors16(Report report, const HapticFrame& frame) {
    const Motors motors = motorsOf(frame);
    for (const float amplitude : {motors.strong, motors.weak}) {
        const auto value = static_cast<uint16_t>(std::lround(driveOf(amplitude) * 65535));
        report.bytes[report.size++] = static_cast<uint8_t>(value);
        report.bytes[report.size++] = static_cast<uint8_t>(value >> 8);
    }
    return report;
}

static Report stadia(const HapticFrame& frame) { return withMotors16({{0x05}, 1}, frame); }
static Report forceFeedback(const HapticFrame& frame) { return withMotors16({}, frame); }

// Nintendo's controllers have a voice coil in each hand that plays two tones at a time.

constexpr float kHighFrom_Hz = 160; // least frequency of the high tone
constexpr int kSafeIndex = 100;     // the tables warn of damage beyond it

static int frequencyIndex(float frequency_Hz) {
    return static_cast<int>(std::lround(32 * std::log2(frequency_Hz / 10)));
}

// The first four bytes are for the left hand, the last for the right; a single Joy-Con takes its own half.
static Report tones(const HapticFrame& frame, size_t size) {
    Report report{.size = size};
    report.bytes[0] = 0x10;
    for (int hand = 0; hand < 2; ++hand) {
        const auto bytes = encodeSwitchTones(strongestOf(frame, hand, kHighFrom_Hz),
                                             strongestOf(frame, hand, 0, kHighFrom_Hz));
        std::ranges::copy(bytes, report.bytes.begin() + 2 + 4 * hand);
    }
    return report;
}

// Returns the report that enables vibration, which is off until then: subcommand 0x48.
static Report enable(size_t size) {
    Report report = tones({}, size);
    report.bytes[0] = 0x01; // a report with tones and a subcommand behind them
    report.bytes[10] = 0x48;
    report.bytes[11] = 0x01;
    return report;
}

static void sealSwitch(Report& report, uint8_t sequence) { report.bytes[1] = sequence & 0x0F; }

// Bytes of the fingertip glove: 0 (reports have no id), sequence, twelve amplitudes, twelve frequencies. The
// body's vibration, for which a glove has no actuator, goes to both palms.
static Report gloveReport(const HapticFrame& frame) {
    Report report{.size = 1 + glove::kReportBytes};
    for (size_t i = 0; i < kActuatorCount; ++i) {
        Actuation felt = frame.actuators[i];
        if (i % kActuatorsPerHand == hands::kPalmPart) felt = stronger(felt, frame.body);
        if (!(felt.amplitude > 0)) continue; // NaN too
        report.bytes[2 + i] = static_cast<uint8_t>(std::lround(std::min(felt.amplitude, 1.0f) * 255));
        report.bytes[2 + kActuatorCount + i] = static_cast<uint8_t>(
            std::lround(std::clamp(felt.frequency_Hz / static_cast<float>(glove::kHzPerStep), 1.0f, 255.0f)));
    }
    return report;
}

static void sealGlove(Report& report, uint8_t sequence) { report.bytes[1] = sequence; }

// Returns the encoder of a Sony controller. still: the report without vibration; at: place of its right
// motor, before the left one.
static auto sonyEncoder(const Report& still, size_t at) {
    return [=](const HapticFrame& frame) {
        const Motors motors = motorsOf(frame);
        Report report = still;
        report.bytes[at] = scaled(motors.weak, 255);
        report.bytes[at + 1] = scaled(motors.strong, 255);
        return report;
    };
}

// Bytes: id; over Bluetooth also sequence number and 0x10 (for the controller itself, not its audio); enable
// 1 (bit 0: vibration, bit 1: haptics instead of audio); enable 2; right motor; left motor. Enable 3 (bit 2:
// vibration with new firmware) lies 38 bytes after enable 1.
Driver makeDualSense(const HidInfo& info, HidDevice& device) {
    const bool bluetooth = info.transport == Transport::Bluetooth;
    Report still = bluetooth ? Report{{0x31, 0, 0x10}, 78} : Report{{0x02}, 48};
    const size_t at = bluetooth ? 3 : 1;
    still.bytes[at] = 0x03;
    if (hasNewVibration(info, device)) still.bytes[at] = 0x02, still.bytes[at + 38] = 0x04;
    return {sonyEncoder(still, at + 2), bluetooth ? sealDualSenseBluetooth : nullptr};
}

// Bytes: id; over Bluetooth also 0xC0 (HID report with a checksum) and an unused one; enable (bit 0: rumble);
// two unused; right motor; left motor. The light and its blinking are not enabled.
Driver makeDualShock4(const HidInfo& info, HidDevice&) {
    if (info.transport != Transport::Bluetooth) return {sonyEncoder({{0x05, 0x01}, 32}, 4)};
    return {sonyEncoder({{0x11, 0xC0, 0, 0x01}, 78}, 6), addSonyChecksum};
}

Driver makeXbox(const HidInfo&, HidDevice&) { return {.encode = xbox}; }
Driver makeStadia(const HidInfo&, HidDevice&) { return {.encode = stadia}; }
Driver makeForceFeedback(const HidInfo&, HidDevice&) { return {.encode = forceFeedback}; }

// The table's amplitudes grow by a constant factor in each of three ranges of the index: 2^(1/4) below 16,
// 2^(1/16) below 32, 2^(1/32) above; 119.6, 17.03 and 8.7 fit their entries to the last place.
int switchAmplitudeIndex(float amplitude) {
    if (!(amplitude > 0)) return 0; // NaN too
    const auto index = [&](float perOctave, float factor) {
        return static_cast<int>(std::lround(perOctave * std::log2(std::min(amplitude, 2.0f) * factor)));
    };
    if (amplitude >= 0.2274f) return std::min(index(32, 8.7f), kSafeIndex);
    if (amplitude >= 0.1150f) return index(16, 17.03f);
    return std::max(index(4, 119.6f), 1);
}

std::array<uint8_t, 4> encodeSwitchTones(const Actuation& high, const Actuation& low) {
    const int highIndex = switchAmplitudeIndex(high.amplitude),
              lowIndex = switchAmplitudeIndex(low.amplitude);
    const float high_Hz = highIndex > 0 ? high.frequency_Hz : 320,
                low_Hz = lowIndex > 0 ? low.frequency_Hz : 160;
    const int highTone = 4 * (std::clamp(frequencyIndex(high_Hz), 0x61, 0xDF) - 0x60); // 0x004 to 0x1FC
    const int lowTone = std::clamp(frequencyIndex(low_Hz), 0x41, 0xBF) - 0x40;         // 0x01 to 0x7F
    // High tone: nine bits of frequency and seven of amplitude. Low tone: seven bits of frequency, and the
    // amplitude with its last bit before the others.
    return {static_cast<uint8_t>(highTone), static_cast<uint8_t>(2 * highIndex + (highTone >> 8)),
            static_cast<uint8_t>(lowTone + (lowIndex % 2 ? 0x80 : 0)),
            static_cast<uint8_t>(0x40 + lowIndex / 2)};
}

Driver makeSwitch(const HidInfo& info, HidDevice&) {
    const size_t size = info.transport == Transport::Bluetooth ? 49 : 64;
    return {.encode = [=](const HapticFrame& frame) { return tones(frame, size); },
            .seal = sealSwitch,
            .initialReports = {enable(size)}};
}

Driver makeGlove(const HidInfo&, HidDevice&) { return {.encode = gloveReport, .seal = sealGlove}; }

} // namespace shoal::haptics
