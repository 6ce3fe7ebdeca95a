#include "engine/math/Sine.h"

#include <gtest/gtest.h>

namespace shoal::math {
namespace {

TEST(Sine, AgreesWithTheLibrarysToTheRoundingOfAFloat) {
    double worst = 0;
    for (int i = -400'000; i <= 400'000; ++i) {
        const float angle = static_cast<float>(i) * 1e-3f;
        worst = std::max(worst,
                         std::fabs(static_cast<double>(sine(angle)) - std::sin(static_cast<double>(angle))));
    }
    EXPECT_LE(worst, 3.0e-8 + 1e-9); // half a unit in the last place of a float just below 1, and the series
    EXPECT_EQ(sine(0), 0);
    EXPECT_EQ(sine(-1.25f), -sine(1.25f));
}

} // namespace
} // namespace shoal::math
