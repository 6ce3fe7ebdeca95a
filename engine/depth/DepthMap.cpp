#include "engine/depth/DepthMap.h"

#include "engine/core/Vectorise.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shoal::depth {

namespace {

// Least difference between the inverse distances of an edge's two sides, in DepthMap's steps. Neighbours on a
// slope seen at a grazing angle differ by less.
constexpr int kEdge = 8;

// Grain, caustics and coding make colours of one surface differ by about this (of 255, over all channels).
constexpr float kSameColour = 16;

constexpr size_t kLanes = 16;   // texels of the map that are processed at once
constexpr float kReach = 1.3f;  // reach of a texel's vote, in texels of the track
constexpr float kSharpness = 3; // depth blends from far to near over 1 / kSharpness of the near share

// A distance is ignored up to the first confidence and counts in full from the second on.
constexpr float kNoTrust = 0.25f, kFullTrust = 0.6f;

// Blends two rows; weight: the second's, in 256ths.
SHOAL_VECTORISE void blend(const uint16_t* above, const uint16_t* below, int weight, uint8_t* out,
                           size_t count) {
    for (size_t i = 0; i < count; ++i)
        out[i] = static_cast<uint8_t>((above[i] * (256 - weight) + below[i] * weight + (1 << 15)) >> 16);
}

// Replaces each texel by the nearest of its four neighbours if an edge lies between; columns repeat.
SHOAL_VECTORISE void widenRow(const uint8_t* above, const uint8_t* row, const uint8_t* below, size_t count,
                              uint8_t* out) {
    const auto widened = [&](size_t left, size_t x, size_t right) {
        const uint8_t most = std::max(std::max(row[left], row[right]), std::max(above[x], below[x]));
        return most - row[x] > kEdge ? most : row[x];
    };
    for (size_t x = 1; x + 1 < count; ++x) out[x] = widened(x - 1, x, x + 1);
    out[0] = widened(count - 1, 0, 1);
    out[count - 1] = widened(count - 2, count - 1, 0);
}

// Extends the range of each column by a row.
SHOAL_VECTORISE void addRow(const uint8_t* codes, size_t count, uint8_t* min, uint8_t* max) {
    for (size_t x = 0; x < count; ++x) {
        min[x] = std::min(min[x], codes[x]);
        max[x] = std::max(max[x], codes[x]);
    }
}

// The nine texels of a track around an edge, which vote.
struct Voters {
    const uint8_t* colours; // of the map's texels in the middle texel: channels are `stride` apart
    const float* nearness;  // of the same texels to each of the nine, which are `stride` apart
    size_t stride;
    const DepthEdge& edge;
    std::array<const float*, 9> means; // mean colour of each of the nine
};

// Assigns each texel of the map to the texels of the track around it that are close and share its colour:
// joint bilateral upsampling (Kopf et al. 2007), but as a vote between near and far, since no surface lies
// at the mean of their distances. Processes kLanes texels from `begin` on.
SHOAL_VECTORISE void vote(const Voters& voters, size_t begin, uint8_t* codes) {
    using Lanes = std::array<float, kLanes>;
    Lanes c0, c1, c2, farWeight, nearWeight, farSum, nearSum;
    for (size_t i = 0; i < kLanes; ++i) {
        c0[i] = voters.colours[begin + i];
        c1[i] = voters.colours[voters.stride + begin + i];
        c2[i] = voters.colours[2 * voters.stride + begin + i];
        farWeight[i] = nearWeight[i] = farSum[i] = nearSum[i] = 0;
    }
    for (size_t n = 0; n < 9; ++n) {
        Lanes& weights = voters.edge.isNear[n] ? nearWeight : farWeight;
        Lanes& sums = voters.edge.isNear[n] ? nearSum : farSum;
        const float* nearness = voters.nearness + n * voters.stride + begin;
        const float m0 = voters.means[n][0], m1 = voters.means[n][1], m2 = voters.means[n][2];
        const float inverse = voters.edge.inverse[n];
        for (size_t i = 0; i < kLanes; ++i) {
            const float d0 = c0[i] - m0, d1 = c1[i] - m1, d2 = c2[i] - m2;
            const float off = (d0 * d0 + d1 * d1 + d2 * d2) * (1 / (kSameColour * kSameColour));
            const float weight = nearness[i] / (1 + off * off) + 1e-9f; // the sum is never 0
            weights[i] += weight;
            sums[i] += weight * inverse;
        }
    }
    for (size_t i = 0; i < kLanes; ++i) {
        const float share = nearWeight[i] / (nearWeight[i] + farWeight[i]);
        const float s = std::min(std::max((share - 0.5f) * kSharpness + 0.5f, 0.0f), 1.0f);
        const float far = farSum[i] / farWeight[i], close = nearSum[i] / nearWeight[i];
        codes[i] = static_cast<uint8_t>(static_cast<int>(far + (close - far) * s + 0.5f));
    }
}

} // namespace

