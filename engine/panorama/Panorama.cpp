#include "engine/panorama/Panorama.h"

#include "engine/panorama/FindLight.h"
#include "engine/panorama/PolarCaps.h"
#include "engine/panorama/RingMap.h"
#include "engine/panorama/WrapBlend.h"

#include <glm/common.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

namespace shoal::panorama {

namespace {

// --- Pictures and the perceptually coded matrices that this folder computes on: 3 floats a pixel, red first

template <class T> cv::Mat viewOf(const Image<T, 3>& picture) {
    return {picture.height, picture.width, CV_MAKETYPE(cv::DataType<T>::depth, 3),
            const_cast<T*>(picture.pixels.data())};
}

// Codes radiance by a power up to 1 and by a logarithm above, which meet in value and slope: a sun 10^5 times
// as bright as white does not dominate the colours that it is blended with.
float codedFromRadiance(float linear) {
    return linear <= 1 ? std::pow(std::max(linear, 0.0f), 1 / 2.2f) : 1 + std::log(linear) / 2.2f;
}
float radianceFromCoded(float coded) {
    return coded <= 1 ? std::pow(std::max(coded, 0.0f), 2.2f) : std::exp((coded - 1) * 2.2f);
}

// Replaces each channel of each pixel of a picture of floats.
void replaceEach(cv::Mat picture, float (*by)(float)) {
    for (float& channel : cv::Mat_<float>(picture.reshape(1))) channel = by(channel);
}

// Codes floats, which are linear radiance; 8-bit pictures are coded already.
cv::Mat codedFrom(const cv::Mat& picture) {
    cv::Mat coded;
    picture.convertTo(coded, CV_32F, picture.depth() == CV_8U ? 1 / 255.0 : 1);
    if (picture.depth() != CV_8U) replaceEach(coded, codedFromRadiance);
    return coded;
}

template <class Picture> Picture pictureFromCoded(const cv::Mat& coded) {
    Picture out(coded.cols, coded.rows);
    cv::Mat to = viewOf(out);
    coded.convertTo(to, to.depth(), to.depth() == CV_8U ? 255 : 1);
    if (to.depth() != CV_8U) replaceEach(to, radianceFromCoded);
    return out;
}

// --- Growing a photo

constexpr double kDefaultFov_deg = 65;
constexpr double kBand_deg = 45; // extent of the ring from the horizon up and down
constexpr int kMaxPhotoWidth = 6144, kMaxPhotoHeight = 3072;

double fovOf(double width, double height, const PanoramaOptions& options) {
    if (options.fov_deg) return *options.fov_deg * kRadiansPerDegree;
    const double half = std::tan(kDefaultFov_deg / 2 * kRadiansPerDegree);
    return 2 * std::atan(half * width / std::max(width, height));
}

Status checkPhoto(int width, int height, const PanoramaOptions& options) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height) + " pixels";
    if (std::min(width, height) < kMinSide)
        return Error{"", "its " + size + " are too few to grow; each side wants " + std::to_string(kMinSide) +
                             " at least"};
    if (std::max(width, height) > kMaxAspect * std::min(width, height))
        return Error{"", "its " + size + " are too long a strip to grow"};
    if (options.fov_deg && !(*options.fov_deg >= kMinFov_deg && *options.fov_deg <= kMaxFov_deg))
        return Error{"", "a photo's field of view lies between 10 and 150 degrees"};
    return Done{};
}

int widthFor(int photoWidth, double fov) {
    const int detailed = static_cast<int>(photoWidth * 2 * std::numbers::pi / fov);
    return std::clamp(detailed / 64 * 64, 512, 4096);
}

// Returns the photo, reduced if it has more pixels than any panorama could show.
cv::Mat bounded(const cv::Mat& photo) {
    const double scale =
        std::min({1.0, static_cast<double>(kMaxPhotoWidth) / photo.cols, kMaxPhotoHeight * 1.0 / photo.rows});
    if (scale == 1) return photo;
    cv::Mat smaller;
    cv::resize(photo, smaller,
               {std::max(kMinSide, static_cast<int>(photo.cols * scale)),
                std::max(kMinSide, static_cast<int>(photo.rows * scale))},
               0, 0, cv::INTER_AREA);
    return smaller;
}

// Returns the photo, reduced and projected to latitude and longitude.
cv::Mat patchOf(const cv::Mat& photo, const Lens& lens) {
    const auto pixels = [](double radians) {
        return std::max(4, static_cast<int>(std::lround(radians / kRadiansPerDegree * kMapPixelsPerDegree)));
    };
    const cv::Size size(std::min(pixels(2 * lens.longitude), kMapWidth), pixels(2 * lens.latitude));
    cv::Mat small, patch, column(size, CV_32F), row(size, CV_32F);
    cv::resize(photo, small, size, 0, 0, cv::INTER_AREA);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const double lon = ((x + 0.5) / size.width * 2 - 1) * lens.longitude;
            const double lat = (1 - (y + 0.5) / size.height * 2) * lens.latitude;
            column.at<float>(y, x) = static_cast<float>(lens.columnOf(lon) / lens.width * small.cols - 0.5);
            row.at<float>(y, x) = static_cast<float>(lens.rowOf(lon, lat) / lens.height * small.rows - 0.5);
        }
    cv::remap(small, patch, column, row, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    return patch;
}

