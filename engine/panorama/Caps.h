// Sky and ground: what lies beyond the ring, up to the poles.
#pragma once

#include <opencv2/core.hpp>

namespace shoal::panorama {

enum class Cap { Sky, Ground };

// Fills rows 0 to edge of a lat-long picture (3 floats; rows edge to half the height are there) up to the
// zenith, and fades into the ring over its first degrees. For the nadir, turn the picture upside down.
// edge: above 0 and below half the height.
//
// Colours: the ring's edge continued as the solution of Laplace's equation on the cap, where the mth harmonic
// around the pole falls as (tan(c / 2) / tan(c0 / 2))^m with the colatitude c, so that nothing converges on
// the pole; times the ring's mean change with height, which comes to rest within some 20 degrees.
// Texture, of the ground only (a sky is smooth): the cap is seen as a plane, and pieces of a square of that
// plane just beyond its rim, in the picture's middle, are laid all over it at random and blended, as their
// ratio to their own blurred selves: its grain and its contrast go on, and nothing repeats.
void fillCap(cv::Mat& latLong, int edge, Cap kind);

} // namespace shoal::panorama
