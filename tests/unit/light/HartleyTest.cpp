#include "engine/light/Hartley.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shoal::light {
namespace {

// Sums of up to 128 floats below 1, in log2 steps that round at 6e-8 of their size each: 1e-5 with room.
TEST(Hartley, IsItsDefinitionInEveryLane) {
    for (const int length : {8, 16, 64, 128}) {
        const int lanes = 48;
        std::vector<float> data(static_cast<size_t>(length * lanes));
        uint32_t seed = 9;
        for (float& value : data) {
            seed = seed * 1664525u + 1013904223u;
            value = static_cast<float>(seed >> 8) * 0x1p-24f;
        }
        std::vector<float> out = data;
        Hartley hartley(length);
        hartley.transform(out.data(), lanes);
        for (int lane = 0; lane < lanes; ++lane)
            for (int k = 0; k < length; ++k) {
                double want = 0;
                for (int n = 0; n < length; ++n) {
                    const double angle = 2 * std::numbers::pi * k * n / length;
                    want += static_cast<double>(data[static_cast<size_t>(n * lanes + lane)]) *
                            (std::cos(angle) + std::sin(angle));
                }
                ASSERT_NEAR(out[static_cast<size_t>(k * lanes + lane)], want, 1e-5 * length)
                    << "frequency " << k << " of " << length << ", lane " << lane;
            }
        hartley.transform(out.data(), lanes);
        for (size_t i = 0; i < data.size(); ++i)
            ASSERT_NEAR(out[i] / static_cast<float>(length), data[i], 1e-5);
    }
}

} // namespace
} // namespace shoal::light
