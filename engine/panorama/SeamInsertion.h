// Widening of a picture by seam insertion (seam carving in reverse). A seam is a connected path from the top
// row to the bottom row, one pixel a row. Colours are 3 floats a pixel, weights one.
#pragma once

#include <opencv2/core.hpp>

#include <functional>
#include <vector>

namespace shoal::panorama {

// Called with the fraction that is done, 0 to 1, on the calling thread.
using Progress = std::function<void(double)>;

// Returns the column of the minimum-cost seam in each row. The cost is the sum of the differences between
// pixels that removing the seam would make neighbours: those left and right of it and, where it steps
// sideways, one of those and the pixel above (forward energy: Rubinstein, Shamir, Avidan, "Improved Seam
// Carving for Video Retargeting", SIGGRAPH 2008, section 5). Differences are summed over the three
// components; beyond the left and right edge the last pixel repeats. weight, of the same size, is added for
// each pixel of the seam; it may be negative, and must be finite. Equal costs: leftmost at the bottom.
std::vector<int> minSeam(const cv::Mat& colours, const cv::Mat& weight);

// Returns the source column of each pixel of the picture widened to `columns`, in pixels of `colours` with
// centres at whole numbers. Never decreases along a row.
//
// Each pass doubles the seams that are the cheapest to remove (section 4.3 of Avidan and Shamir, "Seam
// Carving for Content-Aware Image Resizing", SIGGRAPH 2007). A pass inserts at most a tenth of the columns
// and raises the weight of doubled pixels, so that insertions spread. columns: at least colours.cols.
cv::Mat seamInsertionMap(
    const cv::Mat& colours, const cv::Mat& weight, int columns, const Progress& progress = [](double) {});

// Smooths a map's deviation from uniform stretching by a Gaussian. The ends and monotonicity are kept.
void smoothMap(std::vector<float>& map, double sigma_px);

} // namespace shoal::panorama
