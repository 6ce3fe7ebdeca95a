#include "engine/camera/CameraResponseOverTime.h"

#include <glm/common.hpp>

#include <algorithm>

namespace shoal::camera {

namespace {

constexpr float kFollow_s = 2.2f; // time constant
// Lenses scatter one to five percent, worn ports more; a higher bound only means that nothing dark was seen
// in front of bright surroundings.
constexpr float kUsualGlare = 0.03f, kMaxGlare = 0.1f;

float shareOf(float dt_s) { return 1 - std::exp(-std::max(dt_s, 0.0f) / kFollow_s); }

} // namespace

void CameraResponseOverTime::follow(const CameraResponseEstimate& estimate, float dt_s) {
    const auto shareIf = [&](bool known) { return known ? shareOf(dt_s) : 1.0f; };
    const CameraResponse& seen = estimate.response;
    const float all = shareIf(begun_);
    begun_ = true;
    for (size_t band = 0; band < kBrightnesses; ++band) {
        response_.fineNoise[band] += (seen.fineNoise[band] - response_.fineNoise[band]) * all;
        response_.coarseNoise[band] += (seen.coarseNoise[band] - response_.coarseNoise[band]) * all;
    }
    response_.black = glm::mix(response_.black, seen.black, all);
    response_.white = glm::mix(response_.white, seen.white, all);
    if (estimate.edges >= kFewEdges) {
        response_.blur_texels += (seen.blur_texels - response_.blur_texels) * shareIf(edgesSeen_);
        edgesSeen_ = true;
    }
    if (estimate.chromaKnown) {
        chromaTexels_ = glm::mix(chromaTexels_, glm::vec2(seen.chromaTexels), shareIf(chromaSeen_));
        chromaSeen_ = true;
    }
}

void CameraResponseOverTime::followGlare(float maxShare, float dt_s) {
    maxGlare_ = std::min(maxGlare_, maxShare);
    const float glare = maxGlare_ > kMaxGlare ? kUsualGlare : maxGlare_;
    response_.glare += (glare - response_.glare) * (glareSeen_ ? shareOf(dt_s) : 1.0f);
    glareSeen_ = true;
}

CameraResponse CameraResponseOverTime::response() const {
    if (!begun_) return {};
    CameraResponse response = response_;
    response.chromaTexels = glm::ivec2(chromaTexels_ + 0.5f);
    return response;
}

} // namespace shoal::camera
