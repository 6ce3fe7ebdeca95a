#include "engine/light/Pyramid.h"

#include "engine/core/Vectorise.h"
#include "engine/light/BlockMeans.h"
#include "engine/math/Colour.h"
#include "engine/math/LatLong.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace shoal::light {

namespace {

// Decodes a row of bytes by radianceFromDisplay().
SHOAL_VECTORISE
void decodeRow(const uint8_t* __restrict bytes, int width, bool bgr, float* __restrict rgb) {
    constexpr float kUnit = 1.0f / 255.0f;
    for (int i = 0; i < 3 * width; ++i) rgb[i] = static_cast<float>(bytes[i]) * kUnit;
    for (int x = 0; x < width; ++x) { // a separate loop, and no address from bgr: both are vectorised
        const float first = rgb[3 * x], g = rgb[3 * x + 1], last = rgb[3 * x + 2];
        const glm::vec3 radiance = radianceFromDisplay({bgr ? last : first, g, bgr ? first : last});
        for (int c = 0; c < 3; ++c) rgb[3 * x + c] = radiance[c];
    }
}

// Decodes a row of sRGB bytes to linear RGB.
void decodeLinearRow(const uint8_t* __restrict bytes, int width, bool bgr, float* __restrict rgb) {
    const std::array<float, 256>& linear = math::linearOfByte();
    const int redAt = bgr ? 2 : 0;
    for (int x = 0; x < width; ++x) {
        rgb[3 * x] = linear[bytes[3 * x + redAt]];
        rgb[3 * x + 1] = linear[bytes[3 * x + 1]];
        rgb[3 * x + 2] = linear[bytes[3 * x + 2 - redAt]];
    }
}

// Returns the least and the greatest luminance of a frame's decoded pixels. row: holds a row of it.
glm::vec2 luminanceRange(const FrameView& frame, std::vector<float>& row) {
    glm::vec2 range(1, 0);
    for (int y = 0; y < frame.height; ++y) {
        decodeLinearRow(frame.row(y), frame.width, frame.bgr, row.data());
        for (size_t i = 0; i < row.size(); i += 3) {
            const float l = linearLuminance({row[i], row[i + 1], row[i + 2]});
            range = {std::min(range.x, l), std::max(range.y, l)};
        }
    }
    return range;
}

// Applies the operator of Akyuz or of Landis to a decoded row. range: luminanceRange(), for Akyuz.
void expandRow(FrameRadiance from, const glm::vec2& range, std::vector<float>& row) {
    for (size_t i = 0; i < row.size(); i += 3) {
        const glm::vec3 decoded(row[i], row[i + 1], row[i + 2]);
        const glm::vec3 radiance = from == FrameRadiance::Landis ? landisRadiance(decoded)
                                                                 : akyuzRadiance(decoded, range.x, range.y);
        for (int c = 0; c < 3; ++c) row[i + static_cast<size_t>(c)] = radiance[c];
    }
}

// Writes each pixel's clippedSteps() times `unit`; returns the sum of the steps, without the factor.
SHOAL_VECTORISE
int decodeClippedRow(const uint8_t* __restrict bytes, int width, float unit, float* __restrict out) {
    int sum = 0;
    for (int x = 0; x < width; ++x) {
        const int steps = clippedSteps(bytes + 3 * x);
        sum += steps;
        out[x] = unit * static_cast<float>(steps);
    }
    return sum;
}

SHOAL_VECTORISE
void addClippedBlocks(const float* __restrict clipped, const glm::vec3& white, int width,
                      float* __restrict out) {
    for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c) out[3 * x + c] += white[c] * clipped[x];
}

// Averages every kFactor texels of a row.
template <int kFactor>
SHOAL_VECTORISE void narrowBy(const float* __restrict in, int width, float* __restrict out) {
    for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c) {
            float sum = 0;
            for (int i = 0; i < kFactor; ++i) sum += in[3 * (kFactor * x + i) + c];
            out[3 * x + c] = sum / kFactor;
        }
}

