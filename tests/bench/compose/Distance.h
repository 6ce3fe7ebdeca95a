// Measures of the difference between a picture and one in which the objects were filmed.
#pragma once

#include "tests/bench/Bench.h"

namespace shoal::bench {

// Coverage of each pixel by objects, 0 to 1.
using Coverage = Image<float, 1>;

struct Distance {
    double luma = 0;   // root mean square, of 255, over all pixels of objects and those within four of them
    double colour = 0; // the same of red, green and blue
    double spectrum_db = 0; // root mean square difference of the objects' power spectra over frequencies
    double detail_db = 0;   // of objects above those around them: share of power beyond an eighth of a cycle
                            // a pixel; 0 where they have as much
    double noise = 0;       // standard deviation, of 255, of objects' inside by its Laplacian
};

Distance distance(const ImageRgba8& shown, const ImageRgba8& truth, const Coverage& objects);

} // namespace shoal::bench
