// Stereo layouts of a frame, and their detection.
#pragma once

#include "engine/core/EnumNames.h"
#include "engine/core/Image.h"

#include <array>

namespace shoal::media {

// Auto only as a request ("detect"), never as a result. TopBottom: left eye above; LeftRight: left eye left.
enum class Layout { Auto, Mono, TopBottom, LeftRight };

// The part of a frame that an eye sees: pixels. Of an odd size both eyes' halves fit in.
struct EyePart {
    int x = 0, y = 0, width = 0, height = 0;
};

// eye: 0 left, 1 right. Both eyes see the whole of a mono frame. layout is not Auto.
EyePart eyePart(Layout layout, int eye, int width, int height);

// From the frame's shape alone, expecting 2:1 for each eye within 6 %: 2:1 is mono, 1:1 top-bottom, 4:1
// left-right. Auto if the shape is ambiguous (16:9 is used for all three).
Layout layoutFromShape(int width, int height);

// From a frame: two eyes see almost the same picture, while the halves of one panorama (sky and ground)
// differ. Halves count as equal if they differ, after averaging to 32x32, by less than kSameHalves of the
// picture's standard deviation. frame: either channel order. Never Auto; Mono when in doubt, also for a blank
// frame.
Layout layoutFromContent(const ImageRgb8& frame);
constexpr double kSameHalves = 0.4;

} // namespace shoal::media

template <> struct shoal::EnumNames<shoal::media::Layout> {
    static constexpr std::array kNames = {"auto", "mono", "top-bottom", "left-right"};
};
