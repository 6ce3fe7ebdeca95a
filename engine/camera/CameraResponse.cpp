#include "engine/camera/CameraResponse.h"

#include "engine/math/Quantile.h"
#include "engine/math/Trigonometry.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace shoal::camera {

constexpr int kStripes = 5, kStripeRows = 16; // the rows of a block
constexpr int kBlock = 16;

// --- Edges: steps between two flat sides along a row, with a gradient along the row.
constexpr float kMinPeak = 3.0f;      // gradient, of 255 a texel
constexpr float kMinStep = 20.0f;     // height, of 255
constexpr int kMaxReach = 12;         // texels to either side
constexpr float kTail = 0.06f;        // share of the peak gradient at which the edge ends
constexpr float kInsideTails = 0.89f; // share of a Gaussian's variance that such a cut leaves
constexpr float kSlant = 0.5f;        // tangent of the maximum angle between gradient and row
// Variance of the box filters of a texel and of the difference of two: a twelfth each.
constexpr float kTexelVariance = 1.0f / 6;
// Quantile of the edges' blur that counts as the camera's: objects and the codec make most edges softer. In a
// film whose camera sharpens, a fifth of the edges is sharper than 0.7 texels, a twentieth than 0.2.
constexpr double kSharpest = 0.05;
// Minimum step in standard deviations of noise, which hides the tails of lower steps: these would seem sharp.
constexpr float kAboveNoise = 20;

// --- Noise: from a block's Laplacians; the flattest thirtieth of the blocks is assumed to be noise alone.
constexpr double kFlattest = 0.03;
// Selection bias: the kFlattest quantile of deviations measured in 16 x 16 blocks of simulated noise, as a
// share of the true deviation, fine and coarse.
constexpr float kFineLuck = 0.90f, kCoarseLuck = 0.80f;
constexpr float kRounding = 1.0f / 12; // variance of quantisation to whole levels

// --- Over time.
constexpr float kFollow_s = 2.2f; // time constant
// Lenses scatter one to five percent, worn ports more; a higher bound only means that nothing dark was seen
// in front of bright surroundings.
constexpr float kUsualGlare = 0.03f, kMaxGlare = 0.1f;

