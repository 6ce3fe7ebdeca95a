// A frame may show two eyes' pictures in one of several stereo layouts, which are detected here.
#pragma once

#include "engine/core/EnumNames.h"
#include "engine/core/Image.h"

#include <array>

namespace shoal::media {

// Auto: to be detected, or unknown. The others name the left eye's half first.
enum class Layout { Auto, Mono, TopBottom, LeftRight, BottomTop, RightLeft };

// Part of a frame that one eye sees, pixels. The halves of an odd size are rounded down.
struct EyePart {
    int x = 0, y = 0, width = 0, height = 0;
};

// Returns an eye's part. eye: 0 left, 1 right. Both eyes see the whole of a mono frame. layout is not Auto.
EyePart eyePart(Layout layout, int eye, int width, int height);

// Guesses by the frame's shape alone, expecting 2:1 for each eye within 6 %: 2:1 is mono, 1:1 top-bottom, 4:1
// left-right. Auto if the shape is ambiguous (16:9 is used for all three).
Layout layoutFromShape(double width, double height);

// Detects the layout from a frame: two eyes see the same but for small shifts along the rows, the halves of
// one panorama do not. Compares halves in blocks that have structure. Mono if neither pair of halves is
// alike, or both are; Auto if nothing can be told: blank, a fade, plain water. frame: either channel order.
Layout layoutFromContent(const ImageRgb8& frame);

// Detects a still picture's layout by its shape and content: 2:1 is mono unless it shows two eyes' pictures
// squeezed; squares and 4:1 strips are as often ordinary pictures, so they must show two eyes. Auto: an
// ordinary picture. Two eyes are looked for in 8-bit pictures alone.
Layout layoutOf(const ImageRgb8& picture);
Layout layoutOf(const ImageRgbF& picture);

} // namespace shoal::media

template <>
inline constexpr std::array shoal::kEnumNames<shoal::media::Layout> = {
    "auto", "mono", "top-bottom", "left-right", "bottom-top", "right-left"};