// Scales a map of the ring's columns or rows to its full size. Returns positions in the patch, -1 to 1.
std::vector<double> scaledUp(const std::vector<float>& map, int size, int patchSize) {
    cv::Mat large;
    cv::resize(cv::Mat(1, static_cast<int>(map.size()), CV_32F, const_cast<float*>(map.data())), large,
               {size, 1}, 0, 0, cv::INTER_LINEAR);
    std::vector<double> shares(static_cast<size_t>(size));
    for (int k = 0; k < size; ++k)
        shares[static_cast<size_t>(k)] =
            std::clamp((static_cast<double>(large.at<float>(k)) + 0.5) / patchSize * 2 - 1, -1.0, 1.0);
    return shares;
}

// Computes for each pixel of the ring at its full size the photo's column and row.
void photoFromRing(const RingMap& map, const Lens& lens, const cv::Size& patch, cv::Mat& column,
                   cv::Mat& row) {
    const std::vector<double> across = scaledUp(map.column, column.cols, patch.width);
    const std::vector<double> down = scaledUp(map.row, column.rows, patch.height);
    for (int y = 0; y < column.rows; ++y)
        for (int x = 0; x < column.cols; ++x) {
            const double lon = across[static_cast<size_t>(x)] * lens.longitude;
            const double lat = -down[static_cast<size_t>(y)] * lens.latitude;
            column.at<float>(y, x) = static_cast<float>(lens.columnOf(lon));
            row.at<float>(y, x) = static_cast<float>(lens.rowOf(lon, lat));
        }
}

void rotateColumns(cv::Mat& picture, int toRight) {
    const int w = picture.cols, by = ((toRight % w) + w) % w;
    if (by == 0) return;
    cv::Mat turned;
    cv::hconcat(picture.colRange(w - by, w), picture.colRange(0, w - by), turned);
    picture = turned;
}

// Returns the fractional column of the ring that shows this column of the patch.
double ringColumn(const std::vector<float>& map, double patchColumn) {
    const double wanted = patchColumn - 0.5;
    const auto after = std::upper_bound(map.begin() + 1, map.end() - 1, static_cast<float>(wanted));
    const double before = static_cast<double>(*(after - 1));
    const double step = std::max(1e-6, static_cast<double>(*after) - before);
    return static_cast<double>(after - map.begin()) - 0.5 + std::clamp((wanted - before) / step, 0.0, 1.0);
}

// Returns the fractional mip level of each pixel.
cv::Mat levelOf(const cv::Mat& column, int levels) {
    cv::Mat level(column.size(), CV_32F);
    for (int y = 0; y < column.rows; ++y) {
        const float* at = column.ptr<float>(y);
        float* to = level.ptr<float>(y);
        for (int x = 0; x < column.cols; ++x) {
            const int left = std::max(x - 1, 0), right = std::min(x + 1, column.cols - 1);
            const float step = (at[right] - at[left]) / static_cast<float>(std::max(1, right - left));
            to[x] =
                std::clamp(std::log2(std::max(std::abs(step), 1.0f)), 0.0f, static_cast<float>(levels - 1));
        }
    }
    return level;
}

// Returns mip levels of the photo, each half as wide as the last and of the same height.
std::vector<cv::Mat> widthPyramid(const cv::Mat& photo) {
    std::vector<cv::Mat> levels{photo};
    while (levels.back().cols >= 8) {
        cv::Mat half;
        cv::resize(levels.back(), half, {levels.back().cols / 2, photo.rows}, 0, 0, cv::INTER_AREA);
        levels.push_back(half);
    }
    return levels;
}

