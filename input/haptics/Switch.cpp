// Driver of Nintendo's controllers: a voice coil in each hand that plays two tones at a time.
#include "input/haptics/DeviceTable.h"
#include "input/haptics/HapticFrame.h"

#include <algorithm>
#include <cmath>

namespace shoal::haptics {

namespace {

constexpr float kHighFrom_Hz = 160; // least frequency of the high tone
constexpr int kSafeIndex = 100;     // the tables warn of damage beyond it

int frequencyIndex(float frequency_Hz) {
    return static_cast<int>(std::lround(32 * std::log2(frequency_Hz / 10)));
}

// The first four bytes are for the left hand, the last for the right; a single Joy-Con takes its own half.
Report tones(const HapticFrame& frame, size_t size) {
    Report report{.size = size};
    report.bytes[0] = 0x10;
    for (int hand = 0; hand < 2; ++hand) {
        std::array<Actuation, kActuatorsPerHand + 1> felt; // the hand, and the body in both
        const auto fingers = handOf(frame, hand);
        std::copy(fingers.begin(), fingers.end(), felt.begin());
        felt.back() = frame.body;
        const auto bytes =
            encodeSwitchTones(strongestOf(felt, kHighFrom_Hz), strongestOf(felt, 0, kHighFrom_Hz));
        std::copy(bytes.begin(), bytes.end(), report.bytes.begin() + 2 + 4 * hand);
    }
    return report;
}

// Returns the report that enables vibration, which is off until then: subcommand 0x48.
Report enable(size_t size) {
    Report report = tones({}, size);
    report.bytes[0] = 0x01; // a report with tones and a subcommand behind them
    report.bytes[10] = 0x48;
    report.bytes[11] = 0x01;
    return report;
}

void sealSwitch(Report& report, uint8_t sequence) { report.bytes[1] = sequence & 0x0F; }

} // namespace

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

Driver makeSwitch(const DeviceContext& device) {
    const size_t size = device.bluetooth ? 49 : 64;
    return {.encode = [=](const HapticFrame& frame) { return tones(frame, size); },
            .seal = sealSwitch,
            .initialReports = {enable(size)}};
}

} // namespace shoal::haptics
