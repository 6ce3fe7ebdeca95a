// Finds the level of a pyramid by its width.
#pragma once

#include "engine/light/EnvironmentLight.h"

#include <cassert>

namespace shoal::light::baselines {

inline const ImageRgbF& levelOfWidth(const RadiancePyramid& pyramid, int width) {
    size_t k = 0;
    while (pyramid.levels[k].width > width) ++k;
    assert(pyramid.levels[k].width == width);
    return pyramid.levels[k];
}

} // namespace shoal::light::baselines