SHOAL_VECTORISE
void addScaled(const float* __restrict in, float weight, int count, float* __restrict out) {
    for (int i = 0; i < count; ++i) out[i] += weight * in[i];
}

SHOAL_VECTORISE
void halveRow(const float* __restrict top, const float* __restrict bottom, float topWeight,
              float bottomWeight, int width, float* __restrict out) {
    constexpr int kTexels = 128; // output texels of one pass
    float mixed[6 * kTexels];
    for (int first = 0; first < width; first += kTexels) {
        const int count = std::min(kTexels, width - first);
        for (int i = 0; i < 6 * count; ++i)
            mixed[i] = topWeight * top[6 * first + i] + bottomWeight * bottom[6 * first + i];
        for (int x = 0; x < count; ++x)
            for (int c = 0; c < 3; ++c) out[3 * (first + x) + c] = mixed[6 * x + c] + mixed[6 * x + 3 + c];
    }
}

// Returns the value clamped to 0 .. kMaxRadianceIn; infinity becomes kMaxHalf, NaN 0.
float repaired(float value) {
    if (!(value > 0)) return 0;
    return std::isinf(value) ? kMaxHalf : std::min(value, kMaxRadianceIn);
}

// Resizes the levels; a level that already has its size keeps its values.
void fitLevels(int width, RadiancePyramid& pyramid) {
    const auto count = static_cast<size_t>(std::bit_width(static_cast<unsigned>(width)) - 1);
    pyramid.levels.resize(count);
    for (size_t k = 0; k < count; ++k) pyramid.levels[k].fit(width >> k, width >> (k + 1));
}

void halveAll(RadiancePyramid& pyramid) {
    for (size_t k = 1; k < pyramid.levels.size(); ++k) halve(pyramid.levels[k - 1], pyramid.levels[k]);
}

} // namespace

int baseWidthFor(int sourceWidth, int askedWidth) {
    const int maximum = std::max(std::min(sourceWidth, askedWidth), kMinBaseWidth);
    return static_cast<int>(std::bit_floor(static_cast<unsigned>(maximum)));
}

void halve(const ImageRgbF& in, ImageRgbF& out) {
    assert(in.width >= 4 && in.height >= 2);
    out.fit(in.width / 2, in.height / 2);
    // A row's solid angle is proportional to the cosine of its central latitude. Two rows that meet at
    // latitude m have the shares (1 -+ tan m tan d) / 2, where d is half a row's height.
    const double half = std::tan(0.5 * std::numbers::pi / in.height);
    for (int y = 0; y < out.height; ++y) {
        const double more = half * std::tan(std::numbers::pi * (0.5 - (y + 0.5) / out.height));
        halveRow(in.at(0, 2 * y), in.at(0, 2 * y + 1), static_cast<float>(0.25 * (1 - more)),
                 static_cast<float>(0.25 * (1 + more)), out.width, out.at(0, y));
    }
}

// Computes shares in integers, so that no texel is left out or counted twice: in units of 1 / (source *
// target), source edges are multiples of `target`, and target edges of `source`. edge(position): a decreasing
// function whose difference between two target edges is the measure of the band between them.
template <class Edge>
std::vector<PyramidMaker::Share> PyramidMaker::sharesOf(int source, int target, Edge&& edge) {
    std::vector<Share> shares;
    for (int from = 0; from < source; ++from) {
        const int64_t begin = int64_t{from} * target, end = begin + target;
        for (int64_t at = begin; at < end;) {
            const int64_t to = at / source, next = std::min(end, (to + 1) * source);
            const double part =
                edge(static_cast<double>(at) / source) - edge(static_cast<double>(next) / source);
            const double whole = edge(static_cast<double>(to)) - edge(static_cast<double>(to + 1));
            shares.push_back({from, static_cast<int>(to), static_cast<float>(part / whole)});
            at = next;
        }
    }
    assert(shares.back().to == target - 1);
    return shares;
}

