#include "engine/panorama/WrapBlend.h"

#include "engine/panorama/SeamInsertion.h"

#include <glm/common.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::panorama {

namespace {

// Returns the mean of a few columns at one end.
cv::Mat endOf(const cv::Mat& ring, bool left) {
    const int width = std::max(1, ring.cols / 256);
    cv::Mat mean;
    cv::reduce(ring.colRange(left ? 0 : ring.cols - width, left ? width : ring.cols), mean, 1,
               cv::REDUCE_AVG);
    return mean;
}

// Returns by how many rows the left end's content lies lower than the right's, for each row half way between.
std::vector<float> offsets(const cv::Mat& ring) {
    const int maximum = ring.cols * 8 / 360;
    cv::Mat left = endOf(ring, true), right = endOf(ring, false);
    const int rows = ring.rows;
    cv::Mat cost(rows, 2 * maximum + 1, CV_32F);
    const cv::Mat none(cost.size(), CV_32FC3, cv::Scalar::all(0));
    for (int y = 0; y < rows; ++y)
        for (int d = -maximum; d <= maximum; ++d) {
            const int l = std::clamp(y + (d >= 0 ? (d + 1) / 2 : d / 2), 0, rows - 1);
            const int r = std::clamp(l - d, 0, rows - 1);
            const cv::Vec3f apart = left.at<cv::Vec3f>(l) - right.at<cv::Vec3f>(r);
            const float offsetCost = 0.02f * static_cast<float>(std::abs(d)) / static_cast<float>(maximum);
            cost.at<float>(y, d + maximum) =
                std::abs(apart[0]) + std::abs(apart[1]) + std::abs(apart[2]) + offsetCost;
        }
    const std::vector<int> seam = minSeam(none, cost);
    cv::Mat found(rows, 1, CV_32F);
    for (int y = 0; y < rows; ++y)
        found.at<float>(y) = static_cast<float>(seam[static_cast<size_t>(y)] - maximum);
    cv::GaussianBlur(found, found, {}, 0.1, std::max(1.0, ring.cols / 360.0), cv::BORDER_REPLICATE);
    return {found.begin<float>(), found.end<float>()};
}

// Returns 1 at an end, 0 from `reach` on, with a continuous slope.
float fade(double distance, double reach) {
    return static_cast<float>(glm::smoothstep(0.0, 1.0, 1 - distance / reach));
}

void alignRows(cv::Mat& ring) {
    const std::vector<float> lower = offsets(ring);
    const double reach = ring.cols / 6.0;
    cv::Mat column(ring.size(), CV_32F), row(ring.size(), CV_32F), out;
    for (int x = 0; x < ring.cols; ++x) {
        const float share = 0.5f * (x < ring.cols / 2 ? fade(x, reach) : -fade(ring.cols - 1 - x, reach));
        for (int y = 0; y < ring.rows; ++y) {
            column.at<float>(y, x) = static_cast<float>(x);
            row.at<float>(y, x) = static_cast<float>(y) + share * lower[static_cast<size_t>(y)];
        }
    }
    cv::remap(ring, out, column, row, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    double darkest = 0, brightest = 0;
    cv::minMaxLoc(ring.reshape(1), &darkest, &brightest);
    ring = cv::min(cv::max(out, darkest), brightest);
}

void blendColours(cv::Mat& ring) {
    cv::Mat rest = ring.col(0) - ring.col(ring.cols - 1);
    // Octave bands of the difference from fine to coarse; the remainder is the coarsest.
    for (double sigma = 1;; sigma *= 2) {
        const bool coarsest = sigma > ring.rows / 4.0;
        cv::Mat coarser, band = rest;
        if (!coarsest) {
            cv::GaussianBlur(rest, coarser, {}, 0.1, sigma, cv::BORDER_REPLICATE);
            band = rest - coarser;
            rest = coarser;
        }
        const double reach = coarsest ? ring.cols / 4.0 : std::min(ring.cols / 4.0, 16 * sigma);
        for (int x = 0; x < static_cast<int>(std::ceil(reach)); ++x) {
            const double share = 0.5 * static_cast<double>(fade(x, reach));
            ring.col(x) -= share * band;
            ring.col(ring.cols - 1 - x) += share * band;
        }
        if (coarsest) break;
    }
    ring = cv::max(ring, 0.0);
}

} // namespace

void blendWrapAround(cv::Mat& ring) {
    alignRows(ring);
    blendColours(ring);
}

WrapDiscontinuity wrapDiscontinuity(const cv::Mat& ring) {
    cv::Mat grey;
    cv::cvtColor(ring, grey, cv::COLOR_RGB2GRAY);
    cv::Mat steps = cv::abs(grey.colRange(1, grey.cols) - grey.colRange(0, grey.cols - 1));
    const cv::Mat wrap = cv::abs(grey.col(0) - grey.col(grey.cols - 1));
    std::vector<float> all(steps.begin<float>(), steps.end<float>());
    const auto nth = all.begin() + static_cast<ptrdiff_t>(all.size() * 9 / 10);
    std::nth_element(all.begin(), nth, all.end());
    WrapDiscontinuity strength;
    strength.usualStep = static_cast<double>(*nth);
    cv::minMaxLoc(wrap, nullptr, &strength.wrapStep);
    return strength;
}

} // namespace shoal::panorama
