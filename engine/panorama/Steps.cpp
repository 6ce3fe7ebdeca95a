#include "engine/panorama/Steps.h"

#include "engine/light/InverseToneMap.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <limits>

namespace shoal::panorama {

// --- Light

MainLight findMainLight(const cv::Mat& photo) {
    constexpr int kMaxWidth = 1024, kMinHeight = 8;
    cv::Mat small = photo;
    if (photo.cols > kMaxWidth)
        cv::resize(photo, small, {kMaxWidth, std::max(kMinHeight, photo.rows * kMaxWidth / photo.cols)}, 0, 0,
                   cv::INTER_AREA);
    cv::Mat radiance(small.size(), CV_32F), spread;
    std::transform(small.begin<cv::Vec3f>(), small.end<cv::Vec3f>(), radiance.begin<float>(),
                   [](const cv::Vec3f& c) {
                       return light::thesisLuminance(light::radianceFromDisplay({c[0], c[1], c[2]}));
                   });
    cv::GaussianBlur(radiance, spread, {}, std::max(0.5, small.cols * 0.01), 0, cv::BORDER_REPLICATE);
    double maximum = 0;
    cv::Point peak;
    cv::minMaxLoc(spread, nullptr, &maximum, nullptr, &peak);

    cv::Mat spot, labels, numbers, centres;
    cv::bitwise_or(radiance > 0.8 * maximum, spread >= maximum, spot); // the peak itself, whatever lies there
    cv::connectedComponentsWithStats(spot, labels, numbers, centres, 8, CV_32S);
    const int mine = labels.at<int>(peak);
    cv::Mat weight(small.size(), CV_32F, cv::Scalar(0));
    cv::add(radiance, 1e-9, weight, labels == mine);
    const cv::Moments sums = cv::moments(weight);
    const cv::Point2d scale(static_cast<double>(photo.cols) / small.cols,
                            static_cast<double>(photo.rows) / small.rows);
    return {{(sums.m10 / sums.m00 + 0.5) * scale.x, (sums.m01 / sums.m00 + 0.5) * scale.y},
            std::sqrt(numbers.at<int>(mine, cv::CC_STAT_AREA) / std::numbers::pi) * scale.x};
}

// --- Seam insertion

namespace {

struct Widened {
    cv::Mat colours, weight, source;
};

float difference(const float* a, const float* b) {
    return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

// Returns the source columns of an unchanged picture.
cv::Mat columnNumbers(const cv::Size& size) {
    cv::Mat numbers(size, CV_32F);
    for (int x = 0; x < size.width; ++x) numbers.col(x).setTo(x);
    return numbers;
}

// Removes one pixel a row, in the matrix' own memory.
void removeSeam(cv::Mat& image, const std::vector<int>& seam) {
    const size_t pixel = image.elemSize();
    for (int y = 0; y < image.rows; ++y) {
        const int x = seam[y];
        uint8_t* at = image.ptr(y, x);
        std::memmove(at, at + pixel, static_cast<size_t>(image.cols - 1 - x) * pixel);
    }
    image = image.colRange(0, image.cols - 1);
}

// Marks the pixels of the `count` seams that are successively the cheapest to remove.
cv::Mat seamsToDouble(const Widened& now, int count, const std::function<void()>& found) {
    cv::Mat colours = now.colours.clone(), weight = now.weight.clone();
    cv::Mat column = columnNumbers(colours.size()), chosen(colours.size(), CV_8U, cv::Scalar(0));
    for (int k = 0; k < count; ++k) {
        const std::vector<int> seam = minSeam(colours, weight);
        for (int y = 0; y < column.rows; ++y)
            chosen.at<uint8_t>(y, static_cast<int>(column.at<float>(y, seam[y]))) = 1;
        for (cv::Mat* each : {&colours, &weight, &column}) removeSeam(*each, seam);
        found();
    }
    return chosen;
}

// Inserts after each chosen pixel the mean of it and the next.
cv::Mat doubled(const cv::Mat& in, const cv::Mat& chosen, int count) {
    cv::Mat out(in.rows, in.cols + count, in.type());
    const int channels = in.channels();
    for (int y = 0; y < in.rows; ++y) {
        float* to = out.ptr<float>(y);
        for (int x = 0; x < in.cols; ++x) {
            const float* here = in.ptr<float>(y, x);
            const float* next = in.ptr<float>(y, std::min(x + 1, in.cols - 1));
            to = std::copy(here, here + channels, to);
            if (chosen.at<uint8_t>(y, x))
                for (int c = 0; c < channels; ++c) *to++ = 0.5f * (here[c] + next[c]);
        }
    }
    return out;
}

// Returns the mean difference of a pixel from its right neighbour: the scale of the energies.
double meanStep(const cv::Mat& colours) {
    if (colours.cols < 2) return 0;
    return cv::norm(colours.colRange(1, colours.cols), colours.colRange(0, colours.cols - 1), cv::NORM_L1) /
           static_cast<double>(colours.total());
}

} // namespace

std::vector<int> minSeam(const cv::Mat& colours, const cv::Mat& weight) {
    const int w = colours.cols, h = colours.rows;
    assert(w > 0 && h > 0 && weight.size() == colours.size());
    constexpr float kNever = std::numeric_limits<float>::max();

    // Minimum cost of a seam down to each pixel of a row, with a sentinel at each end, and its predecessor.
    std::vector<float> above(w + 2, kNever), here(w + 2, kNever);
    std::fill(above.begin() + 1, above.end() - 1, 0.0f);
    std::vector<float> apart(w), turnLeft(w), turnRight(w);
    cv::Mat from(h, w, CV_8S);
    for (int y = 0; y < h; ++y) {
        const float* row = colours.ptr<float>(y);
        const float* over = colours.ptr<float>(std::max(y - 1, 0));
        for (int x = 0; x < w; ++x) {
            const float* left = row + 3 * std::max(x - 1, 0);
            const float* right = row + 3 * std::min(x + 1, w - 1);
            apart[x] = difference(left, right) + weight.at<float>(y, x);
            turnLeft[x] = difference(over + 3 * x, left);
            turnRight[x] = difference(over + 3 * x, right);
        }
        int8_t* cameFrom = from.ptr<int8_t>(y);
        for (int x = 0; x < w; ++x) {
            const float l = above[x] + turnLeft[x], u = above[x + 1], r = above[x + 2] + turnRight[x];
            const float minimum = std::min(std::min(l, u), r);
            cameFrom[x] = static_cast<int8_t>(u == minimum ? 0 : l == minimum ? -1 : 1);
            here[x + 1] = minimum + apart[x];
        }
        std::swap(above, here);
    }

    std::vector<int> seam(h);
    int x = static_cast<int>(std::min_element(above.begin() + 1, above.end() - 1) - above.begin()) - 1;
    for (int y = h - 1; y >= 0; --y) {
        seam[y] = x;
        x += from.at<int8_t>(y, x);
    }
    return seam;
}

cv::Mat seamInsertionMap(const cv::Mat& colours, const cv::Mat& weight, int columns,
                         const Progress& progress) {
    assert(columns >= colours.cols && weight.size() == colours.size());
    constexpr double kDoubledWeight = 0.4; // added to doubled pixels, in mean steps
    constexpr double kMinWeight = 1e-4;    // spreads insertions where the picture is flat
    const double doubledWeight = kDoubledWeight * meanStep(colours) + kMinWeight;

    Widened now{colours, weight.clone(), columnNumbers(colours.size())};
    const int wanted = columns - colours.cols;
    int done = 0;
    while (done < wanted) {
        const int count = std::min(wanted - done, std::max(1, now.colours.cols / 10));
        const cv::Mat chosen =
            seamsToDouble(now, count, [&] { progress(static_cast<double>(++done) / wanted); });
        cv::add(now.weight, doubledWeight, now.weight, chosen);
        for (cv::Mat* each : {&now.colours, &now.weight, &now.source}) *each = doubled(*each, chosen, count);
    }
    return now.source;
}

void smoothMap(std::vector<float>& map, double sigma_px) {
    if (map.size() < 2) return;
    const float first = map.front(), last = map.back();
    const auto straight = [&](size_t k, float from, float to) {
        return from + (to - from) * static_cast<float>(k) / static_cast<float>(map.size() - 1);
    };
    cv::Mat rest(1, static_cast<int>(map.size()), CV_32F, map.data());
    for (size_t k = 0; k < map.size(); ++k) map[k] -= straight(k, first, last);
    cv::GaussianBlur(rest, rest, {}, sigma_px, 0.1, cv::BORDER_REFLECT);
    const float atFirst = map.front(), atLast = map.back();
    float minimum = first;
    for (size_t k = 0; k < map.size(); ++k) {
        const float placed = straight(k, first, last) + map[k] - straight(k, atFirst, atLast);
        map[k] = minimum = std::clamp(placed, minimum, std::max(minimum, last));
    }
}

// --- Wrap-around

// Returns by how many rows the left end's content lies lower than the right's, for each row half way between.
static std::vector<float> offsets(const cv::Mat& ring) {
    const int rows = ring.rows, maximum = ring.cols * 8 / 360, averaged = std::max(1, ring.cols / 256);
    cv::Mat left, right;
    cv::reduce(ring.colRange(0, averaged), left, 1, cv::REDUCE_AVG);
    cv::reduce(ring.colRange(ring.cols - averaged, ring.cols), right, 1, cv::REDUCE_AVG);
    cv::Mat cost(rows, 2 * maximum + 1, CV_32F);
    const cv::Mat none(cost.size(), CV_32FC3, cv::Scalar::all(0));
    for (int y = 0; y < rows; ++y)
        for (int d = -maximum; d <= maximum; ++d) {
            const int l = std::clamp(y + (d >= 0 ? (d + 1) / 2 : d / 2), 0, rows - 1);
            const int r = std::clamp(l - d, 0, rows - 1);
            const float offsetCost = 0.02f * static_cast<float>(std::abs(d)) / static_cast<float>(maximum);
            cost.at<float>(y, d + maximum) = difference(left.ptr<float>(l), right.ptr<float>(r)) + offsetCost;
        }
    const std::vector<int> seam = minSeam(none, cost);
    cv::Mat found(rows, 1, CV_32F);
    for (int y = 0; y < rows; ++y) found.at<float>(y) = static_cast<float>(seam[y] - maximum);
    cv::GaussianBlur(found, found, {}, 0.1, std::max(1.0, ring.cols / 360.0), cv::BORDER_REPLICATE);
    return {found.begin<float>(), found.end<float>()};
}

// Returns 1 at an end, 0 from `reach` on, with a continuous slope.
static float fade(double distance, double reach) {
    return static_cast<float>(glm::smoothstep(0.0, 1.0, 1 - distance / reach));
}

static void alignRows(cv::Mat& ring) {
    const std::vector<float> lower = offsets(ring);
    const double reach = ring.cols / 6.0;
    const cv::Mat out = remapped(ring, ring.size(), cv::INTER_CUBIC, [&](int x, int y) {
        const float share = 0.5f * (x < ring.cols / 2 ? fade(x, reach) : -fade(ring.cols - 1 - x, reach));
        return cv::Vec2f(static_cast<float>(x), static_cast<float>(y) + share * lower[y]);
    });
    double darkest = 0, brightest = 0;
    cv::minMaxLoc(ring.reshape(1), &darkest, &brightest);
    ring = cv::min(cv::max(out, darkest), brightest);
}

void blendWrapAround(cv::Mat& ring) {
    alignRows(ring);
    cv::Mat rest = ring.col(0) - ring.col(ring.cols - 1);
    // Octave bands of the difference from fine to coarse; the remainder is the coarsest.
    for (double sigma = 1;; sigma *= 2) {
        const bool coarsest = sigma > ring.rows / 4.0;
        cv::Mat coarser, band = rest;
        if (!coarsest) {
            cv::GaussianBlur(rest, coarser, {}, 0.1, sigma, cv::BORDER_REPLICATE);
            band = rest - coarser;
            rest = coarser;
        }
        const double reach = coarsest ? ring.cols / 4.0 : std::min(ring.cols / 4.0, 16 * sigma);
        for (int x = 0; x < static_cast<int>(std::ceil(reach)); ++x) {
            const double share = 0.5 * static_cast<double>(fade(x, reach));
            ring.col(x) -= share * band;
            ring.col(ring.cols - 1 - x) += share * band;
        }
        if (coarsest) break;
    }
    ring = cv::max(ring, 0.0);
}

// --- Poles

namespace {

constexpr double kPi = std::numbers::pi;

struct Extent {
    int width, height;
    int edge, inner; // rows: first known row, and the row up to which it is blended