float DepthMap::inverse_perM(const glm::vec3& dirEnv) const {
    if (inverse.empty()) return 0;
    const int width = inverse.width, height = inverse.height;
    const glm::vec2 uv = latLongRoughly(dirEnv);
    // x starts half a texel left of the map, so it is never negative and truncation rounds it down.
    const float x = uv.x * static_cast<float>(width) + 0.5f;
    const float y =
        std::clamp(uv.y * static_cast<float>(height) - 0.5f, 0.0f, static_cast<float>(height - 1));
    const int wholeX = static_cast<int>(x), top = static_cast<int>(y);
    const float partX = x - static_cast<float>(wholeX), partY = y - static_cast<float>(top);
    const int left = wholeX == 0 ? width - 1 : wholeX - 1, right = wholeX >= width ? 0 : wholeX;
    const int bottom = std::min(top + 1, height - 1);
    const auto code = [&](int column, int row) { return static_cast<float>(*inverse.at(column, row)); };
    const float above = glm::mix(code(left, top), code(right, top), partX);
    const float below = glm::mix(code(left, bottom), code(right, bottom), partX);
    return glm::mix(above, below, partY) * perM(1);
}

// The ray's point s metres from the eye lies towards dir + eye / s from the camera: the search varies w = 1 /
// s, which is 0 at infinity. It goes from near to far, each time to where the ray would meet the surface that
// the film shows towards the point, by FILM_STEP_RAD at most, so that it passes over no wide surface. A point
// a little behind that surface is moved back to it; one far behind it has passed an edge.
glm::vec3 filmDirectionSeen(const DepthMap& map, const glm::vec3& eyeEnv, const glm::vec3& dirEnv) {
    struct Point {
        float inverse;     // inverse distance from the eye
        glm::vec3 towards; // direction from the film's camera
        float met;         // inverse distance at which the ray meets the surface seen there
    };
    const float along = glm::dot(eyeEnv, dirEnv), eye2 = glm::dot(eyeEnv, eyeEnv), eye = std::sqrt(eye2);
    const auto at = [&](float inverse) {
        const glm::vec3 towards = glm::normalize(dirEnv + eyeEnv * inverse);
        const float d = map.inverse_perM(towards);
        const float met =
            d / (std::sqrt(1 + d * d * (along * along - eye2)) - along * d); // |eye + dir / w| = 1 / d
        return Point{inverse, towards, met};
    };
    const float maxStep = static_cast<float>(FILM_STEP_RAD) / eye; // the greatest step on the map
    const float found = static_cast<float>(FILM_FOUND_RAD) / eye;  // a quarter of a texel
    const auto isMet = [&](const Point& point) { return std::abs(point.met - point.inverse) <= found; };
    Point before = at(1 / kNearest_m), point = before;
    for (int k = 0; k < FILM_MAX_STEPS; ++k) {
        if (isMet(point)) return point.towards;
        if (point.met > static_cast<float>(FILM_PASSED) * point.inverse + found) break; // far behind it
        if (point.met < point.inverse) before = point;
        point = at(std::max(point.met, point.inverse - maxStep));
    }
    const Point nearer = at(point.met);
    if (isMet(nearer)) return nearer.towards; // a step had gone past this surface
    const Point beyond = at(before.met);
    if (isMet(beyond)) return beyond.towards;
    return nearer.met < point.met ? nearer.towards : before.towards;
}

