// The seam search against an exhaustive one.
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
    cv::Mat colours, weight;
    Case(int width, int height)
        : colours(height, width, CV_32FC3, cv::Scalar::all(0)), weight(height, width, CV_32F, cv::Scalar(0)) {
    }
};

Case noise(int width, int height, uint64_t seed) {
    Case made(width, height);
    Random random(seed);
    for (float& value : cv::Mat_<float>(made.colours.reshape(1))) value = random.unit();
    for (float& value : cv::Mat_<float>(made.weight)) value = 0.3f * random.unit() - 0.1f;
    return made;
}

double apart(const cv::Mat& c, int xa, int ya, int xb, int yb) {
    double sum = 0;
    for (int k = 0; k < 3; ++k)
        sum += std::abs(static_cast<double>(c.at<cv::Vec3f>(ya, xa)[k]) -
                        static_cast<double>(c.at<cv::Vec3f>(yb, xb)[k]));
    return sum;
}

// Returns the cost of the pixels that removing the seam brings together, without the search's tables.
double costOf(const Case& of, const std::vector<int>& seam) {
    double sum = 0;
    for (int y = 0; y < of.colours.rows; ++y) {
        const int x = seam[static_cast<size_t>(y)];
        const int left = std::max(x - 1, 0), right = std::min(x + 1, of.colours.cols - 1);
        sum += apart(of.colours, left, y, right, y) + static_cast<double>(of.weight.at<float>(y, x));
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
        if (static_cast<int>(seam.size()) == of.colours.rows) {
            minimum = std::min(minimum, costOf(of, seam));
            return;
        }
        for (int x = 0; x < of.colours.cols; ++x) {
            if (!seam.empty() && std::abs(x - seam.back()) > 1) continue;
            seam.push_back(x);
            grow();
            seam.pop_back();
        }
    };
    grow();
    return minimum;
}

void expectOnePixelARow(const std::vector<int>& seam, const cv::Mat& colours) {
    ASSERT_EQ(static_cast<int>(seam.size()), colours.rows);
    for (size_t y = 0; y < seam.size(); ++y) {
        EXPECT_GE(seam[y], 0);
        EXPECT_LT(seam[y], colours.cols);
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

TEST(SeamInsertion, MapsNeverFallAndKeepTheirEnds) {
    const Case made = noise(30, 20, 3);
    const cv::Mat map = seamInsertionMap(made.colours, made.weight, 100);
    ASSERT_EQ(map.cols, 100);
    for (int y = 0; y < map.rows; ++y)
        for (int x = 1; x < map.cols; ++x) ASSERT_GE(map.at<float>(y, x), map.at<float>(y, x - 1));
    std::vector<float> even(map.begin<float>(), map.begin<float>() + map.cols);
    const float first = even.front(), last = even.back();
    smoothMap(even, 5);
    EXPECT_FLOAT_EQ(even.front(), first);
    EXPECT_FLOAT_EQ(even.back(), last);
    EXPECT_TRUE(std::is_sorted(even.begin(), even.end()));
}

// Flat to the left, noise to the right: the flat half takes the growth.
TEST(SeamInsertion, IsPlacedWhereThePictureIsFlat) {
    Case made = noise(40, 30, 5);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 20; ++x) made.colours.at<cv::Vec3f>(y, x) = cv::Vec3f::all(0.5f);
    made.weight.setTo(0);
    const cv::Mat_<float> map = seamInsertionMap(made.colours, made.weight, 100);
    const auto flat = std::count_if(map.begin(), map.end(), [](float at) { return at < 19.5f; });
    EXPECT_GT(flat, 70 * map.rows); // of 60 new columns nearly all; it began with 20
}

TEST(SeamInsertion, NothingWithinTheStrip) {
    const Case made = noise(40, 10, 9);
    cv::Mat weight(10, 40, CV_32F, cv::Scalar(0));
    for (int y = 0; y < 10; ++y)
        for (int x = 15; x < 25; ++x) weight.at<float>(y, x) = 10;
    const cv::Mat map = seamInsertionMap(made.colours, weight, 120);
    for (int y = 0; y < 10; ++y)
        for (int x = 1; x < 120; ++x)
            if (map.at<float>(y, x - 1) >= 15 && map.at<float>(y, x) <= 24) {
                EXPECT_FLOAT_EQ(map.at<float>(y, x) - map.at<float>(y, x - 1), 1);
            }
}

} // namespace
} // namespace shoal::panorama
