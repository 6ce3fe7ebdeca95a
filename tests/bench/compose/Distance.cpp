#include "tests/bench/compose/Distance.h"

#include <opencv2/imgproc.hpp>

namespace shoal::bench {

namespace {

constexpr int kPatch = 32, kNear = 4;
using Spectrum = std::array<double, kPatch / 2>; // power by whole cycles a patch, from 0

cv::Mat matOf(const ImageRgba8& image) {
    return {image.height, image.width, CV_8UC4, const_cast<uint8_t*>(image.pixels.data())};
}

// Rec. 709, of 255.
cv::Mat lumaOf(const cv::Mat& rgba) {
    cv::Mat values, luma;
    rgba.convertTo(values, CV_32F);
    cv::transform(values, luma, cv::Matx14f(0.2126f, 0.7152f, 0.0722f, 0));
    return luma;
}

void addSpectrum(const cv::Mat& luma, const cv::Rect& patch, Spectrum& sum) {
    static const cv::Mat window = [] {
        cv::Mat_<float> along(kPatch, 1);
        for (int i = 0; i < kPatch; ++i)
            along(i) = static_cast<float>(0.5 - 0.5 * std::cos(2 * std::numbers::pi * (i + 0.5) / kPatch));
        return cv::Mat(along * along.t());
    }();
    const cv::Mat part = luma(patch) - cv::mean(luma(patch))[0];
    cv::Mat_<cv::Vec2f> waves;
    cv::dft(part.mul(window), waves, cv::DFT_COMPLEX_OUTPUT);
    for (int k = 0; k < kPatch; ++k)
        for (int l = 0; l < kPatch; ++l) {
            const double fx = k < kPatch / 2 ? k : k - kPatch, fy = l < kPatch / 2 ? l : l - kPatch;
            const auto ring = static_cast<size_t>(std::lround(std::hypot(fx, fy)));
            if (ring < sum.size()) sum[ring] += cv::norm(waves(l, k), cv::NORM_L2SQR);
        }
}

// Returns the share of the power beyond an eighth of a cycle a pixel.
double detail(const Spectrum& spectrum) {
    double all = 0, fine = 0;
    for (size_t ring = 1; ring < spectrum.size(); ++ring) {
        all += spectrum[ring];
        if (ring > kPatch / 8) fine += spectrum[ring];
    }
    return fine / std::max(all, 1e-9);
}

} // namespace

Distance distance(const ImageRgba8& shown, const ImageRgba8& truth, const Coverage& objects) {
    const cv::Mat coverage(objects.height, objects.width, CV_32F, const_cast<float*>(objects.pixels.data()));
    const cv::Mat near = cv::Mat::ones(2 * kNear + 1, 2 * kNear + 1, CV_8U);
    cv::Mat largest, smallest; // coverage within kNear pixels
    cv::dilate(coverage, largest, near);
    cv::erode(coverage, smallest, near);
    const cv::Mat wide = largest > 0, inside = smallest >= 1;
    const cv::Mat luma = lumaOf(matOf(shown)), trueLuma = lumaOf(matOf(truth));
    cv::Mat colour, trueColour, laplacian;
    cv::cvtColor(matOf(shown), colour, cv::COLOR_RGBA2RGB);
    cv::cvtColor(matOf(truth), trueColour, cv::COLOR_RGBA2RGB);
    const cv::Matx31f bend(1, -2, 1);
    cv::sepFilter2D(luma, laplacian, CV_32F, bend, bend);

    // Root mean squares over what a mask holds, without the outermost pixels.
    const cv::Rect inner(1, 1, shown.width - 2, shown.height - 2);
    const auto meanOver = [&](const cv::Mat& mask, double norm) {
        return norm / std::sqrt(std::max(cv::countNonZero(mask(inner)), 1));
    };
    Distance out;
    out.luma = meanOver(wide, cv::norm(luma(inner), trueLuma(inner), cv::NORM_L2, wide(inner)));
    out.colour = meanOver(wide, cv::norm(colour(inner), trueColour(inner), cv::NORM_L2, wide(inner))) /
                 std::numbers::sqrt3;
    out.noise = meanOver(inside, cv::norm(laplacian(inner), cv::NORM_L2, inside(inner))) / 6;

    Spectrum ours{}, theirs{}, around{};
    for (int top = 0; top + kPatch <= shown.height; top += kPatch / 2)
        for (int left = 0; left + kPatch <= shown.width; left += kPatch / 2) {
            const cv::Rect patch(left, top, kPatch, kPatch);
            if (cv::mean(coverage(patch))[0] > 0.25) {
                addSpectrum(luma, patch, ours);
                addSpectrum(trueLuma, patch, theirs);
            } else if (cv::countNonZero(wide(patch)) == 0) {
                bool beside = false; // within two patches
                for (int j = -2; j <= 2; ++j)
                    for (int i = -2; i <= 2; ++i) {
                        const cv::Point at(left + kPatch / 2 + i * kPatch, top + kPatch / 2 + j * kPatch);
                        beside |= cv::Rect({}, coverage.size()).contains(at) && coverage.at<float>(at) > 0.5f;
                    }
                if (beside) addSpectrum(luma, patch, around);
            }
        }
    int rings = 0;
    for (size_t ring = 1; ring < ours.size(); ++ring, ++rings)
        out.spectrum_db += std::pow(10 * std::log10((ours[ring] + 1) / (theirs[ring] + 1)), 2);
    out.spectrum_db = std::sqrt(out.spectrum_db / std::max(rings, 1));
    out.detail_db = 10 * std::log10(detail(ours) / std::max(detail(around), 1e-9));
    return out;
}

} // namespace shoal::bench