void widenNear(const DepthMap& map, DepthMap& out) {
    const int width = map.inverse.width, height = map.inverse.height;
    out.inverse.fit(width, height);
    for (int y = 0; y < height; ++y) {
        const uint8_t* above = map.inverse.at(0, std::max(y - 1, 0));
        const uint8_t* below = map.inverse.at(0, std::min(y + 1, height - 1));
        widenRow(above, map.inverse.at(0, y), below, static_cast<size_t>(width), out.inverse.at(0, y));
    }
}

void DepthRange::make(const DepthMap& map) {
    const int width = map.inverse.width, height = map.inverse.height;
    cells_.assign(static_cast<size_t>(kCells.x) * kCells.y, {});
    for (int row = 0; row < kCells.y; ++row) {
        columnMin_.assign(static_cast<size_t>(width), 255);
        columnMax_.assign(static_cast<size_t>(width), 0);
        for (int y = row * height / kCells.y; y < (row + 1) * height / kCells.y; ++y)
            addRow(map.inverse.at(0, y), columnMin_.size(), columnMin_.data(), columnMax_.data());
        for (int x = 0; x < width; ++x) {
            Codes& cell = cells_[static_cast<size_t>(row) * kCells.x + x * kCells.x / width];
            cell.min = std::min(cell.min, columnMin_[static_cast<size_t>(x)]);
            cell.max = std::max(cell.max, columnMax_[static_cast<size_t>(x)]);
        }
    }
}

DepthRange::Range DepthRange::around(const glm::vec3& dirEnv, float halfAngle) const {
    if (cells_.empty()) return {};
    constexpr float kTexel = 0.01f; // radians by which interpolation reaches beyond an edge
    const CellRange range = cellsOfCap(kCells, dirEnv, halfAngle + kTexel);
    Codes codes;
    for (int y = range.first.y; y <= range.last.y; ++y)
        for (int x = range.first.x; x <= range.last.x; ++x) {
            const Codes& cell = cells_[static_cast<size_t>(y * kCells.x + (x + 2 * kCells.x) % kCells.x)];
            codes.min = std::min(codes.min, cell.min);
            codes.max = std::max(codes.max, cell.max);
        }
    return {DepthMap::perM(codes.min), DepthMap::perM(codes.max)};
}

void DepthRefiner::weightByConfidence(const media::DepthFrame& depth) {
    coarse_.fit(depth.width, depth.height);
    constexpr float kScale = media::kMaxInverse_perM / media::kMaxDepthCode * kNearest_m * DepthMap::kSteps;
    for (int y = 0; y < depth.height; ++y)
        for (int x = 0; x < depth.width; ++x) {
            const size_t of = static_cast<size_t>(y / 2) * (depth.width / 2) + x / 2;
            const float confidence = static_cast<float>(depth.confidence[of]) / media::kMaxDepthCode;
            const float trust =
                std::clamp((confidence - kNoTrust) / (kFullTrust - kNoTrust), 0.0f, 1.0f) * kScale;
            const auto code = static_cast<float>(depth.inverse[static_cast<size_t>(y) * depth.width + x]);
            *coarse_.at(x, y) = static_cast<uint8_t>(std::min(code * trust + 0.5f, DepthMap::kSteps));
        }
}

