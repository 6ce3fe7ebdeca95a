#include "engine/depth/DepthMap.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace shoal::depth {

namespace {

constexpr float kSteps = 255; // of an inverse distance of 1 / kNearest_m

// Inverse distances that differ by more than this within neighbouring texels of a track are an edge: a slope
// seen at a small angle differs less.
constexpr int kEdge = 8;

// Colours of one surface differ by about this much (of 255, in all channels together) by grain, caustics and
// coding.
constexpr float kSameColour = 20;

// Confidence below the first: nothing is known; above the second: all is believed.
constexpr float kDoubted = 0.25f, kBelieved = 0.6f;

int wrapped(int x, int width) { return x < 0 ? x + width : x >= width ? x - width : x; }

// Means of the film over a picture's texels, of at most 4 x 4 pixels of each.
void shrink(const light::FrameView& film, ImageRgb8& out) {
    const int stepX = std::max(film.width / out.width, 1), stepY = std::max(film.height / out.height, 1);
    const int strideX = std::max(stepX / 4, 1), strideY = std::max(stepY / 4, 1);
    const int count = ((stepX + strideX - 1) / strideX) * ((stepY + strideY - 1) / strideY);
    for (int y = 0; y < out.height; ++y) {
        const int top = static_cast<int>(static_cast<int64_t>(y) * film.height / out.height);
        for (int x = 0; x < out.width; ++x) {
            const int left = static_cast<int>(static_cast<int64_t>(x) * film.width / out.width);
            int b = 0, g = 0, r = 0;
            for (int dy = 0; dy < stepY; dy += strideY) {
                const uint8_t* row = film.pixels + (top + dy) * film.rowStride + 3 * left;
                for (int dx = 0; dx < stepX; dx += strideX)
                    b += row[3 * dx], g += row[3 * dx + 1], r += row[3 * dx + 2];
            }
            uint8_t* mean = out.at(x, y);
            mean[0] = static_cast<uint8_t>(b / count);
            mean[1] = static_cast<uint8_t>(g / count);
            mean[2] = static_cast<uint8_t>(r / count);
        }
    }
}

float colourDistance2(const uint8_t* a, const uint8_t* b) {
    const int d0 = a[0] - b[0], d1 = a[1] - b[1], d2 = a[2] - b[2];
    return static_cast<float>(d0 * d0 + d1 * d1 + d2 * d2);
}

} // namespace

float DepthMap::inverse_perM(const glm::vec3& dirEnv) const {
    if (inverse.empty()) return 0;
    const glm::vec2 at =
        latLongFromDirection(dirEnv) * glm::vec2(inverse.width, inverse.height) - glm::vec2(0.5f);
    const glm::vec2 low = glm::floor(at), part = at - low;
    const int left = wrapped(static_cast<int>(low.x), inverse.width);
    const int right = wrapped(left + 1, inverse.width);
    const int top = std::clamp(static_cast<int>(low.y), 0, inverse.height - 1);
    const int bottom = std::clamp(static_cast<int>(low.y) + 1, 0, inverse.height - 1);
    const auto code = [&](int x, int y) { return static_cast<float>(*inverse.at(x, y)); };
    const float above = glm::mix(code(left, top), code(right, top), part.x);
    const float below = glm::mix(code(left, bottom), code(right, bottom), part.x);
    return glm::mix(above, below, part.y) / (kSteps * kNearest_m);
}

// The ray's point s metres from the eye lies towards eye / s + dir from the camera: 1 / s, which is all that
// is iterated, is 0 for what is far away. What the film shows there, at the distance D, is met by the ray
// where |eye + s dir| = D.
Seen searchAlong(const DepthMap& map, const glm::vec3& eyeEnv, const glm::vec3& dirEnv) {
    constexpr int kMaxSteps = 6;
    constexpr float kFound_rad = 2e-3f; // a third of a texel of a map of 1024
    const float along = glm::dot(eyeEnv, dirEnv), eye2 = glm::dot(eyeEnv, eyeEnv), eye = std::sqrt(eye2);
    float inverse = 1 / kNearest_m;
    Seen last{dirEnv, 0};
    for (int step = 0; step < kMaxSteps; ++step) {
        const glm::vec3 towards = glm::normalize(dirEnv + eyeEnv * inverse);
        const Seen seen{towards, map.inverse_perM(towards)};
        const float d = seen.inverse_perM;
        const float next = d > 0 ? d / (std::sqrt(1 + d * d * (along * along - eye2)) - along * d) : 0;
        if (std::abs(next - inverse) * eye < kFound_rad) return seen;
        if (step == kMaxSteps - 1) return seen.inverse_perM < last.inverse_perM ? seen : last;
        last = seen;
        inverse = next;
    }
    return last;
}

void DepthRefiner::readTrusted(const media::DepthFrame& depth) {
    coarse_.fit(depth.width, depth.height);
    constexpr float kScale = media::kMaxInverse_perM / media::kMaxDepthCode * kNearest_m * kSteps;
    for (int y = 0; y < depth.height; ++y)
        for (int x = 0; x < depth.width; ++x) {
            const size_t of = static_cast<size_t>(y / 2) * (depth.width / 2) + x / 2;
            const float confidence = static_cast<float>(depth.confidence[of]) / media::kMaxDepthCode;
            const float trust =
                std::clamp((confidence - kDoubted) / (kBelieved - kDoubted), 0.0f, 1.0f) * kScale;
            const auto code = static_cast<float>(depth.inverse[static_cast<size_t>(y) * depth.width + x]);
            *coarse_.at(x, y) = static_cast<uint8_t>(std::min(code * trust + 0.5f, kSteps));
        }
}