void PyramidMaker::prepare(int sourceWidth, int sourceHeight, int askedWidth, RadiancePyramid& out) {
    assert(sourceWidth > 0 && sourceHeight > 0);
    const int width = baseWidthFor(sourceWidth, askedWidth), height = width / 2;
    fitLevels(width, out);
    std::ranges::fill(out.levels[0].pixels, 0.0f);
    if (sourceWidth == sourceWidth_ && sourceHeight == sourceHeight_ && width == baseWidth_) return;
    sourceWidth_ = sourceWidth, sourceHeight_ = sourceHeight, baseWidth_ = width;

    rows_ = sharesOf(sourceHeight, height, [&](double row) { return sineOfRow(row, height); });
    columns_ = sharesOf(sourceWidth, width, [](double column) { return -column; });
    row_.resize(static_cast<size_t>(sourceWidth) * 3);
    clippedRow_.resize(sourceWidth);
    narrow_.resize(static_cast<size_t>(width) * 3);
}

// Returns the row at the base's width. The usual sizes have loops of their own; shares serve all others.
const float* PyramidMaker::narrowRow() {
    if (sourceWidth_ == baseWidth_) return row_.data();
    if (sourceWidth_ == 2 * baseWidth_) {
        narrowBy<2>(row_.data(), baseWidth_, narrow_.data());
    } else if (sourceWidth_ == 4 * baseWidth_) {
        narrowBy<4>(row_.data(), baseWidth_, narrow_.data());
    } else {
        std::ranges::fill(narrow_, 0.0f);
        for (const Share& share : columns_)
            for (int c = 0; c < 3; ++c) narrow_[3 * share.to + c] += share.weight * row_[3 * share.from + c];
    }
    return narrow_.data();
}

// Resamples the source into `base`. decodeRow(y): decodes row y into row_; false if it is all zeros.
template <class DecodeRow> void PyramidMaker::addRows(DecodeRow&& decodeRow, ImageRgbF& base) {
    size_t share = 0;
    for (int y = 0; y < sourceHeight_; ++y) {
        const float* const row = decodeRow(y) ? narrowRow() : nullptr;
        for (; share < rows_.size() && rows_[share].from == y; ++share)
            if (row) addScaled(row, rows_[share].weight, base.width * 3, base.at(0, rows_[share].to));
    }
}

// Finds the clipped light's gain, and returns its tint. clippedRow(y): returns row y above the horizon, of
// `width` clipped shares. It is called twice a row; the second result is multiplied by the densities.
template <class ClippedRow>
glm::vec3 PyramidMaker::measureClipped(int width, int height, const ImageRgbF& decoded,
                                       ClippedRow&& clippedRow) {
    const int above = (height + 1) / 2;
    density_.begin(width, height);
    for (int y = 0; y < above; ++y) density_.addRow(y, clippedRow(y));
    density_.finish();
    double irradiance = 0;
    for (int y = 0; y < above; ++y)
        irradiance += levelIrradiance(y, width, height) * double{density_.weigh(y, clippedRow(y))};
    clippedGain_ = clippedGainOf(decoded, irradiance);
    return clippedTintOf(decoded);
}

void PyramidMaker::addClipped(const FrameView& frame, ImageRgbF& base) {
    // Decodes a row into clippedRow_, a fully clipped pixel as `white`; returns whether any is clipped.
    const auto decode = [&](int y, float white) {
        return decodeClippedRow(frame.row(y), frame.width, white / kClippedSteps, clippedRow_.data()) > 0;
    };
    const auto share = [&](int y) { return clippedShares_[y]; };
    const glm::vec3 tint = measureClipped(frame.width, frame.height, base, [&](int y) {
        decode(y, share(y));
        return clippedRow_.data();
    });
    addRows(
        [&](int y) {
            if (y >= (frame.height + 1) / 2 || !decode(y, (clippedGain_.of(y, frame.height) - 1) * share(y)))
                return false;
            density_.weigh(y, clippedRow_.data());
            for (int x = 0; x < frame.width; ++x)
                for (int c = 0; c < 3; ++c) row_[3 * x + c] = tint[c] * clippedRow_[x];
            return true;
        },
        base);
}

