#include "engine/camera/EstimateLook.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::camera {

namespace {

constexpr int kStripes = 5, kStripeRows = 16; // the rows of a block
constexpr int kBlock = 16;

// --- Edges. Steps between two flat sides, run over in rows, whose gradient points along the row.
constexpr float kLeastPeak = 3.0f;  // of 255 a texel
constexpr float kLeastStep = 20.0f; // of 255
constexpr int kMostReach = 12;      // texels to either side
constexpr float kTail = 0.06f;      // of the peak: there the edge ends
constexpr float kInsideTails =
    0.89f;                     // of a Gaussian's variance is left when its tails are cut at 6 % of the peak
constexpr float kSlant = 0.5f; // tangent: gradients that lean more belong to other edges
// A texel is a mean over its square, and a difference of neighbours one over two: a twelfth each.
constexpr float kTexelVariance = 1.0f / 6;
// Quantile: nearly all that is filmed is softer by itself, and what a codec has gone over softer still. In a
// film whose camera sharpens, a fifth of the edges is sharper than 0.7 texels, a twentieth than 0.2.
constexpr double kSharpest = 0.05;
// Standard deviations of noise that a step is high at least: noise breaks the tails of lower ones off, and
// the sharpest were those that it has broken most.
constexpr float kAboveNoise = 20;

// --- Noise. Of a block's Laplacians; the flattest thirtieth of the blocks are taken to show nothing but
// noise.
constexpr double kFlattest = 0.03;
// Their luck in pure noise: that quantile of its deviation in a 16 x 16 block, fine and coarse, found by
// drawing blocks.
constexpr float kFineLuck = 0.90f, kCoarseLuck = 0.80f;
constexpr float kRounding = 1.0f / 12; // variance of a value of 255 by being whole

// --- Colour.
constexpr float kColourEdge = 6; // of 255 over three texels: what is more even says nothing
constexpr int kFewColourEdges = 200;
constexpr double kAlternates = 0.62; // ratio of even and odd differences from which on they are interpolated

float quantile(std::vector<float>& values, double share) {
    const auto at = values.begin() + static_cast<ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

// Mean square of the kernel (1 -2 1; -2 4 -2; 1 -2 1), which is blind to slopes and to straight bends along
// its axes, over size x size values; of white noise it is 36 times its variance. Immerkaer 1996, "Fast Noise
// Variance Estimation", with squares for absolutes.
template <class At> float laplacianSquare(int size, At at) {
    float sum = 0;
    for (int y = 1; y + 1 < size; ++y)
        for (int x = 1; x + 1 < size; ++x) {
            const float v = at(x - 1, y - 1) - 2 * at(x, y - 1) + at(x + 1, y - 1) - 2 * at(x - 1, y) +
                            4 * at(x, y) - 2 * at(x + 1, y) + at(x - 1, y + 1) - 2 * at(x, y + 1) +
                            at(x + 1, y + 1);
            sum += v * v;
        }
    return sum / static_cast<float>((size - 2) * (size - 2));
}

bool alternates(const double (&squares)[2]) {
    const auto [low, high] = std::minmax(squares[0], squares[1]);
    return low < kAlternates * high;
}

} // namespace

void LookEstimator::readStripe(const light::FrameView& frame, int top) {
    const int red = frame.bgr ? 2 : 0, blue = 2 - red;
    size_t i = 0;
    for (int y = 0; y < kStripeRows; ++y) {
        const uint8_t* texel = frame.pixels + static_cast<ptrdiff_t>(top + y) * frame.rowStride;
        for (int x = 0; x < width_; ++x, texel += 3, ++i) {
            const float r = texel[red], g = texel[1], b = texel[blue];
            const float l = 0.2126f * r + 0.7152f * g + 0.0722f * b;
            luma_[i] = l;
            blueLess_[i] = b - l;
            redLess_[i] = r - l;
            clipped_[i] = std::min({r, g, b}) < 1 || std::max({r, g, b}) > 254;
        }
    }
}

// stretch: of the map along its rows, 1 / cos(latitude).
void LookEstimator::measureEdges(float stretch) {
    for (int y = 1; y + 1 < kStripeRows; y += 2) {
        const float* row = luma_.data() + static_cast<ptrdiff_t>(y) * width_;
        const unsigned char* clipped = clipped_.data() + static_cast<ptrdiff_t>(y) * width_;
        for (int x = kMostReach; x + kMostReach + 1 < width_; ++x) {
            const float slope = row[x + 1] - row[x], peak = std::abs(slope);
            if (peak < kLeastPeak) continue;
            const float sign = slope < 0 ? -1.0f : 1.0f;
            const auto rise = [&](int i) { return sign * (row[i + 1] - row[i]); };
            if (rise(x - 1) > peak || rise(x + 1) >= peak) continue;
            // Downwards, means over both texels.
            const float lean =
                0.25f * (row[x + width_] + row[x + 1 + width_] - row[x - width_] - row[x + 1 - width_]);
            if (std::abs(lean) > kSlant * peak) continue;
            int first = x, last = x;
            while (x - first < kMostReach && rise(first - 1) > kTail * peak) --first;
            while (last - x < kMostReach && rise(last + 1) > kTail * peak) ++last;
            // An edge that does not come to rest is a slope; one that turns round at once is a line's flank.
            if (x - first >= kMostReach || last - x >= kMostReach) continue;
            if (rise(first - 1) < -0.25f * peak || rise(last + 1) < -0.25f * peak) continue;
            if (clipped[first] || clipped[last + 1]) continue;
            float step = 0, moment = 0, square = 0;
            for (int i = first; i <= last; ++i) {
                const float d = rise(i), at = static_cast<float>(i - x);
                step += d;
                moment += d * at;
                square += d * at * at;
            }
            if (step < kLeastStep) continue;
            const float centre = moment / step;
            const float along = (square / step - centre * centre) / kInsideTails - kTexelVariance;
            const float cosine2 = 1 / (1 + lean * lean / (peak * peak));
            edges_.push_back({std::sqrt(std::max(along * cosine2, 0.0f)) / stretch, step});
        }
    }
}

// Of the edges that stand out of the noise.
void LookEstimator::measureBlur(LookEstimate& out) {
    const float noise = 255 * *std::ranges::max_element(out.look.fineNoise);
    blurs_.clear();
    for (const Edge& edge : edges_)
        if (edge.step >= kAboveNoise * noise) blurs_.push_back(edge.blur_texels);
    out.edges = static_cast<int>(blurs_.size());
    if (out.edges >= kFewEdges) out.look.blur_texels = quantile(blurs_, kSharpest);
}

void LookEstimator::measureNoise(LookEstimate& out) {
    for (int left = 0; left + kBlock <= width_; left += kBlock) {
        const auto luma = [&](int x, int y) { return luma_[static_cast<size_t>(y * width_ + left + x)]; };
        float sum = 0;
        bool whole = true;
        for (int y = 0; y < kBlock; ++y)
            for (int x = 0; x < kBlock; ++x) {
                sum += luma(x, y);
                whole &= !clipped_[static_cast<size_t>(y * width_ + left + x)];
            }
        if (!whole) continue;
        const auto half = [&](int x, int y) {
            return 0.25f * (luma(2 * x, 2 * y) + luma(2 * x + 1, 2 * y) + luma(2 * x, 2 * y + 1) +
                            luma(2 * x + 1, 2 * y + 1));
        };
        const float mean = sum / static_cast<float>(kBlock * kBlock * 255);
        const auto band = static_cast<size_t>(
            std::clamp(static_cast<int>(mean * static_cast<float>(kBrightnesses)), 0, kBrightnesses - 1));
        blocks_[band].fine.push_back(std::sqrt(laplacianSquare(kBlock, luma) / 36));
        blocks_[band].coarse.push_back(std::sqrt(laplacianSquare(kBlock / 2, half) / 36));
        ++out.flatBlocks[band];
    }
}

// What was interpolated shows it by turns (Gallagher 2005, "Detection of Linear and Cubic Interpolation in
// JPEG Compressed Images"). Texels that share a copied colour do not differ; of colours drawn straight
// between every second texel's, the second differences vanish by turns; between the middles of pairs, the
// third.
void LookEstimator::measureChroma() {
    const auto add = [](Parity& sums, int at, const float* v, ptrdiff_t step) {
        const float before = v[-step], here = v[0], behind = v[step], last = v[2 * step];
        if (std::abs(last - before) < kColourEdge) return;
        const float first = behind - here, second = before - 2 * here + behind,
                    third = before - 3 * here + 3 * behind - last;
        const int parity = at & 1;
        sums.first[parity] += static_cast<double>(first * first);
        sums.second[parity] += static_cast<double>(second * second);
        sums.third[parity] += static_cast<double>(third * third);
        ++sums.count;
    };
    for (const std::vector<float>* plane : {&blueLess_, &redLess_})
        for (int y = 2; y + 2 < kStripeRows; ++y)
            for (int x = 2; x + 2 < width_; ++x) {
                const ptrdiff_t i = static_cast<ptrdiff_t>(y) * width_ + x;
                if (clipped_[static_cast<size_t>(i)]) continue;
                add(chroma_[0], x, plane->data() + i, 1);
                add(chroma_[1], y, plane->data() + i, width_);
            }
}

// The blackest and whitest thousandth are no one's business: dead texels, glints.
void LookEstimator::measureLevels(const light::FrameView& frame, FilmLook& look) {
    constexpr int kApart = 8;
    constexpr double kShare = 0.001;
    std::array<std::array<int, 256>, 3> counts{};
    int all = 0;
    for (int y = frame.height / 8; y < frame.height * 7 / 8; y += kApart)
        for (int x = (y / kApart) % kApart; x < frame.width; x += kApart, ++all) {
            const uint8_t* texel = frame.pixels + static_cast<ptrdiff_t>(y) * frame.rowStride + 3 * x;
            for (size_t c = 0; c < 3; ++c) ++counts[c][texel[c]];
        }
    const int beyond = static_cast<int>(kShare * all);
    for (int c = 0; c < 3; ++c) {
        const auto& channel = counts[static_cast<size_t>(frame.bgr ? 2 - c : c)];
        int low = 0, high = 255;
        for (int seen = channel[0]; seen <= beyond && low < 255;) seen += channel[static_cast<size_t>(++low)];
        for (int seen = channel[255]; seen <= beyond && high > 0;)
            seen += channel[static_cast<size_t>(--high)];
        look.black[c] = static_cast<float>(low) / 255;
        look.white[c] = static_cast<float>(std::max(high, low)) / 255;
    }
}

LookEstimate LookEstimator::estimate(const light::FrameView& frame) {
    LookEstimate out;
    out.look.chromaTexels = {2, 2};
    if (frame.width < 4 * kBlock || frame.height < 4 * kStripeRows) return out;
    width_ = frame.width;
    const auto texels = static_cast<size_t>(width_) * kStripeRows;
    for (std::vector<float>* plane : {&luma_, &blueLess_, &redLess_}) plane->resize(texels);
    clipped_.resize(texels);
    edges_.clear();
    for (Blocks& blocks : blocks_) blocks.fine.clear(), blocks.coarse.clear();
    chroma_ = {};

    const int quarter = frame.height / 4, span = frame.height / 2 - kStripeRows;
    for (int stripe = 0; stripe < kStripes; ++stripe) {
        const int top = (quarter + span * stripe / (kStripes - 1)) & ~1; // where chroma's texels begin
        readStripe(frame, top);
        const float latitude =
            (0.5f - static_cast<float>(top + kStripeRows / 2) / static_cast<float>(frame.height)) *
            std::numbers::pi_v<float>;
        measureEdges(1 / std::cos(latitude));
        measureNoise(out);
        measureChroma();
    }
    measureLevels(frame, out.look);

    for (size_t band = 0; band < kBrightnesses; ++band) {
        if (out.flatBlocks[band] < kFewBlocks) continue;
        const float fine = std::max(quantile(blocks_[band].fine, kFlattest) / kFineLuck, 0.0f);
        const float coarse = std::max(quantile(blocks_[band].coarse, kFlattest) / kCoarseLuck, 0.0f);
        const float fineVariance = std::max(fine * fine - kRounding, 0.0f);
        const float coarseVariance = std::max(coarse * coarse - fine * fine / 4, 0.0f);
        out.look.fineNoise[band] = std::sqrt(fineVariance) / 255;
        out.look.coarseNoise[band] = std::sqrt(coarseVariance) / 255;
    }
    // Bands that hardly a block lies in: as the nearest that has some.
    for (int band = 0; band < kBrightnesses; ++band)
        for (int away = 1; out.flatBlocks[static_cast<size_t>(band)] < kFewBlocks && away < kBrightnesses;
             ++away)
            for (const int near : {band - away, band + away})
                if (near >= 0 && near < kBrightnesses &&
                    out.flatBlocks[static_cast<size_t>(near)] >= kFewBlocks) {
                    out.look.fineNoise[static_cast<size_t>(band)] =
                        out.look.fineNoise[static_cast<size_t>(near)];
                    out.look.coarseNoise[static_cast<size_t>(band)] =
                        out.look.coarseNoise[static_cast<size_t>(near)];
                    away = kBrightnesses;
                    break;
                }

    measureBlur(out);

    for (int axis = 0; axis < 2; ++axis) {
        const Parity& sums = chroma_[static_cast<size_t>(axis)];
        if (sums.count < kFewColourEdges) continue;
        out.chromaKnown = true;
        out.look.chromaTexels[axis] =
            alternates(sums.first) || alternates(sums.second) || alternates(sums.third) ? 2 : 1;
    }
    return out;
}

} // namespace shoal::camera
