// Widening of a picture by seam insertion (seam carving in reverse).
#pragma once

#include "engine/panorama/SeamSearch.h"

#include <functional>
#include <vector>

namespace shoal::panorama {

// Called with the fraction that is done, 0 to 1, on the calling thread.
using Progress = std::function<void(double)>;

// The source column of each pixel of the widened picture, columns x colours.height, in pixels of `colours`
// with centres at whole numbers. Never decreases along a row.
//
// Passes of seams that are the cheapest to remove, each doubled (section 4.3 of Avidan and Shamir, "Seam
// Carving for Content-Aware Image Resizing", SIGGRAPH 2007). A pass inserts at most a tenth of the columns
// and raises the weight of what it doubled, so that insertions spread. columns: at least colours.width.
Plane seamInsertionMap(const Colours& colours, const Plane& weight, int columns,
                       const Progress& progress = {});

// One source column for each column: the mean of seamInsertionMap() over all rows, so that vertical lines
// stay straight.
std::vector<float> columnInsertionMap(const Colours& colours, const Plane& weight, int columns,
                                      const Progress& progress = {});

// Smooths a map's deviation from uniform stretching by a Gaussian. The ends and monotonicity are kept.
void smoothMap(std::vector<float>& map, double sigma_px);

} // namespace shoal::panorama