void PyramidMaker::makeBlocks(const FrameView& frame, ImageRgbF& blocks, FrameRadiance from) {
    if (from == FrameRadiance::Auto) clippedBlocks_.fit(blocks.width, blocks.height);
    makeBlockMeans(frame, from, blockRows_, blocks, fastestBlockLoop(), clippedShares_, &clippedBlocks_);
    if (from != FrameRadiance::Auto) return;
    const glm::vec3 tint =
        measureClipped(blocks.width, blocks.height, blocks, [&](int y) { return clippedBlocks_.at(0, y); });
    for (int y = 0; y < (blocks.height + 1) / 2; ++y)
        addClippedBlocks(clippedBlocks_.at(0, y), (clippedGain_.of(y, blocks.height) - 1) * tint,
                         blocks.width, blocks.at(0, y));
}

// Averages 4 x 4 blocks first, so that a sixteenth is left to resample. Returns false if sizes rule it out.
bool PyramidMaker::makeByBlocks(const FrameView& frame, int askedWidth, RadiancePyramid& out,
                                FrameRadiance from) {
    const int base = baseWidthFor(frame.width, askedWidth);
    if (frame.width % 4 || frame.height % 4 || frame.width < 4 * base || frame.height < 2 * base)
        return false;
    if (blockRows_.size() != static_cast<size_t>(frame.height)) {
        blockRows_.clear();
        for (int y = 0; y < frame.height; ++y)
            blockRows_.push_back(
                static_cast<float>(4 * texelSolidAngle(y, frame.width, frame.height) /
                                   texelSolidAngle(y / 4, frame.width / 4, frame.height / 4)));
    }
    const bool done = frame.width == 4 * base && frame.height == 2 * base;
    if (done) fitLevels(base, out);
    ImageRgbF& blocks = done ? out.levels[0] : blocks_;
    blocks.fit(frame.width / 4, frame.height / 4);
    makeBlocks(frame, blocks, from);
    if (done)
        halveAll(out);
    else
        make(blocks_, askedWidth, out);
    return true;
}

void PyramidMaker::make(const FrameView& frame, int askedWidth, RadiancePyramid& out, FrameRadiance from) {
    if (clippedShares_.size() != static_cast<size_t>(frame.height)) {
        clippedShares_.clear();
        for (int y = 0; y < frame.height; ++y) clippedShares_.push_back(clippedShare(y, frame.height));
    }
    const bool expands = from == FrameRadiance::Akyuz || from == FrameRadiance::Landis;
    if (!expands && makeByBlocks(frame, askedWidth, out, from)) return;
    prepare(frame.width, frame.height, askedWidth, out);
    ImageRgbF& base = out.levels[0];
    const auto decode = from == FrameRadiance::Thesis ? decodeRow : decodeLinearRow;
    const glm::vec2 range = from == FrameRadiance::Akyuz ? luminanceRange(frame, row_) : glm::vec2(0);
    addRows(
        [&](int y) {
            decode(frame.row(y), frame.width, frame.bgr, row_.data());
            if (expands) expandRow(from, range, row_);
            return true;
        },
        base);
    if (from == FrameRadiance::Auto) addClipped(frame, base);
    halveAll(out);
}

void PyramidMaker::make(const ImageRgbF& radianceLin, int askedWidth, RadiancePyramid& out) {
    prepare(radianceLin.width, radianceLin.height, askedWidth, out);
    addRows(
        [&](int y) {
            const float* from = radianceLin.at(0, y);
            std::transform(from, from + row_.size(), row_.begin(), repaired);
            return true;
        },
        out.levels[0]);
    halveAll(out);
}

} // namespace shoal::light