// Samples the photo at column(x, y), row(x, y) for each pixel, both in pixels with the middle of the first at
// 0.5. Filters horizontally between two levels by the distance of neighbouring columns; vertically rows are
// assumed to be about one apart. Beyond the edges the last pixel repeats. Keeps the photo's range.
cv::Mat resample(const cv::Mat& photo, const cv::Mat& column, const cv::Mat& row) {
    const std::vector<cv::Mat> levels = widthPyramid(photo);
    const cv::Mat level = levelOf(column, static_cast<int>(levels.size()));
    double minimum = 0, maximum = 0;
    cv::minMaxLoc(level, &minimum, &maximum);
    cv::Mat out = cv::Mat::zeros(column.size(), CV_32FC3);
    const cv::Mat rows = row - 0.5;
    for (int k = static_cast<int>(minimum); k <= static_cast<int>(std::ceil(maximum)); ++k) {
        const cv::Mat& from = levels[static_cast<size_t>(k)];
        const cv::Mat columns = column * (static_cast<double>(from.cols) / levels[0].cols) - 0.5;
        cv::Mat read;
        cv::remap(from, read, columns, rows, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
        for (int y = 0; y < out.rows; ++y) {
            const float* at = level.ptr<float>(y);
            for (int x = 0; x < out.cols; ++x) {
                const float share = std::max(0.0f, 1 - std::abs(at[x] - static_cast<float>(k)));
                if (share > 0) out.at<cv::Vec3f>(y, x) += share * read.at<cv::Vec3f>(y, x);
            }
        }
    }
    // A cubic kernel overshoots at edges: beside a sun it would be brighter than the sun.
    double darkest = 0, brightest = 0;
    cv::minMaxLoc(levels[0].reshape(1), &darkest, &brightest);
    return cv::min(cv::max(out, darkest), brightest);
}

// Resamples the photo to the ring, `width` columns wide.
cv::Mat ringOf(const cv::Mat& photo, const RingMap& map, const Lens& lens, const cv::Size& patch, int width) {
    const double perRadian = width / (2 * std::numbers::pi);
    const double ringHeight = static_cast<double>(map.row.size()) / kMapPixelsPerDegree * kRadiansPerDegree;
    cv::Mat column(static_cast<int>(std::lround(ringHeight * perRadian)), width, CV_32F),
        row(column.size(), CV_32F);
    photoFromRing(map, lens, patch, column, row);
    // Reduces to the panorama's resolution vertically; horizontally resample() does.
    cv::Mat reduced = photo;
    const int rowsNeeded = static_cast<int>(std::lround(2 * lens.latitude * perRadian));
    if (rowsNeeded < photo.rows)
        cv::resize(photo, reduced, {photo.cols, std::max(rowsNeeded, 4)}, 0, 0, cv::INTER_AREA);
    row *= static_cast<double>(reduced.rows) / photo.rows;
    return resample(reduced, column, row);
}

// Fills a lat-long picture above and below its known rows, top to bottom (exclusive).
void fillPoles(cv::Mat& sphere, int top, int bottom) {
    if (top > 0) fillPolarCap(sphere, top, PolarCap::Sky);
    cv::flip(sphere, sphere, 0);
    if (bottom < sphere.rows) fillPolarCap(sphere, sphere.rows - bottom, PolarCap::Ground);
    cv::flip(sphere, sphere, 0);
}

// Puts the ring on the sphere, its lightColumn in the middle, and fills the poles. topLatitude: radians.
cv::Mat sphereFrom(const cv::Mat& ring, double topLatitude, double lightColumn) {
    const int width = ring.cols;
    cv::Mat sphere = cv::Mat::zeros(width / 2, width, CV_32FC3);
    const double perRadian = width / (2 * std::numbers::pi);
    const int top = std::clamp(
        static_cast<int>(std::lround((std::numbers::pi / 2 - topLatitude) * perRadian)), 1, width / 4 - 1);
    const int bottom = std::min(top + ring.rows, width / 2 - 1);
    ring.rowRange(0, bottom - top).copyTo(sphere.rowRange(top, bottom));
    rotateColumns(sphere, static_cast<int>(std::lround(width / 2 - lightColumn)));
    fillPoles(sphere, top, bottom);
    return sphere;
}

// photo: 3 coded floats, bounded; the panorama is coded alike.
Panorama<cv::Mat> panoramaFromCoded(const cv::Mat& photo, double fov, int width, const Progress& progress) {
    const auto done = [&](double fraction) {
        if (progress) progress(fraction);
    };
    const MainLight light = findMainLight(photo);
    const Lens lens = Lens::make(photo.cols, photo.rows, fov);
    const cv::Mat patch = patchOf(photo, lens);
    const double lightLon = lens.longitudeOf(light.place.x);
    const double lightLat = lens.latitudeOf(lightLon, light.place.y);
    const LightInPatch inPatch{(lightLon / lens.longitude + 1) / 2 * patch.cols,
                               (1 - lightLat / lens.latitude) / 2 * patch.rows,
                               light.radius_px / photo.cols * patch.cols};
    const RingMap map = makeRingMap(patch, lens, inPatch, kBand_deg * kRadiansPerDegree,
                                    [&](double fraction) { done(0.7 * fraction); });
    done(0.75);
    cv::Mat ring = ringOf(photo, map, lens, patch.size(), width);
    done(0.85);
    blendWrapAround(ring);
    const WrapDiscontinuity steps = wrapDiscontinuity(ring);
    done(0.9);
    const double lightColumn = ringColumn(map.column, inPatch.column) / kMapWidth * width;
    const cv::Mat sphere = sphereFrom(ring, map.top, lightColumn);
    done(1);
    return {sphere,
            {light.place.x, light.place.y},
            lightLat / kRadiansPerDegree,
            steps.wrapStep,
            steps.usualStep};
}

// --- Completing a part

// Fills the gap between a picture's two ends: columns right to left + width (exclusive), wrapping around.
void fillGap(cv::Mat& rows, int left, int right) {
    const int gap = left + rows.cols - right;
    // Mirrors only up to the light, so that it is not repeated.
    const double light = findMainLight(rows.colRange(left, right)).place.x;
    const auto mirrored = [](int steps, int size) {
        return cv::borderInterpolate(steps, size, cv::BORDER_REFLECT);
    };
    const auto depth = [&](double toLight) { return std::max(1, static_cast<int>(0.7 * toLight)); };
    const int depthLeft = depth(light), depthRight = depth(right - left - light);
    for (int k = 0; k < gap; ++k) {
        const double fromLeft =
            glm::smoothstep(0.0, 1.0, (k + 0.5) / gap); // the left end lies to the right of the gap
        cv::Mat to = rows.col((right + k) % rows.cols);
        cv::addWeighted(rows.col(right - 1 - mirrored(k, depthRight)), 1 - fromLeft,
                        rows.col(left + mirrored(gap - 1 - k, depthLeft)), fromLeft, 0, to);
    }
}

cv::Mat completed(const cv::Mat& photo, const PanoramaPart& part, int width) {
    const int height = width / 2;
    const auto pixel = [](double share, int size) { return static_cast<int>(std::lround(share * size)); };
    const int left = pixel(part.left, width), right = pixel(part.right, width);
    int top = pixel(part.top, height), bottom = pixel(part.bottom, height);
    cv::Mat sphere = cv::Mat::zeros(height, width, CV_32FC3), resized;
    const bool smaller = right - left < photo.cols || bottom - top < photo.rows;
    cv::resize(photo, resized, {right - left, bottom - top}, 0, 0,
               smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
    resized.copyTo(sphere(cv::Rect(left, top, right - left, bottom - top)));
    cv::Mat rows = sphere.rowRange(top, bottom);
    if (right - left < width) fillGap(rows, left, right);
    // A part on one side of the horizon is continued to it by its edge row: a polar cap fills less than half.
    for (; top >= height / 2; --top) sphere.row(top).copyTo(sphere.row(top - 1));
    for (; bottom <= height / 2; ++bottom) sphere.row(bottom - 1).copyTo(sphere.row(bottom));
    fillPoles(sphere, top, bottom);
    return sphere;
}

} // namespace

template <class Picture>
Result<Panorama<Picture>> panoramaFromPhoto(const Picture& photo, const PanoramaOptions& options) {
    if (Status s = checkPhoto(photo.width, photo.height, options); !s) return s.error();
    const cv::Mat coded = codedFrom(bounded(viewOf(photo)));
    const double fov = fovOf(photo.width, photo.height, options);
    const Panorama<cv::Mat> made =
        panoramaFromCoded(coded, fov, widthFor(photo.width, fov), options.progress);
    return Panorama<Picture>{pictureFromCoded<Picture>(made.latLong),
                             made.lightInPhoto * (photo.width * 1.0 / coded.cols), made.lightLatitude_deg,
                             made.wrapStep, made.usualStep};
}

template <class Picture> Result<Picture> completePanorama(const Picture& photo, const PanoramaPart& part) {
    assert(part.left < part.right && part.top < part.bottom && part.left >= 0 && part.top >= 0 &&
           part.right <= 1 && part.bottom <= 1);
    const double whole = photo.width / (part.right - part.left);
    const int width = static_cast<int>(std::clamp(whole, 512.0, 4096.0)) / 64 * 64;
    if ((part.right - part.left) * width < 2 || (part.bottom - part.top) * width / 2 < 2)
        return Error{"", "the part of the environment that it says it is, is too small to be shown"};
    cv::Mat bounded = viewOf(photo);
    if (photo.width > width)
        cv::resize(bounded, bounded, {width, std::max(1, std::min(photo.height, width))}, 0, 0,
                   cv::INTER_AREA);
    return pictureFromCoded<Picture>(completed(codedFrom(bounded), part, width));
}

template Result<Panorama<ImageRgb8>> panoramaFromPhoto(const ImageRgb8&, const PanoramaOptions&);
template Result<Panorama<ImageRgbF>> panoramaFromPhoto(const ImageRgbF&, const PanoramaOptions&);
template Result<ImageRgb8> completePanorama(const ImageRgb8&, const PanoramaPart&);
template Result<ImageRgbF> completePanorama(const ImageRgbF&, const PanoramaPart&);

} // namespace shoal::panorama