DepthRefiner::Interpolation DepthRefiner::interpolationOf(int fine, int fineCount, int coarseCount,
                                                          bool repeats) {
    const double at = (fine + 0.5) * coarseCount / fineCount - 0.5, low = std::floor(at);
    const int first = static_cast<int>(low), weight = static_cast<int>((at - low) * 256 + 0.5);
    if (repeats) return {wrappedColumn(first, coarseCount), wrappedColumn(first + 1, coarseCount), weight};
    return {std::clamp(first, 0, coarseCount - 1), std::clamp(first + 1, 0, coarseCount - 1), weight};
}

void DepthRefiner::enlarge(const media::DepthFrame& depth, DepthMap& out) {
    weightByConfidence(depth);
    out.inverse.fit(mapWidth_, mapWidth_ / 2);
    columns_.resize(static_cast<size_t>(mapWidth_));
    for (int x = 0; x < mapWidth_; ++x)
        columns_[static_cast<size_t>(x)] = interpolationOf(x, mapWidth_, coarse_.width, true);
    wide_.fit(mapWidth_, coarse_.height);
    for (int y = 0; y < coarse_.height; ++y) {
        const uint8_t* from = coarse_.at(0, y);
        uint16_t* to = wide_.at(0, y);
        for (size_t x = 0; x < columns_.size(); ++x) {
            const auto [left, right, across] = columns_[x];
            to[x] = static_cast<uint16_t>(from[left] * (256 - across) + from[right] * across);
        }
    }
    for (int y = 0; y < mapWidth_ / 2; ++y) {
        const auto [top, bottom, down] = interpolationOf(y, mapWidth_ / 2, coarse_.height, false);
        blend(wide_.at(0, top), wide_.at(0, bottom), down, out.inverse.at(0, y), columns_.size());
    }
}

// Finds an edge where the nine inverse distances fall into two groups with a gap between: slopes have none.
bool DepthRefiner::findEdge(int x, int y, DepthEdge& edge) const {
    const std::array<int, 3> columns{wrappedColumn(x - 1, coarse_.width), x,
                                     wrappedColumn(x + 1, coarse_.width)};
    const std::array<const uint8_t*, 3> rows{coarse_.at(0, std::max(y - 1, 0)), coarse_.at(0, y),
                                             coarse_.at(0, std::min(y + 1, coarse_.height - 1))};
    int low = 255, high = 0;
    for (const uint8_t* row : rows)
        for (const int column : columns) {
            low = std::min<int>(low, row[column]);
            high = std::max<int>(high, row[column]);
        }
    if (high - low < kEdge) return false;
    int furthestNear = 255, nearestFar = 0;
    for (size_t i = 0; i < 9; ++i) {
        const int inverse = rows[i / 3][columns[i % 3]];
        edge.inverse[i] = static_cast<float>(inverse);
        edge.isNear[i] = 2 * inverse > low + high;
        if (edge.isNear[i])
            furthestNear = std::min(furthestNear, inverse);
        else
            nearestFar = std::max(nearestFar, inverse);
    }
    edge.x = x, edge.y = y;
    return furthestNear - nearestFar >= kEdge;
}

// Computes nearness_ of the map's texels in a track texel to that texel and its eight neighbours: along each
// axis 1 at the middle, falling to 0 at kReach texels of the track.
void DepthRefiner::placeTexels(int scale) {
    const auto count = static_cast<size_t>(scale) * static_cast<size_t>(scale);
    padded_ = (count + kLanes - 1) / kLanes * kLanes;
    nearness_.assign(9 * padded_, 0);
    const auto along = [&](int fine, int neighbour) {
        const float off = (static_cast<float>(fine) + 0.5f) / static_cast<float>(scale) - 0.5f;
        return std::max(1 - std::abs(off - static_cast<float>(neighbour)) / kReach, 0.0f);
    };
    for (int n = 0; n < 9; ++n)
        for (int y = 0; y < scale; ++y)
            for (int x = 0; x < scale; ++x)
                nearness_[n * padded_ + y * scale + x] = along(x, n % 3 - 1) * along(y, n / 3 - 1);
}

