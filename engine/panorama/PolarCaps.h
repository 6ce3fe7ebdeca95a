// Extrapolation of a panorama to the poles: sky and ground.
#pragma once

#include <opencv2/core.hpp>

namespace shoal::panorama {

enum class PolarCap { Sky, Ground };

// Fills rows 0 to edge of a lat-long picture (3 floats) from the rows below, and fades into these over some
// degrees. For the nadir, flip the picture. edge: above 0 and below half the height.
//
// Colours: the solution of Laplace's equation on the cap with the edge row as boundary, in which the mth
// harmonic around the pole falls as (tan(c / 2) / tan(c0 / 2))^m with the colatitude c, so that nothing
// converges on the pole; times the picture's mean vertical gradient, damped within some 20 degrees.
// Texture, of the ground only (a sky is smooth): by-example synthesis on the tangent plane from a square just
// outside the cap, as the ratio to its blurred self, so that grain and contrast continue without repetition.
void fillPolarCap(cv::Mat& latLong, int edge, PolarCap kind);

} // namespace shoal::panorama
