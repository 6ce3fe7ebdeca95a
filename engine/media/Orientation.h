// How a stored picture becomes one of the whole sphere: upright, then each eye's part in its place. An
// orientation is one of the eight ways in which a picture may be turned or mirrored, by its number in EXIF
// (CIPA DC-008, tag 274): 1 is upright, and from 5 on columns are stored as rows. Pictures: ImageRgb8 or
// ImageRgbF.
#pragma once

#include "engine/core/Image.h"
#include "engine/media/SphericalMetadata.h"

#include <cstdint>
#include <span>
#include <string>

namespace shoal::media {

constexpr bool swapsSides(int orientation) { return orientation >= 5; }
std::string uprightNote(int orientation); // the clause for the person, after "; "

// Makes a stored picture upright; `upright` takes its size. Any number but 1 to 8 counts as 1.
template <class Picture> void makeUpright(const Picture& stored, int orientation, Picture& upright);

// Returns the orientation nearest to a display matrix: rows a b u, c d v, x y w, where a stored point (p, q)
// is shown at (a p + c q + x, b p + d q + y), both downwards (ISO/IEC 14496-12, 8.3.2).
int orientationOf(std::span<const int32_t, 9> matrix);

// Places each eye's picture in its bounds within `whole`, which keeps its size: the picture takes the size
// that fits. The rest of the sphere mirrors it, which is continuous everywhere around a centred half.
template <class Picture>
void placeInSphere(const Picture& upright, Layout layout, const SphereBounds& bounds, Picture& whole);

} // namespace shoal::media
