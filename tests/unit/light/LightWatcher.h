// Finds lights as the game does, in a pyramid of 512 texels around.
#pragma once

#include "engine/light/FindLights.h"
#include "engine/light/Pyramid.h"
#include "engine/math/Colour.h"
#include "tests/unit/light/Environments.h"

namespace shoal::light {

struct LightWatcher {
    PyramidMaker pyramid;
    RadiancePyramid radiance;
    LightFinder finder;
    LightOverTime steady;

    // Returns the lights of the picture that was looked at last.
    FoundLights found() {
        FoundLights all;
        finder.find(radiance, all);
        return all;
    }
    FoundLights look(const ImageRgbF& radianceLin) {
        pyramid.make(radianceLin, 512, radiance);
        return found();
    }
    FoundLights look(const FrameView& frame) {
        pyramid.make(frame, 512, radiance);
        return found();
    }
    FoundLights look(const ImageRgb8& frame, bool bgr = false) {
        return look(
            FrameView{frame.pixels.data(), frame.width, frame.height, ptrdiff_t{3} * frame.width, bgr});
    }
};

// Returns the frame of a camera that clips, and that shows the sphere's mean as `key` of white.
inline ImageRgb8 filmed(const ImageRgbF& radianceLin, double key) {
    const double mean = glm::dot(meanOf(radianceLin), glm::dvec3(0.3, 0.59, 0.11));
    const float exposure = static_cast<float>(key / mean);
    ImageRgb8 frame(radianceLin.width, radianceLin.height);
    for (size_t i = 0; i < frame.pixels.size(); ++i)
        frame.pixels[i] = static_cast<uint8_t>(
            255 * math::srgbFromLinear(std::clamp(exposure * radianceLin.pixels[i], 0.0f, 1.0f)) + 0.5f);
    return frame;
}

} // namespace shoal::light
