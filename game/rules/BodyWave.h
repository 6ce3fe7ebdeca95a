// How fast and how far a tail beats at a speed. No trigonometry: the wave's form is the model's clip.
#pragma once

#include <algorithm>

namespace shoal::game {

// Muscles of small fish twitch faster (Wardle 1975, "Limit of fish swimming speed"); displays show no more.
constexpr float kFastestBeat_Hz = 12;
constexpr float kFullBeat = 0.1f; // half the tail's sweep at speed, body lengths: Bainbridge 1958

// Beats a second. A fish moves on by the same part of its length, its stride, with every beat, however fast
// it swims: Bainbridge 1958, "The speed of swimming of fish as related to size and to the frequency and
// amplitude of the tail beat" (0.6 to 0.75 of the length in dace, trout and goldfish).
inline float tailBeat_Hz(float speed_mps, float length_m, float stride) {
    return std::min(kFastestBeat_Hz, speed_mps / (stride * length_m));
}

// Half the tail's sweep in body lengths; pace: speed against the cruising speed. It grows with speed while
// that is low and hardly at all when it is high (Bainbridge 1958): a saturating curve.
inline float tailAmplitude(float pace) { return kFullBeat * pace / (pace + 0.3f); }

} // namespace shoal::game
