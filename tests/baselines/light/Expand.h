// Functions that operators of inverse tone mapping share.
#pragma once

#include "engine/core/Image.h"
#include "engine/math/Colour.h"

#include <glm/vec3.hpp>

namespace shoal::light::baselines {

inline glm::vec3 decoded(const glm::vec3& coded) {
    return {math::linearFromSrgb(coded.x), math::linearFromSrgb(coded.y), math::linearFromSrgb(coded.z)};
}

// expand(coded colour): 0 to 1 in, linear radiance out.
template <class Expand> void forEach(const ImageRgb8& frame, ImageRgbF& out, Expand&& expand) {
    out.fit(frame.width, frame.height);
    for (size_t i = 0; i < frame.pixels.size(); i += 3) {
        const uint8_t* coded = &frame.pixels[i];
        const glm::vec3 radiance = expand(glm::vec3(coded[0], coded[1], coded[2]) / 255.0f);
        for (int c = 0; c < 3; ++c) out.pixels[i + c] = radiance[c];
    }
}

} // namespace shoal::light::baselines
