// Single figures from the measurements.
#pragma once

#include "tests/bench/light/Measure.h"

namespace shoal::bench {

constexpr size_t kGlossyLobes = std::size(kRoughnesses);
constexpr double kGlossyPixels = 100000; // shaded in a frame, for one figure of a glossy method's cost

// Chooses environments.
enum class Suns { With, Without, Only };
Pool pooled(const Chart& chart, const Measured& method, Suns suns, size_t firstLobe, size_t lobes);

// Returns the median of one lobe's root mean square errors by an inverse tone mapping, over the clipped HDR
// pictures or over our film. NaN if nothing was measured.
double medianOfToneMap(const Chart& chart, const Measured& method, bool film, size_t lobe);

// Returns the microseconds for a frame with so many shaded pixels.
double frame_us(const Cost& cost, double pixels);

} // namespace shoal::bench
