// From a frame to the light: the whole pipeline, for each video frame on the decode thread, or once for a
// still.
#pragma once

#include "engine/light/DiffuseMap.h"
#include "engine/light/EnvironmentLight.h"
#include "engine/light/FrameView.h"
#include "engine/light/GlossyPrefilter.h"
#include "engine/light/Pyramid.h"

#include <optional>

namespace shoal::light {

enum class LightQuality {
    Video, // videoLevels(): a few milliseconds a frame
    Still, // stillLevels()
};

struct LightOptions {
    int baseWidth = 1024; // most texels around pyramid level 0 (the mirror); rounded down to a power of two
    LightQuality quality = LightQuality::Video;
};

struct LightReport {
    float pyramid_ms = 0, diffuse_ms = 0, glossy_ms = 0;
    size_t repairedTexels = 0; // of an HDR picture: NaN, infinite, negative or above kMaxRadianceIn
    float total_ms() const { return pyramid_ms + diffuse_ms + glossy_ms; }
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
    DiffuseMap diffuse_;
    std::optional<GlossyPrefilter> glossy_; // for the base width of the last frame
};

} // namespace shoal::light
