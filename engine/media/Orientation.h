// The eight ways in which a picture may be stored, turned or mirrored, by their numbers in EXIF (CIPA DC-008,
// tag 274): 1 is upright. From 5 on, columns are stored as rows.
#pragma once

#include "engine/core/Image.h"

#include <cstdint>
#include <span>

namespace shoal::media {

constexpr bool swapsSides(int orientation) { return orientation >= 5; }

// Makes a stored picture upright; `upright` takes its size. Images: ImageRgb8 or ImageRgbF. orientation: 1 to
// 8, and any other number counts as 1.
template <class Picture> void makeUpright(const Picture& stored, int orientation, Picture& upright);

// Returns the orientation nearest to a display matrix: rows a b u, c d v, x y w, where a stored point (p, q)
// is shown at (a p + c q + x, b p + d q + y), both downwards (ISO/IEC 14496-12, 8.3.2).
int orientationOf(std::span<const int32_t, 9> matrix);

} // namespace shoal::media
