// Makes the light of a frame: the whole pipeline, for each video frame on the decode thread, or once for a
// still.
#pragma once

#include "engine/light/CentroidChain.h"
#include "engine/light/EnvironmentLight.h"
#include "engine/light/FrameView.h"
#include "engine/light/Pyramid.h"
#include "engine/light/ZonalFilter.h"

#include <optional>

namespace shoal::light {

// Roughness of the filtered levels: 10^(-i / kGlossySteps), i = 0 .. kGlossySteps. Neighbours differ by a
// factor of 1.15: a mix of two differs from the lobe between them by a hundredth.
constexpr int kGlossySteps = 16;

constexpr float kMinFilteredRoughness = 0.1f;

enum class LightQuality {
    Video, // a fraction of a millisecond a frame, as accurate as 8 bits a channel need
    Still, // for stills, whose sun may be 10^5 times as bright as the shade: texels a quarter as wide
};

struct GlossyPlan {
    float roughness = 0;
    int width = 0;         // texels around
    bool filtered = false; // if false, the radiance pyramid's level k is used for plan k
};

// Returns the plans of all levels by ascending roughness; the last has roughness 1.
//   The first plans are levels of the radiance pyramid, for mirrors: from baseWidth (a power of two >= 256)
// down to a width of 512, with the roughness of a lobe as wide as their texels.
//   The others are filtered levels, from the greatest roughness not above minRoughness (the least of all
// surfaces; raised to 0.1) to 1, each as wide as its lobe needs, and no wider than baseWidth.
std::vector<GlossyPlan> glossyPlans(int baseWidth, float minRoughness, LightQuality quality);

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
    // radianceLin: see kMaxRadianceIn for values that cannot be light.
    void makeFromHdr(const ImageRgbF& radianceLin, EnvironmentLight& out);

  private:
    // The filters for one base width.
    struct Filters {
        std::vector<GlossyPlan> plans;
        CentroidChain chain;
        std::vector<ZonalFilter> filters; // narrow lobes on wide maps first
    };
    void makeFilters(int baseWidth);
    void filter(EnvironmentLight& out);

    LightOptions options_;
    PyramidMaker pyramid_;
    std::optional<Filters> filters_; // for the base width of the last frame
};

} // namespace shoal::light
