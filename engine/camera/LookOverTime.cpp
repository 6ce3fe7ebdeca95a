#include "engine/camera/LookOverTime.h"

#include <glm/common.hpp>

#include <algorithm>

namespace shoal::camera {

namespace {

constexpr float kFollow_s = 2.2f; // time constant
// Lenses scatter one to five percent, worn ports more; a bound that lies higher says that no dark thing was
// seen before bright ones.
constexpr float kUsualGlare = 0.03f, kMostGlare = 0.1f;

float shareOf(float dt_s) { return 1 - std::exp(-std::max(dt_s, 0.0f) / kFollow_s); }

} // namespace

void LookOverTime::follow(const LookEstimate& estimate, float dt_s) {
    const auto shareIf = [&](bool known) { return known ? shareOf(dt_s) : 1.0f; };
    const FilmLook& seen = estimate.look;
    const float all = shareIf(begun_);
    begun_ = true;
    for (size_t band = 0; band < kBrightnesses; ++band) {
        look_.fineNoise[band] += (seen.fineNoise[band] - look_.fineNoise[band]) * all;
        look_.coarseNoise[band] += (seen.coarseNoise[band] - look_.coarseNoise[band]) * all;
    }
    look_.black = glm::mix(look_.black, seen.black, all);
    look_.white = glm::mix(look_.white, seen.white, all);
    if (estimate.edges >= kFewEdges) {
        look_.blur_texels += (seen.blur_texels - look_.blur_texels) * shareIf(edgesSeen_);
        edgesSeen_ = true;
    }
    if (estimate.chromaKnown) {
        chromaTexels_ = glm::mix(chromaTexels_, glm::vec2(seen.chromaTexels), shareIf(chromaSeen_));
        chromaSeen_ = true;
    }
}

void LookOverTime::followGlare(float mostShare, float dt_s) {
    mostGlare_ = std::min(mostGlare_, mostShare);
    const float glare = mostGlare_ > kMostGlare ? kUsualGlare : mostGlare_;
    look_.glare += (glare - look_.glare) * (glareSeen_ ? shareOf(dt_s) : 1.0f);
    glareSeen_ = true;
}

FilmLook LookOverTime::look() const {
    if (!begun_) return {};
    FilmLook look = look_;
    look.chromaTexels = glm::ivec2(chromaTexels_ + 0.5f);
    return look;
}

} // namespace shoal::camera