    int rows(double degrees) const { return std::max(1, static_cast<int>(degrees * height / 180)); }
    double colatitude(double row) const { return row / height * kPi; }
};

// Fits a line to the log mean colours of rows first to last - 1; returns its slope for each row upwards.
cv::Scalar slopeUp(const cv::Mat& picture, int first, int last) {
    cv::Scalar sum;
    double weights = 0;
    const double middle = (first + last - 1) / 2.0;
    for (int y = first; y < last; ++y) {
        const cv::Scalar mean = cv::mean(picture.row(y));
        for (int c = 0; c < 3; ++c) sum[c] += std::log(mean[c] + 0.02) * (middle - y);
        weights += (middle - y) * (middle - y);
    }
    return weights > 0 ? sum * (1 / weights) : cv::Scalar();
}

// Returns the colours of rows 0 to inner (exclusive), extrapolated by circular harmonics.
cv::Mat colours(const cv::Mat& latLong, const Extent& cap) {
    const int below = std::min(cap.inner + cap.rows(1), cap.height);
    cv::Mat source;
    std::array<cv::Mat, 3> harmonics, filled;
    cv::reduce(latLong.rowRange(cap.inner, below), source, 0, cv::REDUCE_AVG);
    cv::split(source, harmonics.data());
    for (cv::Mat& channel : harmonics) cv::dft(channel, channel, cv::DFT_COMPLEX_OUTPUT);

    const cv::Scalar slope = slopeUp(latLong, cap.inner, std::min(cap.inner + cap.rows(12), cap.height));
    const double rest = cap.rows(15); // rows within which the slope decays
    const double rim = std::tan(cap.colatitude((cap.inner + below) / 2.0) / 2);
    constexpr double kMaxChange = 0.5, kMaxHue = 0.15; // greatest changes of the logarithm
    const double common = (slope[0] + slope[1] + slope[2]) / 3;
    cv::Mat out(cap.inner, cap.width, CV_32FC3);
    for (int y = 0; y < cap.inner; ++y) {
        const double ratio = std::tan(cap.colatitude(y + 0.5) / 2) / rim;
        for (size_t c = 0; c < 3; ++c) {
            cv::Mat fallen = harmonics[c].clone();
            for (int k = 0; k < cap.width; ++k)
                fallen.at<cv::Vec2f>(k) *= static_cast<float>(std::pow(ratio, std::min(k, cap.width - k)));
            cv::dft(fallen, filled[c], cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
            // Begins with the picture's own slope.
            const double start =
                std::clamp(slope[static_cast<int>(c)], common - kMaxHue / rest, common + kMaxHue / rest);
            const double maximum = std::min(kMaxChange, std::abs(start) * rest) + 1e-12;
            const double change =
                maximum * (1 - std::exp(-std::abs(start) / maximum * (cap.inner - y - 0.5)));
            filled[c] *= std::exp(std::copysign(change, start));
        }
        cv::Mat row = out.row(y);
        cv::merge(filled.data(), 3, row);
    }
    return out;
}

// The triangle that contains a point of the plane, in a lattice of triangles with sides of length 1.
struct Triangle {
    std::array<cv::Point2i, 3> corners; // lattice coordinates
    std::array<double, 3> barycentric;

    static cv::Point2d placeOf(const cv::Point2i& corner) {
        return {corner.x + 0.5 * corner.y, std::numbers::sqrt3 / 2 * corner.y};
    }
    static Triangle around(const cv::Point2d& place) {
        const double v = place.y * 2 / std::numbers::sqrt3, u = place.x - v / 2;
        const cv::Point2i base(static_cast<int>(std::floor(u)), static_cast<int>(std::floor(v)));
        const double a = u - base.x, b = v - base.y;
        const cv::Point2i right = base + cv::Point2i(1, 0), up = base + cv::Point2i(0, 1);
        if (a + b < 1) return {{base, right, up}, {1 - a - b, a, b}};
        return {{base + cv::Point2i(1, 1), up, right}, {a + b - 1, 1 - a, 1 - b}};
    }
};

// Hashes a corner to an offset of -1 to 1 in both directions.
cv::Point2d randomOffset(const cv::Point2i& corner) {
    uint32_t h =
        static_cast<uint32_t>(corner.x) * 0x9e3779b1u ^ static_cast<uint32_t>(corner.y) * 0x85ebca77u;
    const auto next = [&h] {
        h = (h ^ (h >> 15)) * 0x2c1b3c6du;
        h = (h ^ (h >> 12)) * 0x297a2d39u;
        h ^= h >> 15;
        return h * 0x1p-31 - 1;
    };
    const double x = next();
    return {x, next()};
}

// Returns the texture of rows 0 to inner, as a ratio to the blurred picture: each corner of a triangle
// lattice has a random piece of the example square, and a pixel blends the pieces of its three corners so
// that the variance is kept (Heitz and Neyret 2018, "High-Performance By-Example Noise using a
// Histogram-Preserving Blending Operator").
cv::Mat texture(const cv::Mat& latLong, const Extent& cap) {
    constexpr double kMaxColatitude = 75 * kPi / 180; // beyond it the tangent plane recedes too fast
    constexpr float kMaxContrast = 1.3f;
    const double rim = std::tan(std::min(cap.colatitude(cap.inner), kMaxColatitude));
    const double side = 0.35 * rim, lattice = 0.3 * side, room = side / 2 - lattice;
    cv::Mat ring = latLong.rowRange(cap.inner, cap.height / 2), blurred, ratio;
    cv::copyMakeBorder(ring, blurred, 0, 0, cap.width / 8, cap.width / 8, cv::BORDER_WRAP);
    cv::GaussianBlur(blurred, blurred, {}, cap.rows(3), cap.rows(2), cv::BORDER_REPLICATE);
    blurred = blurred.colRange(cap.width / 8, cap.width / 8 + cap.width);
    const cv::Scalar dark = cv::Scalar::all(0.02);
    cv::divide(ring + dark, blurred + dark, ratio);
    ratio = cv::min(cv::max(ratio, 1 / kMaxContrast), kMaxContrast) - cv::Scalar::all(1);

    cv::Mat out(cap.inner, cap.width, CV_32FC3, cv::Scalar::all(1)), column(cap.inner, cap.width, CV_32F),
        row(column.size(), CV_32F), weight(column.size(), CV_32F), piece;
    for (size_t layer = 0; layer < 3; ++layer) {
        for (int y = 0; y < cap.inner; ++y) {
            const double distance = std::tan(std::min(cap.colatitude(y + 0.5), kMaxColatitude));
            for (int x = 0; x < cap.width; ++x) {
                const double longitude = ((x + 0.5) / cap.width - 0.5) * 2 * kPi;
                const cv::Point2d place(distance * std::sin(longitude), distance * std::cos(longitude));
                const Triangle triangle = Triangle::around(place / lattice);
                const cv::Point2i corner = triangle.corners[layer];
                const cv::Point2d in = place - Triangle::placeOf(corner) * lattice +
                                       randomOffset(corner) * room; // from the square's middle
                const double away = rim + side / 2 + in.y;
                const double u = 0.5 + std::atan2(in.x, away) / (2 * kPi);
                const double v = std::atan(std::hypot(in.x, away)) / kPi;
                column.at<float>(y, x) = static_cast<float>(u * cap.width - 0.5);
                row.at<float>(y, x) = static_cast<float>(v * cap.height - 0.5 - cap.inner);
                const auto& n = triangle.barycentric;
                weight.at<float>(y, x) =
                    static_cast<float>(n[layer] / std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
            }
        }
        cv::remap(ratio, piece, column, row, cv::INTER_LINEAR, cv::BORDER_WRAP);
        cv::Mat weights;
        cv::merge(std::array{weight, weight, weight}, weights);
        out += piece.mul(weights);
    }
    return out;
}

} // namespace

void fillPolarCap(cv::Mat& latLong, int edge, PolarCap kind) {
    Extent cap{latLong.cols, latLong.rows, edge, 0};
    cap.inner = std::min(edge + cap.rows(5), cap.height / 2 - 1);
    cv::Mat filled = colours(latLong, cap);
    if (kind == PolarCap::Ground) cv::multiply(filled, texture(latLong, cap), filled);
    filled = cv::max(filled, 0.0);
    for (int y = 0; y < cap.inner; ++y) {
        const double own = y < edge ? 0 : glm::smoothstep(0.0, 1.0, (y - edge + 0.5) / (cap.inner - edge));
        cv::Mat row = latLong.row(y);
        cv::addWeighted(row, own, filled.row(y), 1 - own, 0, row);
    }
}

} // namespace shoal::panorama