DepthRefiner::Between DepthRefiner::between(int fine, int fineCount, int coarseCount, bool repeats) {
    const float at =
        (static_cast<float>(fine) + 0.5f) * static_cast<float>(coarseCount) / static_cast<float>(fineCount) -
        0.5f;
    const float low = std::floor(at);
    const int first = static_cast<int>(low), weight = static_cast<int>((at - low) * 256 + 0.5f);
    if (repeats) return {wrapped(first, coarseCount), wrapped(first + 1, coarseCount), weight};
    return {std::clamp(first, 0, coarseCount - 1), std::clamp(first + 1, 0, coarseCount - 1), weight};
}

void DepthRefiner::enlarge(const media::DepthFrame& depth, DepthMap& out) {
    readTrusted(depth);
    out.inverse.fit(mapWidth_, mapWidth_ / 2);
    columns_.resize(static_cast<size_t>(mapWidth_));
    for (int x = 0; x < mapWidth_; ++x)
        columns_[static_cast<size_t>(x)] = between(x, mapWidth_, coarse_.width, true);
    for (int y = 0; y < mapWidth_ / 2; ++y) {
        const auto [top, bottom, down] = between(y, mapWidth_ / 2, coarse_.height, false);
        const uint8_t *above = coarse_.at(0, top), *below = coarse_.at(0, bottom);
        uint8_t* row = out.inverse.at(0, y);
        for (int x = 0; x < mapWidth_; ++x) {
            const auto [left, right, across] = columns_[static_cast<size_t>(x)];
            const int a = above[left] * (256 - across) + above[right] * across;
            const int b = below[left] * (256 - across) + below[right] * across;
            row[x] = static_cast<uint8_t>((a * (256 - down) + b * down + (1 << 15)) >> 16);
        }
    }
}

// Where surfaces meet, each texel of the map goes with those of the track around it that are near and whose
// colour it has: joint bilateral upsampling (Kopf et al. 2007), but as a vote between what is near and what
// is far, since a mean of their distances is where nothing is.
void DepthRefiner::refine(const media::DepthFrame& depth, const light::FrameView& film, DepthMap& out) {
    enlarge(depth, out);
    if (film.width < mapWidth_ || film.height < mapWidth_ / 2) return;
    guide_.fit(mapWidth_, mapWidth_ / 2);
    shrink(film, guide_);
    coarseGuide_.fit(coarse_.width, coarse_.height);
    shrink({guide_.at(0, 0), guide_.width, guide_.height, guide_.width * ptrdiff_t{3}, film.bgr},
           coarseGuide_);

    const int scale = mapWidth_ / coarse_.width;
    if (scale < 2) return;
    for (int cy = 0; cy < coarse_.height; ++cy)
        for (int cx = 0; cx < coarse_.width; ++cx) {
            struct Neighbour {
                float x, y; // of its middle, in texels of the map from the cell's corner
                float inverse;
                const uint8_t* colour;
            };
            std::array<Neighbour, 9> around;
            float low = kSteps, high = 0;
            size_t n = 0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    const int x = wrapped(cx + dx, coarse_.width),
                              y = std::clamp(cy + dy, 0, coarse_.height - 1);
                    const auto inverse = static_cast<float>(*coarse_.at(x, y));
                    around[n++] = {(static_cast<float>(dx) + 0.5f) * static_cast<float>(scale),
                                   (static_cast<float>(dy) + 0.5f) * static_cast<float>(scale), inverse,
                                   coarseGuide_.at(x, y)};
                    low = std::min(low, inverse), high = std::max(high, inverse);
                }
            if (high - low < kEdge) continue;
            const float middle = 0.5f * (low + high), reach = 1.5f * static_cast<float>(scale);
            for (int fy = 0; fy < scale; ++fy)
                for (int fx = 0; fx < scale; ++fx) {
                    const int x = cx * scale + fx, y = cy * scale + fy;
                    const uint8_t* colour = guide_.at(x, y);
                    float weights[2] = {1e-9f, 1e-9f}, sums[2] = {low * 1e-9f, high * 1e-9f};
                    for (const Neighbour& each : around) {
                        const float across = std::abs(static_cast<float>(fx) + 0.5f - each.x) / reach;
                        const float down = std::abs(static_cast<float>(fy) + 0.5f - each.y) / reach;
                        if (across >= 1 || down >= 1) continue;
                        const float off = colourDistance2(colour, each.colour) / (kSameColour * kSameColour);
                        const float weight = (1 - across) * (1 - down) / (1 + off * off);
                        const bool isNear = each.inverse > middle;
                        weights[isNear] += weight;
                        sums[isNear] += weight * each.inverse;
                    }
                    const float share = weights[1] / (weights[0] + weights[1]);
                    const float s = glm::smoothstep(0.3f, 0.7f, share);
                    *out.inverse.at(x, y) =
                        static_cast<uint8_t>(glm::mix(sums[0] / weights[0], sums[1] / weights[1], s) + 0.5f);
                }
        }
}

} // namespace shoal::depth