// Reads the film's colours at the map's texels, channel by channel for each wanted texel of the track. Each
// is the mean of four pixels of the film, if the film is fine enough.
void DepthRefiner::readColours(const light::FrameView& film, int scale) {
    colours_.resize(static_cast<size_t>(coarse_.width) * coarse_.height * 3 * padded_);
    means_.fit(coarse_.width, coarse_.height);
    filmColumns_.resize(static_cast<size_t>(mapWidth_));
    for (size_t x = 0; x < filmColumns_.size(); ++x)
        filmColumns_[x] = 3 * static_cast<int>(x * static_cast<size_t>(film.width) / filmColumns_.size());
    const int right = 3 * (film.width / mapWidth_ - 1);
    const ptrdiff_t down = (film.height / (mapWidth_ / 2) - 1) * film.rowStride;
    for (int cy = 0; cy < coarse_.height; ++cy)
        for (int cx = 0; cx < coarse_.width; ++cx) {
            if (!*wanted_.at(cx, cy)) continue;
            uint8_t* colours = colours_.data() + (static_cast<size_t>(cy) * coarse_.width + cx) * 3 * padded_;
            int sums[3] = {0, 0, 0};
            for (int fy = 0; fy < scale; ++fy) {
                const int top = (cy * scale + fy) * film.height / (mapWidth_ / 2);
                const uint8_t* row = film.pixels + top * film.rowStride;
                for (int fx = 0; fx < scale; ++fx) {
                    const uint8_t* a = row + filmColumns_[static_cast<size_t>(cx * scale + fx)];
                    for (int c = 0; c < 3; ++c, ++a) {
                        const int sum = a[0] + a[right] + a[down] + a[down + right];
                        colours[c * padded_ + fy * scale + fx] = static_cast<uint8_t>(sum / 4);
                        sums[c] += sum;
                    }
                }
            }
            for (int c = 0; c < 3; ++c)
                means_.at(cx, cy)[c] = static_cast<float>(sums[c]) / static_cast<float>(4 * scale * scale);
        }
}

void DepthRefiner::split(const DepthEdge& edge, int scale, DepthMap& out) const {
    const auto count = static_cast<size_t>(scale) * static_cast<size_t>(scale);
    const size_t texel = static_cast<size_t>(edge.y) * coarse_.width + edge.x;
    Voters voters{colours_.data() + texel * 3 * padded_, nearness_.data(), padded_, edge, {}};
    for (size_t n = 0; n < 9; ++n) {
        const int x = wrappedColumn(edge.x + static_cast<int>(n % 3) - 1, coarse_.width);
        const int y = std::clamp(edge.y + static_cast<int>(n / 3) - 1, 0, coarse_.height - 1);
        voters.means[n] = means_.at(x, y);
    }
    std::array<uint8_t, kLanes> codes;
    for (size_t begin = 0; begin < count; begin += kLanes) {
        vote(voters, begin, codes.data());
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
    placeTexels(scale);
    wanted_.fit(coarse_.width, coarse_.height);
    std::ranges::fill(wanted_.pixels, uint8_t{0});
    edges_.clear();
    edges_.reserve(coarse_.pixels.size());
    DepthEdge edge;
    for (int y = 0; y < coarse_.height; ++y)
        for (int x = 0; x < coarse_.width; ++x) {
            if (!findEdge(x, y, edge)) continue;
            edges_.push_back(edge);
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    *wanted_.at(wrappedColumn(x + dx, coarse_.width),
                                std::clamp(y + dy, 0, coarse_.height - 1)) = 1;
        }
    readColours(film, scale);
    for (const DepthEdge& each : edges_) split(each, scale, out);
}

} // namespace shoal::depth