// Mean square response of the kernel (1 -2 1; -2 4 -2; 1 -2 1), which is 0 for gradients and for curvature
// along one axis, over size x size values; for white noise it is 36 times the variance. Immerkaer 1996, "Fast
// Noise Variance Estimation", with squares for absolutes.
template <class At> static float laplacianSquare(int size, At at) {
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

void CameraResponseEstimator::readStripe(const light::FrameView& frame, int top) {
    const int red = frame.bgr ? 2 : 0, blue = 2 - red;
    size_t i = 0;
    for (int y = 0; y < kStripeRows; ++y) {
        const uint8_t* texel = frame.row(top + y);
        for (int x = 0; x < width_; ++x, texel += 3, ++i) {
            const float r = texel[red], g = texel[1], b = texel[blue];
            luma_[i] = 0.2126f * r + 0.7152f * g + 0.0722f * b;
            clipped_[i] = std::min({r, g, b}) < 1 || std::max({r, g, b}) > 254;
        }
    }
}

// stretch: horizontal stretch of the map, 1 / cos(latitude).
void CameraResponseEstimator::measureEdges(float stretch) {
    for (int y = 1; y + 1 < kStripeRows; y += 2) {
        const float* row = luma_.data() + static_cast<ptrdiff_t>(y) * width_;
        const unsigned char* clipped = clipped_.data() + static_cast<ptrdiff_t>(y) * width_;
        for (int x = kMaxReach; x + kMaxReach + 1 < width_; ++x) {
            const float slope = row[x + 1] - row[x], peak = std::abs(slope);
            if (peak < kMinPeak) continue;
            const float sign = slope < 0 ? -1.0f : 1.0f;
            const auto rise = [&](int i) { return sign * (row[i + 1] - row[i]); };
            if (rise(x - 1) > peak || rise(x + 1) >= peak) continue;
            // Vertical gradient, averaged over both texels.
            const float lean =
                0.25f * (row[x + width_] + row[x + 1 + width_] - row[x - width_] - row[x + 1 - width_]);
            if (std::abs(lean) > kSlant * peak) continue;
            int first = x, last = x;
            while (x - first < kMaxReach && rise(first - 1) > kTail * peak) --first;
            while (last - x < kMaxReach && rise(last + 1) > kTail * peak) ++last;
            // An edge without a flat end is a slope; one that reverses at once is the side of a thin line.
            if (x - first >= kMaxReach || last - x >= kMaxReach) continue;
            if (rise(first - 1) < -0.25f * peak || rise(last + 1) < -0.25f * peak) continue;
            if (clipped[first] || clipped[last + 1]) continue;
            float step = 0, moment = 0, square = 0;
            for (int i = first; i <= last; ++i) {
                const float d = rise(i), at = static_cast<float>(i - x);
                step += d;
                moment += d * at;
                square += d * at * at;
            }
            if (step < kMinStep) continue;
            const float centre = moment / step;
            const float along = (square / step - centre * centre) / kInsideTails - kTexelVariance;
            const float cosine2 = 1 / (1 + lean * lean / (peak * peak));
            edges_.push_back({std::sqrt(std::max(along * cosine2, 0.0f)) / stretch, step});
        }
    }
}

// Measures the blur of edges with sufficient contrast to noise.
void CameraResponseEstimator::measureBlur(CameraResponseEstimate& out) {
    const float noise = 255 * *std::ranges::max_element(out.response.fineNoise);
    blurs_.clear();
    for (const Edge& edge : edges_)
        if (edge.step >= kAboveNoise * noise) blurs_.push_back(edge.blur_texels);
    out.edges = static_cast<int>(blurs_.size());
    if (out.edges >= kFewEdges) out.response.blur_texels = math::quantile(blurs_, kSharpest);
}

void CameraResponseEstimator::measureNoise(CameraResponseEstimate& out) {
    for (int left = 0; left + kBlock <= width_; left += kBlock) {
        const auto luma = [&](int x, int y) { return luma_[y * width_ + left + x]; };
        float sum = 0;
        bool whole = true;
        for (int y = 0; y < kBlock; ++y)
            for (int x = 0; x < kBlock; ++x) {
                sum += luma(x, y);
                whole &= !clipped_[y * width_ + left + x];
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
        ++out.unclippedBlocks[band];
    }
}

// Measures black and white, without the darkest and brightest thousandth: dead texels, glints.
static void measureLevels(const light::FrameView& frame, CameraResponse& response) {
    constexpr int kApart = 8;
    constexpr double kShare = 0.001;
    std::array<std::array<int, 256>, 3> counts{};
    int all = 0;
    for (int y = frame.height / 8; y < frame.height * 7 / 8; y += kApart)
        for (int x = (y / kApart) % kApart; x < frame.width; x += kApart, ++all) {
            const uint8_t* texel = frame.row(y) + 3 * x;
            for (size_t c = 0; c < 3; ++c) ++counts[c][texel[c]];
        }
    const int beyond = static_cast<int>(kShare * all);
    for (int c = 0; c < 3; ++c) {
        const auto& channel = counts[frame.bgr ? 2 - c : c];
        int low = 0, high = 255;
        for (int seen = channel[0]; seen <= beyond && low < 255;) seen += channel[++low];
        for (int seen = channel[255]; seen <= beyond && high > 0;) seen += channel[--high];
        response.black[c] = static_cast<float>(low) / 255;
        response.white[c] = static_cast<float>(std::max(high, low)) / 255;
    }
}

CameraResponseEstimate CameraResponseEstimator::estimate(const light::FrameView& frame) {
    CameraResponseEstimate out;
    if (frame.width < 4 * kBlock || frame.height < 4 * kStripeRows) return out;
    width_ = frame.width;
    const auto texels = static_cast<size_t>(width_) * kStripeRows;
    luma_.resize(texels);
    clipped_.resize(texels);
    edges_.clear();
    for (Blocks& blocks : blocks_) blocks.fine.clear(), blocks.coarse.clear();

    const int quarter = frame.height / 4, span = frame.height / 2 - kStripeRows;
    for (int stripe = 0; stripe < kStripes; ++stripe) {
        const int top = (quarter + span * stripe / (kStripes - 1)) & ~1; // aligned to chroma texels
        readStripe(frame, top);
        const float latitude =
            (0.5f - static_cast<float>(top + kStripeRows / 2) / static_cast<float>(frame.height)) *
            std::numbers::pi_v<float>;
        measureEdges(1 / std::cos(latitude));
        measureNoise(out);
    }
    measureLevels(frame, out.response);

    for (size_t band = 0; band < kBrightnesses; ++band) {
        if (out.unclippedBlocks[band] < kFewBlocks) continue;
        const float fine = std::max(math::quantile(blocks_[band].fine, kFlattest) / kFineLuck, 0.0f);
        const float coarse = std::max(math::quantile(blocks_[band].coarse, kFlattest) / kCoarseLuck, 0.0f);
        const float fineVariance = std::max(fine * fine - kRounding, 0.0f);
        const float coarseVariance = std::max(coarse * coarse - fine * fine / 4, 0.0f);
        out.response.fineNoise[band] = std::sqrt(fineVariance) / 255;
        out.response.coarseNoise[band] = std::sqrt(coarseVariance) / 255;
    }
    // Bands with too few blocks take the values of the nearest that has enough.
    const auto enough = [&](int band) {
        return band >= 0 && band < kBrightnesses && out.unclippedBlocks[band] >= kFewBlocks;
    };
    for (int band = 0; band < kBrightnesses; ++band)
        for (int away = 1; !enough(band) && away < kBrightnesses; ++away) {
            const int near = enough(band - away) ? band - away : band + away;
            if (!enough(near)) continue;
            out.response.fineNoise[band] = out.response.fineNoise[near];
            out.response.coarseNoise[band] = out.response.coarseNoise[near];
            break;
        }

    measureBlur(out);
    return out;
}

// --- Glare

constexpr int kSamples = 4;        // samples of a cell in each direction
constexpr int kDarkSamples = 4;    // a cell's darkest samples: their mean stands for a small dark thing
constexpr int kPasses = 4;         // of means over 3 cells; variance 8/3 + 1/12 cells^2, (4.7 degrees)^2
constexpr float kBright = 0.05f;   // least light around a cell: a few percent of it exceed noise and black
constexpr double kDarkest = 0.002; // quantile; texels below it are undershoots of sharpening
constexpr size_t kFewCells = 100;

static float luma(const float* c) { return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2]; }

// samples: luma of each cell's samples.
static void readCells(const light::FrameView& frame, ImageRgbF& out,
                      std::vector<std::array<float, kCellSamples>>& samples) {
    constexpr int kDown = kGlareHeight * kSamples, kAcross = kGlareWidth * kSamples;
    constexpr float kShare = 1.0f / kCellSamples;
    std::ranges::fill(out.pixels, 0.0f);
    samples.resize(size_t{kGlareWidth} * kGlareHeight);
    for (int j = 0; j < kDown; ++j) {
        const uint8_t* row = frame.row((2 * j + 1) * frame.height / (2 * kDown));
        for (int i = 0; i < kAcross; ++i) {
            const uint8_t* texel = row + ptrdiff_t{3} * ((2 * i + 1) * frame.width / (2 * kAcross));
            float* to = out.at(i / kSamples, j / kSamples);
            std::array<float, 3> light;
            for (int c = 0; c < 3; ++c) {
                const int value = texel[frame.bgr ? 2 - c : c];
                light[c] = static_cast<float>(value * value) / (255.0f * 255.0f);
                to[c] += kShare * light[c];
            }
            samples[j / kSamples * kGlareWidth + i / kSamples][j % kSamples * kSamples + i % kSamples] =
                luma(light.data());
        }
    }
}

// Averages over three cells down and as many across as are equally wide on the sphere.
static void spread(ImageRgbF& map, ImageRgbF& across) {
    for (int y = 0; y < kGlareHeight; ++y) {
        const auto ring = std::sin((static_cast<float>(y) + 0.5f) / kGlareHeight * std::numbers::pi_v<float>);
        const int reach = std::min(static_cast<int>(1 / ring + 0.5f), kGlareWidth / 2 - 1);
        const float share = 1 / static_cast<float>(2 * reach + 1);
        const auto at = [&](int x) { return map.at((x + kGlareWidth) % kGlareWidth, y); };
        std::array<float, 3> sum{};
        for (int i = -reach; i <= reach; ++i)
            for (size_t c = 0; c < 3; ++c) sum[c] += at(i)[c];
        for (int x = 0; x < kGlareWidth; ++x)
            for (size_t c = 0; c < 3; ++c) {
                across.at(x, y)[c] = std::max(sum[c], 0.0f) * share;
                sum[c] += at(x + reach + 1)[c] - at(x - reach)[c];
            }
    }
    for (int y = 0; y < kGlareHeight; ++y) {
        const int up = std::max(y - 1, 0), down = std::min(y + 1, kGlareHeight - 1);
        for (int x = 0; x < kGlareWidth; ++x)
            for (int c = 0; c < 3; ++c)
                map.at(x, y)[c] = (across.at(x, up)[c] + across.at(x, y)[c] + across.at(x, down)[c]) / 3;
    }
}

void GlareFilter::make(const light::FrameView& frame, Glare& out) {
    out.maxShare = 1;
    std::ranges::fill(out.spread.pixels, 0.0f);
    if (frame.width < 1 || frame.height < 1) return;
    readCells(frame, cells_, samples_);
    out.spread.pixels = cells_.pixels;
    for (int pass = 0; pass < kPasses; ++pass) spread(out.spread, across_);

    shares_.clear();
    smallShares_.clear();
    for (int y = kGlareHeight / 8; y < kGlareHeight * 7 / 8; ++y)
        for (int x = 0; x < kGlareWidth; ++x)
            if (const float around = luma(out.spread.at(x, y)); around > kBright) {
                shares_.push_back(luma(cells_.at(x, y)) / around);
                auto& samples = samples_[y * kGlareWidth + x];
                float dark = std::ranges::min(samples);
                if (dark < kUsualGlare * around) { // else their mean is not below it either
                    const auto bright = samples.begin() + kDarkSamples;
                    std::nth_element(samples.begin(), bright, samples.end());
                    dark = std::accumulate(samples.begin(), bright, 0.0f) / kDarkSamples;
                }
                smallShares_.push_back(dark / around);
            }
    if (shares_.size() < kFewCells) return;
    out.maxShare = std::min(math::quantile(shares_, kDarkest), 1.0f);
    // Where no whole cell is dark, smaller things may still show that the lens scatters less than usual.
    const float small = math::quantile(smallShares_, kDarkest);
    if (out.maxShare > kMaxGlare && small < kUsualGlare) out.maxShare = small;
}

// --- Over time

void CameraResponseOverTime::follow(const CameraResponseEstimate& estimate, float dt_s) {
    const auto shareIf = [&](bool known) { return known ? math::followShare(dt_s, kFollow_s) : 1.0f; };
    const CameraResponse& seen = estimate.response;
    const float all = shareIf(std::exchange(begun_, true));
    for (size_t band = 0; band < kBrightnesses; ++band) {
        response_.fineNoise[band] += (seen.fineNoise[band] - response_.fineNoise[band]) * all;
        response_.coarseNoise[band] += (seen.coarseNoise[band] - response_.coarseNoise[band]) * all;
    }
    response_.black = glm::mix(response_.black, seen.black, all);
    response_.white = glm::mix(response_.white, seen.white, all);
    if (estimate.edges >= kFewEdges)
        response_.blur_texels +=
            (seen.blur_texels - response_.blur_texels) * shareIf(std::exchange(edgesSeen_, true));
    response_.chromaTexels = seen.chromaTexels;
}

void CameraResponseOverTime::followGlare(float maxShare, float dt_s) {
    maxGlare_ = std::min(maxGlare_, maxShare);
    const float glare = maxGlare_ > kMaxGlare ? kUsualGlare : maxGlare_;
    response_.glare += (glare - response_.glare) * (glareSeen_ ? math::followShare(dt_s, kFollow_s) : 1.0f);
    glareSeen_ = true;
}

} // namespace shoal::camera
