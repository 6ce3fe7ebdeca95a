// Growing a picture sideways by seams.
#pragma once

#include "engine/panorama/Seams.h"

#include <functional>
#include <vector>

namespace shoal::panorama {

// Called with the share that is done, 0 to 1, on the calling thread.
using Progress = std::function<void(double)>;

// Where each pixel of the grown picture comes from: the source column, in pixels of `colours` with centres
// at whole numbers, for each of columns x colours.height. Never falls along a row.
//
// Passes of seams that are the cheapest to remove, each doubled (section 4.3 of Avidan and Shamir, "Seam
// Carving for Content-Aware Image Resizing", SIGGRAPH 2007). A pass takes at most a tenth of the columns,
// and what was doubled is dearer in the next, so that growth spreads. columns: at least colours.width.
Plane growColumns(const Colours& colours, const Plane& weight, int columns, const Progress& progress = {});

// One number a column, growColumns' mean over all rows: the seams say where the picture grows, and by how
// much, but what is upright stays upright and no line is bent by a pixel here and there.
std::vector<float> growEvenly(const Colours& colours, const Plane& weight, int columns,
                              const Progress& progress = {});

// Smooths a map's distance from even stretching by a Gaussian. Ends stay put; a map that never falls still
// never does.
void smoothMap(std::vector<float>& map, double sigma_px);

} // namespace shoal::panorama
