// The seam search against an exhaustive one.
#include "engine/panorama/SeamSearch.h"
#include "engine/core/Random.h"
#include "engine/panorama/SeamInsertion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace shoal::panorama {
namespace {

struct Case {
    Colours colours;
    Plane weight;
};

Case noise(int width, int height, uint64_t seed) {
    Case made{Colours(width, height), Plane(width, height)};
    Random random(seed);
    for (float& value : made.colours.pixels) value = random.unit();
    for (float& value : made.weight.pixels) value = 0.3f * random.unit() - 0.1f;
    return made;
}

double apart(const Colours& c, int xa, int ya, int xb, int yb) {
    double sum = 0;
    for (int k = 0; k < 3; ++k)
        sum += std::abs(static_cast<double>(c.at(xa, ya)[k]) - static_cast<double>(c.at(xb, yb)[k]));
    return sum;
}

// What removing the seam brings together, said without the search's tables.
double costOf(const Case& of, const std::vector<int>& seam) {
    double sum = 0;
    for (int y = 0; y < of.colours.height; ++y) {
        const int x = seam[static_cast<size_t>(y)];
        const int left = std::max(x - 1, 0), right = std::min(x + 1, of.colours.width - 1);
        sum += apart(of.colours, left, y, right, y) + static_cast<double>(*of.weight.at(x, y));
        if (y == 0) continue;
        const int before = seam[static_cast<size_t>(y - 1)];
        // The pixel above stays, and gets the neighbour on the side that the seam came from below it.
        if (before < x) sum += apart(of.colours, x, y - 1, left, y);
        if (before > x) sum += apart(of.colours, x, y - 1, right, y);
    }
    return sum;
}

double cheapestOfAll(const Case& of) {
    double minimum = std::numeric_limits<double>::max();
    std::vector<int> seam;
    const std::function<void()> grow = [&] {
        if (static_cast<int>(seam.size()) == of.colours.height) {
            minimum = std::min(minimum, costOf(of, seam));
            return;
        }
        for (int x = 0; x < of.colours.width; ++x) {
            if (!seam.empty() && std::abs(x - seam.back()) > 1) continue;
            seam.push_back(x);
            grow();
            seam.pop_back();
        }
    };
    grow();
    return minimum;
}

void expectOnePixelARow(const std::vector<int>& seam, const Colours& colours) {
    ASSERT_EQ(static_cast<int>(seam.size()), colours.height);
    for (size_t y = 0; y < seam.size(); ++y) {
        EXPECT_GE(seam[y], 0);
        EXPECT_LT(seam[y], colours.width);
        if (y > 0) {
            EXPECT_LE(std::abs(seam[y] - seam[y - 1]), 1) << "row " << y;
        }
    }
}

TEST(SeamSearch, CheapestOfAllSeams) {
    uint64_t seed = 0;
    for (const auto& [width, height] : {std::pair{6, 7}, {5, 8}, {2, 9}, {1, 5}, {7, 1}, {3, 2}})
        for (int k = 0; k < 12; ++k) {
            const Case made = noise(width, height, ++seed);
            const std::vector<int> seam = minSeam(made.colours, made.weight);
            expectOnePixelARow(seam, made.colours);
            // Sums of at most 9 rows of numbers below 7 in single precision.
            EXPECT_NEAR(costOf(made, seam), cheapestOfAll(made), 1e-5)
                << width << "x" << height << " seed " << seed;
        }
}

TEST(SeamSearch, LargeNoiseKeepsToNeighbours) {
    const Case made = noise(200, 150, 7);
    expectOnePixelARow(minSeam(made.colours, made.weight), made.colours);
}

TEST(SeamSearch, GoesAroundWhatIsDear) {
    Case made{Colours(9, 20), Plane(9, 20)};
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 9; ++x)
            if (x != (y < 10 ? 2 : 3)) *made.weight.at(x, y) = 1;
    const std::vector<int> seam = minSeam(made.colours, made.weight);
    for (int y = 0; y < 20; ++y) EXPECT_EQ(seam[static_cast<size_t>(y)], y < 10 ? 2 : 3);
}

TEST(SeamSearch, RemovalTakesOnePixelARow) {
    Image<int, 2> image(4, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x) image.at(x, y)[0] = x, image.at(x, y)[1] = y;
    removeSeam(image, {0, 1, 3});
    ASSERT_EQ(image.width, 3);
    ASSERT_EQ(image.pixels.size(), 18u);
    EXPECT_EQ(image.at(0, 0)[0], 1);
    EXPECT_EQ(image.at(1, 1)[0], 2);
    EXPECT_EQ(image.at(2, 2)[0], 2);
    EXPECT_EQ(image.at(2, 2)[1], 2);
}

TEST(SeamInsertion, MapsNeverFallAndKeepTheirEnds) {
    const Case made = noise(30, 20, 3);
    const Plane map = seamInsertionMap(made.colours, made.weight, 100);
    ASSERT_EQ(map.width, 100);
    for (int y = 0; y < map.height; ++y)
        for (int x = 1; x < map.width; ++x) ASSERT_GE(*map.at(x, y), *map.at(x - 1, y));
    std::vector<float> even = columnInsertionMap(made.colours, made.weight, 100);
    const float first = even.front(), last = even.back();
    smoothMap(even, 5);
    EXPECT_FLOAT_EQ(even.front(), first);
    EXPECT_FLOAT_EQ(even.back(), last);
    EXPECT_TRUE(std::is_sorted(even.begin(), even.end()));
}

// Flat to the left, noise to the right: the flat half takes the growth.
TEST(SeamInsertion, WhereItIsFlat) {
    Case made = noise(40, 30, 5);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 20; ++x) std::fill_n(made.colours.at(x, y), 3, 0.5f);
    for (float& w : made.weight.pixels) w = 0;
    const std::vector<float> map = columnInsertionMap(made.colours, made.weight, 100);
    const auto flat = std::count_if(map.begin(), map.end(), [](float at) { return at < 19.5f; });
    EXPECT_GT(flat, 70); // of 60 new columns nearly all; it began with 20
}

TEST(SeamInsertion, NothingWithinTheStrip) {
    const Case made = noise(40, 10, 9);
    Plane weight(40, 10);
    for (int y = 0; y < 10; ++y)
        for (int x = 15; x < 25; ++x) *weight.at(x, y) = 10;
    const Plane map = seamInsertionMap(made.colours, weight, 120);
    for (int y = 0; y < 10; ++y)
        for (int x = 1; x < 120; ++x)
            if (*map.at(x - 1, y) >= 15 && *map.at(x, y) <= 24) {
                EXPECT_FLOAT_EQ(*map.at(x, y) - *map.at(x - 1, y), 1);
            }
}

} // namespace
} // namespace shoal::panorama
