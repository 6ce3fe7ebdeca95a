// Few taps for a lobe, fitted by least squares.
//
// Manson and Sloan 2016 fit the places, levels and weights of few trilinear taps to the lobe. Theirs are
// polynomials over the faces of a cube map; on the lat-long map one set of rings around the axis serves, and
// the fit can be done on Legendre coefficients: a ring of taps at the angle t read from a level with texels
// of size s answers to band l with P_l(cos t) exp(-l (l + 1) s^2 / 8) (a texel's box and the linear
// interpolation between texels have together the variance s^2 / 4 on each axis). The level follows from the
// distance between a ring's taps, weights follow by least squares, angles by descent.
#pragma once

#include "tests/baselines/light/Taps.h"

namespace shoal::light::baselines {

constexpr int kFittedTaps = 36; // at most; rings of no use are left out

// Levels are whole: each tap is one bilinear lookup. Weights are above 0.
std::vector<Tap> fittedTaps(float roughness, int baseWidth);

} // namespace shoal::light::baselines
