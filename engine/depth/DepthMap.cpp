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

constexpr size_t kLanes = 16;      // texels of the map that are worked on at once
constexpr float kReach = 1.5f;     // texels of the track
constexpr float kSharpness = 2.5f; // of the vote: from one side to the other within 1 / this

// Confidence below the first: nothing is known; above the second: all is believed.
constexpr float kDoubted = 0.25f, kBelieved = 0.6f;

int wrapped(int x, int width) { return x < 0 ? x + width : x >= width ? x - width : x; }

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
    row_.resize(static_cast<size_t>(coarse_.width));
    for (int y = 0; y < mapWidth_ / 2; ++y) {
        const auto [top, bottom, down] = between(y, mapWidth_ / 2, coarse_.height, false);
        const uint8_t *above = coarse_.at(0, top), *below = coarse_.at(0, bottom);
        for (size_t x = 0; x < row_.size(); ++x)
            row_[x] = static_cast<uint16_t>(above[x] * (256 - down) + below[x] * down);
        uint8_t* row = out.inverse.at(0, y);
        for (int x = 0; x < mapWidth_; ++x) {
            const auto [left, right, across] = columns_[static_cast<size_t>(x)];
            const int mixed =
                row_[static_cast<size_t>(left)] * (256 - across) + row_[static_cast<size_t>(right)] * across;
            row[x] = static_cast<uint8_t>((mixed + (1 << 15)) >> 16);
        }
    }
}

// Where their inverse distances fall into two groups with a gap between. The larger gap is the edge: a slope
// has none, however steep.
bool DepthRefiner::findEdge(int x, int y, Edge& edge) const {
    const std::array<int, 3> columns{wrapped(x - 1, coarse_.width), x, wrapped(x + 1, coarse_.width)};
    const std::array<const uint8_t*, 3> rows{coarse_.at(0, std::max(y - 1, 0)), coarse_.at(0, y),
                                             coarse_.at(0, std::min(y + 1, coarse_.height - 1))};
    std::array<uint8_t, 9> sorted;
    for (size_t i = 0; i < 9; ++i) sorted[i] = rows[i / 3][columns[i % 3]];
    const auto [low, high] = std::minmax_element(sorted.begin(), sorted.end());
    if (*high - *low < kEdge) return false;
    for (size_t i = 0; i < 9; ++i) edge.inverse[i] = sorted[i];
    std::ranges::sort(sorted);
    int gap = 0;
    float between = 0;
    for (size_t i = 1; i < 9; ++i)
        if (sorted[i] - sorted[i - 1] > gap) {
            gap = sorted[i] - sorted[i - 1];
            between = 0.5f * static_cast<float>(sorted[i] + sorted[i - 1]);
        }
    if (gap < kEdge) return false;
    edge.x = x, edge.y = y;
    for (size_t i = 0; i < 9; ++i) edge.isNear[i] = edge.inverse[i] > between;
    return true;
}

// Of each of the map's texels in one of the track, how near it is to each of the nine around: 1 in its
// middle, 0 from one and a half texels of the track on, along both axes.
void DepthRefiner::placeTexels(int scale) {
    const auto count = static_cast<size_t>(scale) * static_cast<size_t>(scale);
    const size_t padded = (count + kLanes - 1) / kLanes * kLanes;
    nearness_.assign(9 * padded, 0);
    const auto along = [&](int fine, int neighbour) {
        const float off = (static_cast<float>(fine) + 0.5f) / static_cast<float>(scale) - 0.5f;
        return std::max(1 - std::abs(off - static_cast<float>(neighbour)) / kReach, 0.0f);
    };
    for (int n = 0; n < 9; ++n)
        for (int y = 0; y < scale; ++y)
            for (int x = 0; x < scale; ++x)
                nearness_[static_cast<size_t>(n) * padded + static_cast<size_t>(y * scale + x)] =
                    along(x, n % 3 - 1) * along(y, n / 3 - 1);
}

// Means of the film over the map's texels, channel by channel for each texel of the track that is wanted.
void DepthRefiner::readColours(const light::FrameView& film, int scale) {
    const auto count = static_cast<size_t>(scale) * static_cast<size_t>(scale);
    const size_t padded = (count + kLanes - 1) / kLanes * kLanes;
    colours_.resize(static_cast<size_t>(coarse_.width) * coarse_.height * 3 * padded);
    means_.fit(coarse_.width, coarse_.height);
    const int step = std::max(film.width / mapWidth_, 1), stride = step > 1 ? step - 1 : 1;
    for (int cy = 0; cy < coarse_.height; ++cy)
        for (int cx = 0; cx < coarse_.width; ++cx) {
            if (!*wanted_.at(cx, cy)) continue;
            uint8_t* colours = colours_.data() + (static_cast<size_t>(cy) * coarse_.width + cx) * 3 * padded;
            int sums[3] = {0, 0, 0};
            for (int fy = 0; fy < scale; ++fy)
                for (int fx = 0; fx < scale; ++fx) {
                    const auto left = static_cast<int64_t>(cx * scale + fx) * film.width / mapWidth_;
                    const auto top = static_cast<int64_t>(cy * scale + fy) * film.height / (mapWidth_ / 2);
                    const uint8_t* a = film.pixels + top * film.rowStride + 3 * left;
                    const uint8_t* b = step > 1 ? a + stride * film.rowStride : a;
                    const int right = step > 1 ? 3 * stride : 0;
                    for (size_t c = 0; c < 3; ++c) {
                        const auto sum = a[c] + a[c + right] + b[c] + b[c + right];
                        colours[c * padded + static_cast<size_t>(fy * scale + fx)] =
                            static_cast<uint8_t>(sum / 4);
                        sums[c] += sum;
                    }
                }
            for (size_t c = 0; c < 3; ++c)
                means_.at(cx, cy)[c] = static_cast<float>(sums[c]) / (4 * static_cast<float>(count));
        }
}

