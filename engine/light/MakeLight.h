// From a frame to the light: the whole pipeline, for each video frame on the decode thread, or once for a
// still.
#pragma once

#include "engine/light/EnvironmentLight.h"
#include "engine/light/Filters.h"
#include "engine/light/FrameView.h"
#include "engine/light/Pyramid.h"

#include <optional>

namespace shoal::light {

struct LightOptions {
    // Most texels around pyramid level 0, which mirrors show; rounded down to a power of two.
    int baseWidth = 1024;
    // Of all surfaces that will be lit: levels below it are not made, see glossyPlans().
    float minRoughness = 0.1f;
    LightQuality quality = LightQuality::Video;
};

struct LightReport {
    float pyramid_ms = 0, filter_ms = 0;
    size_t repairedTexels = 0; // of an HDR picture: NaN, infinite, negative or above kMaxRadianceIn
    float total_ms() const { return pyramid_ms + filter_ms; }
};

// Keeps kernels and scratch. The first frame of a new size makes tables (up to a second); after that
// nothing is allocated while out keeps its buffers. One thread at a time; a maker for each thread.
//
// The light is finite and lies in 0 .. kMaxHalf whatever comes in, so half floats hold it; the rough levels
// and the diffuse map are summed before that cut, so a sun above it loses nothing of its strength on rough
// things.
class LightMaker {
  public:
    explicit LightMaker(LightOptions options = {});

    LightReport make(const FrameView& frame, EnvironmentLight& out);
    LightReport makeFromHdr(const ImageRgbF& radianceLin, EnvironmentLight& out);

  private:
    void finish(EnvironmentLight& out, LightReport& report);

    LightOptions options_;
    PyramidMaker pyramid_;
    std::optional<LightFilters> filters_; // for the base width of the last frame
};

} // namespace shoal::light
