// The glove, apart from its hardware: the watchdog, the wave each actuator follows. Plain C++17 without a
// library, so that the same lines run on the microcontroller and in the game's tests. GLOVE.md is the
// specification.
#pragma once

#include "../../input/haptics/GloveReport.h"

namespace glove {

constexpr uint16_t kVendor = 0x1209, kProduct = 0x0001; // pid.codes, "for testing": a maker takes an own one
constexpr uint32_t kSilence_ms = 100;                   // without a report all actuators stop
constexpr uint32_t kSampleRate_Hz = 10000;

// One output report without a number, all bytes plain.
constexpr uint8_t kReportDescriptor[] = {0x06, 0x48,         0xFF, // usage page: kUsagePage
                                         0x09, kUsage,             // usage
                                         0xA1, 0x01,               // collection: application
                                         0x15, 0x00,               //   logical minimum 0
                                         0x26, 0xFF,         0x00, //   logical maximum 255
                                         0x75, 0x08,               //   8 bits
                                         0x95, kReportBytes, 0x09,
                                         0x02, 0x91,         0x02, // each: output, data, variable, absolute
                                         0xC0};

struct State {
    uint8_t amplitude[kActuators] = {}; // 0 to 255
    uint8_t frequency[kActuators] = {}; // times kHzPerStep Hz
    uint8_t sequence = 0;
    bool heard = false; // a report within the last kSilence_ms
    uint32_t heard_ms = 0;
    uint16_t phase[kActuators] = {}; // of a turn, 0 to 65535
};

inline void stop(State& state) {
    for (uint8_t& amplitude : state.amplitude) amplitude = 0;
}

// A report, as the host sent it. now_ms: any clock that rises, and wraps at 2^32. A report of another length
// is ignored. So is one that is not newer than the last (its sequence number, which wraps at 256, is not 1 to
// 127 ahead), unless nothing was heard for kSilence_ms: then the host has started anew. Silence, all
// amplitudes 0, is obeyed whatever its number: whoever says stop is right.
inline bool receive(State& state, const uint8_t* bytes, size_t size, uint32_t now_ms) {
    if (size != kReportBytes) return false;
    bool silent = true;
    for (int i = 0; i < kActuators; ++i) silent = silent && bytes[1 + i] == 0;
    const auto ahead = static_cast<uint8_t>(bytes[0] - state.sequence);
    const bool fresh = state.heard && now_ms - state.heard_ms < kSilence_ms;
    if (fresh && !silent && (ahead == 0 || ahead > 127)) return false;
    for (int i = 0; i < kActuators; ++i) {
        state.amplitude[i] = bytes[1 + i];
        state.frequency[i] = bytes[1 + kActuators + i];
    }
    state.sequence = bytes[0];
    state.heard = true;
    state.heard_ms = now_ms;
    return true;
}

// Call at least every few milliseconds.
inline void watch(State& state, uint32_t now_ms) {
    if (!state.heard || now_ms - state.heard_ms < kSilence_ms) return;
    state.heard = false;
    stop(state);
}

// Half a wave of 64 samples, 0 to 255: sin^2, so that it starts and ends without a step.
constexpr uint8_t kWave[64] = {0,   1,   2,   5,   10,  15,  21,  29,  37,  47,  57,  67,  79,  90,  103, 115,
                               128, 140, 152, 165, 176, 188, 198, 208, 218, 226, 234, 240, 245, 250, 253, 254,
                               255, 254, 253, 250, 245, 240, 234, 226, 218, 208, 198, 188, 176, 165, 152, 140,
                               128, 115, 103, 90,  79,  67,  57,  47,  37,  29,  21,  15,  10,  5,   2,   1};

// What an actuator's transistor is driven by for the next sample, 0 to 255. One transistor pushes one way
// only, so the wave stands on zero and swings as often as the actuator shall.
inline uint8_t nextSample(State& state, int actuator) {
    const uint32_t step = state.frequency[actuator] * kHzPerStep * 65536u / kSampleRate_Hz;
    state.phase[actuator] = static_cast<uint16_t>(state.phase[actuator] + step);
    const uint32_t wave = kWave[state.phase[actuator] >> 10];
    return static_cast<uint8_t>(wave * state.amplitude[actuator] / 255);
}

} // namespace glove
