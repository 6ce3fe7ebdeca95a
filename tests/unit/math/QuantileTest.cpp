#include "engine/math/Quantile.h"

#include <gtest/gtest.h>

namespace shoal::math {
namespace {

TEST(Quantile, IsAValueThatTheShareOfAllAreLessThan) {
    std::vector<float> values = {5, 1, 4, 2, 3};
    EXPECT_EQ(quantile(values, 0), 1);
    EXPECT_EQ(quantile(values, 0.19), 1);
    EXPECT_EQ(quantile(values, 0.2), 2);
    EXPECT_EQ(median(values), 3);
    EXPECT_EQ(quantile(values, 1), 5);
}

TEST(Quantile, TakesTheUpperOfTwoAndNothingOfNone) {
    std::vector<double> values = {4, 1, 3, 2}, none;
    EXPECT_EQ(median(values), 3);
    EXPECT_EQ(median(none), 0);
}

} // namespace
} // namespace shoal::math
