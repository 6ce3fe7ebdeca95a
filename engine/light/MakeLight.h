// Makes the light of a frame: the whole pipeline, for each video frame on the decode thread, or once for a
// still.
#pragma once

#include "engine/light/CentroidChain.h"
#include "engine/light/EnvironmentLight.h"
#include "engine/light/FrameView.h"
#include "engine/light/GlossyLevels.h"
#include "engine/light/Pyramid.h"
#include "engine/light/ZonalFilter.h"

#include <optional>

namespace shoal::light {

struct LightOptions {
    // Greatest width of pyramid level 0, which mirrors show; rounded down to a power of two.
    int baseWidth = 1024;
    // Least roughness of all surfaces to be lit; smoother levels are not made, see glossyPlans().
    float minRoughness = 0.1f;
    LightQuality quality = LightQuality::Video;
    FrameRadiance frames = FrameRadiance::Thesis;
};

// Makes light, and keeps filter kernels and buffers. The first frame of a new size makes tables (up to a
// second); after that nothing is allocated while out keeps its buffers. Each thread needs its own maker.
//
// The light is finite and not negative for any input. It is absolute: a sun keeps its radiance up to
// kMaxRadianceIn. Half floats cannot hold such values: packLight() scales or clamps them.
class LightMaker {
  public:
    explicit LightMaker(LightOptions options = {}) : options_(options) {}

    void make(const FrameView& frame, EnvironmentLight& out);

    // Returns how many texels were repaired: NaN, infinite, negative or above kMaxRadianceIn.
    size_t makeFromHdr(const ImageRgbF& radianceLin, EnvironmentLight& out);

  private:
    // The filters for one base width.
    struct Filters {
        std::vector<GlossyPlan> plans;
        CentroidChain chain;
        std::vector<ZonalFilter>
            filters; // narrow lobes on wide maps first; the last makes the diffuse map too
    };
    void makeFilters(int baseWidth);
    void filter(EnvironmentLight& out);

    LightOptions options_;
    PyramidMaker pyramid_;
    std::optional<Filters> filters_; // for the base width of the last frame
    std::vector<ImageRgbF*> targets_;
};

} // namespace shoal::light
