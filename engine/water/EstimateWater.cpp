#include "engine/water/EstimateWater.h"

#include "engine/math/Colour.h"
#include "engine/math/LatLong.h"
#include "engine/math/Trigonometry.h"

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include <algorithm>
#include <numeric>
#include <span>

namespace shoal::water {

namespace {

// Sampling resolution: nothing estimated here is finer.
constexpr int kRows = 256, kPerSector = 8;
constexpr int kSectors = 16, kOpenSectors = 6; // sectors of the horizon

constexpr float kHorizon_deg = 8; // half the height of the band around the horizon
// Elevations at which the veil is fitted. Above 41 degrees the surface shows the sky (Snell's window).
constexpr float kVeilTop_deg = 40, kVeilBottom_deg = 60, kVeilBand_deg = 10;
// Red below this fraction of the larger of green and blue counts as lost; blue skies and haze keep more.
constexpr float kLostRed = 0.5f;

int rowAt(float elevation_deg) {
    return std::clamp(static_cast<int>(std::lround((0.5f - elevation_deg / 180) * kRows)), 0, kRows);
}

glm::vec3 squaredCoded(const glm::vec3& lin) {
    const glm::vec3 coded(math::srgbFromLinear(lin.x), math::srgbFromLinear(lin.y),
                          math::srgbFromLinear(lin.z));
    return coded * coded;
}

// Time constants of WaterOverTime.
constexpr float kVeil_s = 0.43f, kAttenuation_s = 4;

struct VeilCell {
    std::array<float, kVeilTerms> terms;
    glm::vec3 seen; // squared coded values
    float weight;
};

using VeilFit = cv::Vec<double, kVeilTerms>; // factors of the terms

// Fits a lower envelope of the cells by iteratively reweighted least squares: weight 1 below the fit,
// Lorentzian weights above. level: the veil at the horizon, the starting value.
VeilFit lowerFit(std::span<const VeilCell> cells, int channel, double level) {
    constexpr int kRounds = 8;
    constexpr double kTolerance = 0.1; // share of the level: excess at which the weight is a half
    // Regularisation of bands 1 and 2, relative to the sum of weights.
    constexpr double kRegularisation[kVeilTerms] = {0, 0.004, 0.004, 0.004, 0.02, 0.02, 0.02, 0.02, 0.02};
    VeilFit fit;
    fit[0] = level;
    for (int round = 0; round < kRounds; ++round) {
        cv::Matx<double, kVeilTerms, kVeilTerms> a; // symmetric; the solver reads the lower half
        VeilFit b;
        double weights = 0;
        for (const VeilCell& cell : cells) {
            const auto seen = static_cast<double>(cell.seen[channel]);
            double fitted = 0;
            for (int i = 0; i < fit.rows; ++i) fitted += fit[i] * static_cast<double>(cell.terms[i]);
            const double above = std::max(seen - fitted, 0.0) / (kTolerance * level + 1e-4);
            const double weight = static_cast<double>(cell.weight) / (1 + above * above);
            weights += weight;
            for (int i = 0; i < fit.rows; ++i) {
                const double term = weight * static_cast<double>(cell.terms[i]);
                for (int j = 0; j <= i; ++j) a(i, j) += term * static_cast<double>(cell.terms[j]);
                b[i] += term * seen;
            }
        }
        for (int i = 0; i < fit.rows; ++i) a(i, i) += weights * kRegularisation[i] + 1e-9;
        fit = a.solve(b, cv::DECOMP_CHOLESKY);
    }
    return fit;
}

// Mean light of the scene in each sector of the horizon, by row.
using Cells = std::array<glm::vec3, kRows * kSectors>;

Cells sample(const light::FrameView& frame) {
    const auto& table = math::linearOfByte();
    Cells cellsLin{};
    const int first = frame.bgr ? 2 : 0, last = 2 - first;
    for (int row = rowAt(kVeilTop_deg); row < rowAt(-kVeilBottom_deg); ++row) {
        const uint8_t* line = frame.row(static_cast<int64_t>(2 * row + 1) * frame.height / (2 * kRows));
        for (int sector = 0; sector < kSectors; ++sector) {
            glm::vec3 sum(0);
            for (int i = 0; i < kPerSector; ++i) {
                const int64_t column = static_cast<int64_t>(2 * (sector * kPerSector + i) + 1) * frame.width /
                                       (2 * kSectors * kPerSector);
                const uint8_t* pixel = line + 3 * column;
                sum += glm::vec3(table[pixel[first]], table[pixel[1]], table[pixel[last]]);
            }
            cellsLin[row * kSectors + sector] = sum / static_cast<float>(kPerSector);
        }
    }
    return cellsLin;
}

// Rows: firstRow to lastRow - 1, as below.
glm::vec3 meanLin(const Cells& cellsLin, int sector, int firstRow, int lastRow) {
    glm::vec3 sum(0);
    for (int row = firstRow; row < lastRow; ++row) sum += cellsLin[row * kSectors + sector];
    return sum / static_cast<float>(lastRow - firstRow);
}

// Returns the sectors, the most open first.
std::array<int, kSectors> sectorsByOpenness(const Cells& cellsLin, int firstRow, int lastRow) {
    std::array<int, kSectors> sectors;
    std::iota(sectors.begin(), sectors.end(), 0);
    std::ranges::sort(sectors, {}, [&](int sector) {
        const glm::vec3 mean = meanLin(cellsLin, sector, firstRow, lastRow);
        return std::pair(mean.x - std::max(mean.y, mean.z), sector);
    });
    return sectors;
}

// Returns the median of the sectors' means, by channel.
glm::vec3 medianLin(const Cells& cellsLin, std::span<const int> sectors, int firstRow, int lastRow) {
    const size_t count = sectors.size();
    glm::vec3 median;
    for (int c = 0; c < 3; ++c) {
        std::array<float, kSectors> values{};
        for (size_t i = 0; i < count; ++i) values[i] = meanLin(cellsLin, sectors[i], firstRow, lastRow)[c];
        std::sort(values.begin(), values.begin() + count);
        median[c] = 0.5f * (values[(count - 1) / 2] + values[count / 2]);
    }
    return median;
}

float redLoss(const Cells& cellsLin, int firstRow, int lastRow) {
    int lost = 0;
    for (int sector = 0; sector < kSectors; ++sector) {
        const glm::vec3 mean = meanLin(cellsLin, sector, firstRow, lastRow);
        // Leaves lose red and, unlike water, still more blue.
        lost += mean.x < kLostRed * std::max(mean.y, mean.z) && mean.x < mean.z;
    }
    // A cave mouth or a diver may hide a third of the horizon; above water less than a third has lost its
    // red.
    const float share = static_cast<float>(lost) / kSectors;
    return glm::smoothstep(0.35f, 0.65f, share);
}

} // namespace

glm::vec3 attenuationFromVeil(const glm::vec3& veilLin) {
    constexpr float kMean_perM = 0.13f; // geometric mean of the channels
    // Red's attenuation as a multiple of that mean, within a fifth for water clear enough to dive in.
    constexpr float kRed = 1.6f;
    constexpr float kMaxGreenToBlue = 1.8f; // bound of their ratio and of its inverse
    const float greenToBlue = std::sqrt(std::max(veilLin.z, 1e-4f) / std::max(veilLin.y, 1e-4f));
    const float root = std::sqrt(std::clamp(greenToBlue, 1 / kMaxGreenToBlue, kMaxGreenToBlue));
    return kMean_perM * glm::vec3(kRed, root / std::sqrt(kRed), 1 / (root * std::sqrt(kRed)));
}

WaterEstimate estimateWater(const light::FrameView& frame) {
    const Cells cellsLin = sample(frame);
    WaterEstimate result;
    const int horizonTop = rowAt(kHorizon_deg), horizonBottom = rowAt(-kHorizon_deg);
    result.evidence = redLoss(cellsLin, horizonTop, horizonBottom);
    // Only the upper half of the band is used: towards the floor the water is not deep.
    const auto sectors = sectorsByOpenness(cellsLin, horizonTop, rowAt(0));
    const std::span<const int> open = std::span(sectors).first(kOpenSectors);
    result.water.attenuation_perM = attenuationFromVeil(medianLin(cellsLin, open, horizonTop, rowAt(0)));

    std::array<VeilCell, kSectors* static_cast<size_t>((kVeilTop_deg + kVeilBottom_deg) / kVeilBand_deg)>
        cells;
    size_t count = 0;
    for (float top = kVeilTop_deg; top > -kVeilBottom_deg + 1; top -= kVeilBand_deg)
        for (int sector = 0; sector < kSectors; ++sector, ++count) {
            const float middle = top - kVeilBand_deg / 2;
            const glm::vec3 dir = directionFromLatLong(
                glm::vec2((static_cast<float>(sector) + 0.5f) / kSectors, 0.5f - middle / 180));
            // Below the horizon most cells show floor, which only bounds the veil.
            const float weight = std::cos(glm::radians(middle)) * (middle > -15 ? 1.0f : 0.3f);
            cells[count] = {veilTerms(dir),
                            squaredCoded(meanLin(cellsLin, sector, rowAt(top), rowAt(top - kVeilBand_deg))),
                            weight};
        }
    // The level is that of all sectors: a tunnel's veil is as dark as its walls, even if the sea is bright.
    const glm::vec3 level = squaredCoded(medianLin(cellsLin, sectors, horizonTop, rowAt(0)));
    for (int c = 0; c < 3; ++c) {
        const VeilFit fit = lowerFit(cells, c, static_cast<double>(level[c]));
        for (int i = 0; i < fit.rows; ++i) result.water.veil[i][c] = static_cast<float>(fit[i]);
    }
    return result;
}

void WaterOverTime::follow(const WaterEstimate& estimate, float strength, float dt_s) {
    const float fast = begun_ ? math::followShare(dt_s, kVeil_s) : 1,
                slow = begun_ ? math::followShare(dt_s, kAttenuation_s) : 1;
    begun_ = true;
    strength_ += (strength - strength_) * fast;
    for (size_t i = 0; i < kVeilTerms; ++i) veil_[i] += (estimate.water.veil[i] - veil_[i]) * fast;
    logAttenuation_ += (glm::log(estimate.water.attenuation_perM) - logAttenuation_) * slow;
}

Water WaterOverTime::water() const {
    return {veil_, begun_ ? glm::exp(logAttenuation_) * strength_ : glm::vec3(0)};
}

} // namespace shoal::water