// Each texel of the map goes with those of the track around it that are near and whose colour it has: joint
// bilateral upsampling (Kopf et al. 2007), but as a vote between what is near and what is far, since a mean
// of their distances is where nothing is.
void DepthRefiner::split(const Edge& edge, int scale, DepthMap& out) const {
    const auto count = static_cast<size_t>(scale) * static_cast<size_t>(scale);
    const size_t padded = (count + kLanes - 1) / kLanes * kLanes;
    const uint8_t* colours =
        colours_.data() + (static_cast<size_t>(edge.y) * coarse_.width + edge.x) * 3 * padded;
    std::array<const float*, 9> means;
    for (size_t n = 0; n < 9; ++n)
        means[n] = means_.at(wrapped(edge.x + static_cast<int>(n % 3) - 1, coarse_.width),
                             std::clamp(edge.y + static_cast<int>(n / 3) - 1, 0, coarse_.height - 1));
    for (size_t begin = 0; begin < count; begin += kLanes) {
        using Lanes = std::array<float, kLanes>;
        Lanes c0, c1, c2, farWeight, nearWeight, farSum, nearSum;
        for (size_t i = 0; i < kLanes; ++i) {
            c0[i] = colours[begin + i];
            c1[i] = colours[padded + begin + i];
            c2[i] = colours[2 * padded + begin + i];
            farWeight[i] = nearWeight[i] = farSum[i] = nearSum[i] = 0;
        }
        for (size_t n = 0; n < 9; ++n) {
            Lanes& weights = edge.isNear[n] ? nearWeight : farWeight;
            Lanes& sums = edge.isNear[n] ? nearSum : farSum;
            const float *nearness = nearness_.data() + n * padded + begin, *mean = means[n];
            const float inverse = edge.inverse[n];
            for (size_t i = 0; i < kLanes; ++i) {
                const float d0 = c0[i] - mean[0], d1 = c1[i] - mean[1], d2 = c2[i] - mean[2];
                const float off = (d0 * d0 + d1 * d1 + d2 * d2) * (1 / (kSameColour * kSameColour));
                const float weight = nearness[i] / (1 + off * off) + 1e-9f;
                weights[i] += weight;
                sums[i] += weight * inverse;
            }
        }
        std::array<uint8_t, kLanes> codes;
        for (size_t i = 0; i < kLanes; ++i) {
            const float share = nearWeight[i] / (nearWeight[i] + farWeight[i]);
            const float s = std::clamp((share - 0.5f) * kSharpness + 0.5f, 0.0f, 1.0f);
            const float far = farSum[i] / farWeight[i], close = nearSum[i] / nearWeight[i];
            codes[i] = static_cast<uint8_t>(static_cast<int>(far + (close - far) * s + 0.5f));
        }
        for (size_t i = 0; i < std::min(kLanes, count - begin); ++i) {
            const int at = static_cast<int>(begin + i);
            *out.inverse.at(edge.x * scale + at % scale, edge.y * scale + at / scale) = codes[i];
        }
    }
}

void DepthRefiner::refine(const media::DepthFrame& depth, const light::FrameView& film, DepthMap& out) {
    enlarge(depth, out);
    const int scale = mapWidth_ / coarse_.width;
    if (scale < 2 || film.width < mapWidth_ || film.height < mapWidth_ / 2) return;
    if (placedScale_ != scale) placeTexels(scale);
    placedScale_ = scale;
    wanted_.fit(coarse_.width, coarse_.height);
    std::ranges::fill(wanted_.pixels, uint8_t{0});
    edges_.clear();
    Edge edge;
    for (int y = 0; y < coarse_.height; ++y)
        for (int x = 0; x < coarse_.width; ++x) {
            if (!findEdge(x, y, edge)) continue;
            edges_.push_back(edge);
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    *wanted_.at(wrapped(x + dx, coarse_.width), std::clamp(y + dy, 0, coarse_.height - 1)) =
                        1;
        }
    readColours(film, scale);
    for (const Edge& each : edges_) split(each, scale, out);
}

} // namespace shoal::depth
