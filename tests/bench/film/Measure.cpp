#include "tests/bench/film/Measure.h"

#include "engine/math/Colour.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::bench {

namespace {

constexpr int kTile = 1024;
constexpr double kBandsAnOctave = 6;

cv::Mat asMat(const ImageRgb8& image) {
    return {image.height, image.width, CV_8UC3, const_cast<uint8_t*>(image.pixels.data())};
}

// Rec. 709, of 255.
cv::Mat luma(const cv::Mat& bgr) {
    cv::Mat out;
    cv::transform(bgr, out, cv::Matx13f(0.0722f, 0.7152f, 0.2126f));
    out.convertTo(out, CV_32F);
    return out;
}

// Returns Hann's window, so that a tile's edges do not count as detail.
const cv::Mat& window() {
    static const cv::Mat made = [] {
        cv::Mat hann;
        cv::createHanningWindow(hann, {kTile, kTile}, CV_32F);
        return hann;
    }();
    return made;
}

cv::Mat spectrum(const cv::Mat& luma, const cv::Rect& tile) {
    cv::Mat part = luma(tile).clone(), out;
    part -= cv::mean(part)[0];
    cv::dft(part.mul(window()), out, cv::DFT_COMPLEX_OUTPUT);
    return out;
}

} // namespace

double bandFrequency(int band) { return kLowest * std::exp2((band + 0.5) / kBandsAnOctave); }

void Distance::add(const ImageRgb8& truthRgb, const ImageRgb8& decodedBgr) {
    cv::Mat truth, decoded;
    cv::cvtColor(asMat(truthRgb), truth, cv::COLOR_RGB2BGR);
    if (decodedBgr.width == truthRgb.width)
        decoded = asMat(decodedBgr);
    else
        cv::resize(asMat(decodedBgr), decoded, truth.size(), 0, 0, cv::INTER_CUBIC);
    const cv::Mat lumaTruth = luma(truth), lumaDecoded = luma(decoded);
    const auto& linear = math::linearOfByte();
    for (int y = 0; y < truth.rows; ++y) {
        const double weight = std::sin((y + 0.5) / truth.rows * std::numbers::pi);
        double squared = 0, own = 0, steps = 0;
        for (int x = 0; x < truth.cols; ++x) {
            for (int c = 0; c < 3; ++c) {
                const float a = linear[truth.at<cv::Vec3b>(y, x)[c]],
                            b = linear[decoded.at<cv::Vec3b>(y, x)[c]];
                squared += static_cast<double>((a - b) * (a - b));
                own += static_cast<double>(a * a);
            }
            const double step = static_cast<double>(lumaTruth.at<float>(y, x) - lumaDecoded.at<float>(y, x));
            steps += step * step;
        }
        squared_ += weight * squared, truthSquared_ += weight * own, lumaSquared_ += weight * steps;
        weights_ += weight * truth.cols;
    }
    // Around the horizon, where texels are square.
    for (int x = 0; x + kTile <= truth.cols; x += kTile) {
        const cv::Rect tile(x, (truth.rows - kTile) / 2, kTile, kTile);
        const cv::Mat a = spectrum(lumaTruth, tile), b = spectrum(lumaDecoded, tile);
        for (int j = 0; j < kTile; ++j)
            for (int i = 0; i < kTile; ++i) {
                const double u = i <= kTile / 2 ? i : i - kTile, v = j <= kTile / 2 ? j : j - kTile;
                const double around = std::hypot(u, v) * truth.cols / kTile;
                const int band =
                    around < kLowest ? -1 : static_cast<int>(kBandsAnOctave * std::log2(around / kLowest));
                if (band < 0 || band >= kBands) continue;
                const auto p = a.at<cv::Vec2f>(j, i), q = b.at<cv::Vec2f>(j, i);
                cross_[static_cast<size_t>(band)] += static_cast<double>(p[0] * q[0] + p[1] * q[1]);
                power_[static_cast<size_t>(band)] += static_cast<double>(p[0] * p[0] + p[1] * p[1]);
            }
    }
}

double Distance::errorLinear() const { return std::sqrt(squared_ / truthSquared_); }

double Distance::psnrLuma_dB() const { return 10 * std::log10(255 * 255 / (lumaSquared_ / weights_)); }

double Distance::gain(int band) const {
    return cross_[static_cast<size_t>(band)] / power_[static_cast<size_t>(band)];
}

double Distance::detail() const {
    for (int band = 0; band < kBands; ++band) {
        if (gain(band) >= 0.5) continue;
        if (band == 0) return bandFrequency(0);
        const double share = (gain(band - 1) - 0.5) / (gain(band - 1) - gain(band));
        return bandFrequency(band - 1) * std::pow(bandFrequency(band) / bandFrequency(band - 1), share);
    }
    return bandFrequency(kBands - 1);
}

double blockiness(const ImageRgb8& bgr) {
    const cv::Mat y = luma(asMat(bgr));
    const int top = y.rows / 5, bottom = y.rows * 9 / 20;
    std::vector<double> steps(static_cast<size_t>(y.cols), 0);
    for (int row = top; row < bottom; ++row)
        for (int x = 0; x + 1 < y.cols; ++x)
            steps[static_cast<size_t>(x)] +=
                static_cast<double>(std::fabs(y.at<float>(row, x + 1) - y.at<float>(row, x)));
    double worst = 0;
    for (const size_t size : {size_t{8}, size_t{16}, size_t{32}, size_t{64}}) {
        double between = 0, within = 0;
        size_t borders = 0, others = 0;
        for (size_t x = 0; x + 1 < steps.size(); ++x)
            if (x % size == size - 1)
                between += steps[x], ++borders;
            else if (x % 8 != 7)
                within += steps[x], ++others;
        worst =
            std::max(worst, between / static_cast<double>(borders) / (within / static_cast<double>(others)));
    }
    return worst;
}

} // namespace shoal::bench
