#include "tests/baselines/occlusion/OllfbPixels.h"

#include <cmath>

namespace shoal::occlusion {

// Two planes that touch a bent surface lie as far outside it between their middles as the chord between these
// lies inside: half the slope between them follows the bend.
std::optional<OllfbSurface> surfaceNear(const OllfbPixels& pixels, const glm::vec3& place,
                                        const glm::vec3& normal) {
    constexpr float kAlike = 0.5f; // cosine between normals of one surface
    const glm::ivec2& size = pixels.view.size;
    const glm::ivec2 corner(glm::floor(glm::vec2(place) - 0.5f));
    const glm::vec2 share = glm::vec2(place) - 0.5f - glm::vec2(corner);
    // Some pixels off the plane may still be it, the more the steeper.
    const float furthest =
        1 + 0.5f * glm::min(kSteepest, glm::length(glm::vec2(normal)) / std::abs(normal.z));
    OllfbSurface sum;
    float weightSum = 0, tiltSum = 0;
    int found = 0;
    for (int k = 0; k < 4; ++k) {
        const glm::ivec2 pixel = corner + glm::ivec2(k % 2, k / 2);
        if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.x || pixel.y >= size.y) continue;
        const glm::vec2 aside = glm::vec2(place) - (glm::vec2(pixel) + 0.5f);
        const OllfbPixels::Layers here = pixels.layersOf(pixel);
        float nearest = furthest;
        OllfbSurface best;
        bool any = false;
        for (const OllfbLayer* layer = here.begin; layer != here.end; ++layer) {
            const glm::vec3 other = OllfbPixels::normalOf(*layer);
            const glm::vec2 slope = slopeOf(other);
            const float depth = pixels.depthOf(*layer);
            const float off = std::abs(depth + glm::dot(slope, aside) - place.z);
            if (off > nearest || glm::dot(other, normal) < kAlike) continue;
            nearest = off, best = {depth, slope, other}, any = true;
        }
        if (!any) continue;
        const float weight = (k % 2 ? share.x : 1 - share.x) * (k / 2 ? share.y : 1 - share.y);
        sum.depth += weight * best.depth;
        sum.slope += weight * best.slope;
        sum.normal += weight * best.normal;
        tiltSum += weight * glm::dot(best.slope, aside);
        weightSum += weight;
        ++found;
    }
    if (weightSum <= 0.1f) return {};
    return OllfbSurface{(sum.depth + (found == 4 ? 0.5f : 1.0f) * tiltSum) / weightSum, sum.slope / weightSum,
                        glm::normalize(sum.normal)};
}

} // namespace shoal::occlusion
