#include "engine/panorama/Panorama.h"

#include "engine/panorama/Steps.h"

#include <fmt/core.h>
#include <glm/common.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace shoal::panorama {

namespace {

// --- Pictures and the perceptually coded matrices that this folder computes on: 3 floats a pixel, red first

template <class T> cv::Mat viewOf(const Image<T, 3>& picture) {
    return {picture.height, picture.width, CV_MAKETYPE(cv::DataType<T>::depth, 3),
            const_cast<T*>(picture.pixels.data())};
}

// Codes radiance by a power up to 1 and by a logarithm above 1, continuous in value and slope. The logarithm
// keeps a sun 10^5 times as bright as white from dominating the colours that it is blended with.
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

// --- The ring: a photo widened to 360 degrees by seam insertion, stored as a map from the ring to the photo.
// The map is computed on a reduced picture; it is smooth, so that it can be scaled to any size.

// Resolution of the seam search and of the map.
constexpr int kMapPixelsPerDegree = 4;
constexpr int kMapWidth = 360 * kMapPixelsPerDegree;

// Column and row in the patch, which is the photo as a piece of the lat-long picture at kMapPixelsPerDegree,
// for each column and row of the ring, centres at whole numbers.
struct RingMap {
    std::vector<float> column; // kMapWidth
    std::vector<float> row;
    double top = 0; // latitude of the ring's upper edge, radians; the ring's rows go down from it
};

constexpr double px(double degrees) { return degrees * kMapPixelsPerDegree; }

// The light and a margin around it are not stretched; outside the margin stretching increases over kFade.
constexpr double kLargestLight = px(10), kAroundLight = px(5), kFade = px(14);
constexpr int kMaxSideways = 6, kMaxUpward = 4; // greatest stretching
constexpr double kSmoothAround = px(2), kSmoothUp = px(2);
constexpr double kBand_deg = 45; // extent of the ring from the horizon up and down
// Weights that keep seams away.
constexpr double kProhibitive = 10; // more than any pixel can differ from its neighbour
constexpr double kVertical = 4;     // times the edge's own step
constexpr double kTexture = 0.25;   // times the local gradient

// Returns weights for seamInsertionMap(): high along vertical edges as long as a quarter of the picture's
// height, and slightly raised by any texture.
cv::Mat seamWeights(const cv::Mat& picture) {
    cv::Mat grey, across, down, vertical;
    cv::cvtColor(picture, grey, cv::COLOR_RGB2GRAY);
    const cv::Matx13f between(-0.5f, 0, 0.5f);
    cv::filter2D(grey, across, CV_32F, between, {-1, -1}, 0, cv::BORDER_REPLICATE);
    cv::filter2D(grey, down, CV_32F, between.t(), {-1, -1}, 0, cv::BORDER_REPLICATE);

    // Steps of one sign add up along a vertical edge; those of texture cancel.
    cv::boxFilter(across, vertical, CV_32F, {1, std::max(1, picture.rows / 4)}, {-1, -1}, true,
                  cv::BORDER_REPLICATE);
    vertical = cv::abs(vertical);
    // The space between two close edges, such as a post, is protected with them.
    const int close = std::max(3, picture.cols / 32) | 1;
    cv::morphologyEx(vertical, vertical, cv::MORPH_CLOSE, cv::Mat::ones(1, close, CV_8U));
    cv::dilate(vertical, vertical, cv::Mat::ones(1, 3, CV_8U));

    cv::Mat texture = cv::abs(across) + cv::abs(down);
    cv::GaussianBlur(texture, texture, {}, std::max(0.5, picture.cols / 120.0), 0, cv::BORDER_REPLICATE);

    return kVertical * vertical + kTexture * texture;
}

Progress within(const Progress& progress, double from, double to) {
    return [&progress, from, to](double share) { progress(from + (to - from) * share); };
}

// Widens columns first to last (exclusive) to `count` and appends them to the map: the means of their source
// columns over all rows, so that vertical lines stay straight.
void insertColumns(const cv::Mat& picture, const cv::Mat& weight, int first, int last, int count,
                   const Progress& progress, std::vector<float>& map) {
    if (first >= last) return;
    cv::Mat mean;
    cv::reduce(seamInsertionMap(picture.colRange(first, last), weight.colRange(first, last),
                                std::max(count, last - first), progress),
               mean, 0, cv::REDUCE_AVG);
    for (const float at : cv::Mat_<float>(mean)) map.push_back(at + static_cast<float>(first));
}

// No seam crosses the columns of the light (in the patch) and around it; then the weight falls over `fade`.
std::vector<float> insertSideways(const cv::Mat& patch, const MainLight& light, const Progress& progress) {
    const int w = patch.cols, middle = std::clamp(static_cast<int>(std::lround(light.place.x)), 0, w);
    const double half = std::min(light.radius_px, kLargestLight) + kAroundLight;
    const double fade = std::min(kFade, w * 0.12);
    cv::Mat weight = seamWeights(patch);
    const double usual = cv::mean(weight)[0] + 1e-3;
    for (int x = 0; x < w; ++x) {
        const double beyond = std::abs(x + 0.5 - light.place.x) - half;
        const double near = std::clamp(1 - beyond / fade, 0.0, 1.0);
        weight.col(x) += beyond <= 0 ? kProhibitive : 4 * usual * near * near;
    }
    const auto maximum = [](int columns) { return std::min(kMapWidth / 2, kMaxSideways * columns); };
    const int left = middle == 0 ? 0 : std::max(maximum(middle), kMapWidth - maximum(w - middle));
    std::vector<float> map;
    insertColumns(patch, weight, 0, middle,
                  middle == w ? kMapWidth : std::min(left, kMapWidth - (w - middle)),
                  within(progress, 0, 0.5), map);
    insertColumns(patch, weight, middle, w, kMapWidth - static_cast<int>(map.size()),
                  within(progress, 0.5, 1), map);
    smoothMap(map, kSmoothAround);
    return map;
}

// Widens either side of the light to half the ring, or sixfold if that is less, and gives the other side the
// rest. The ring should reach kBand_deg up and down. The parts above and below light and horizon are
// stretched fourfold at most, so a photo in which these parts are small reaches less far; full: they are
// stretched to the poles by any factor. light: in pixels of the patch.
RingMap makeRingMap(const cv::Mat& patch, const Lens& lens, const MainLight& light, bool full,
                    const Progress& progress) {
    RingMap ring;
    ring.column = insertSideways(patch, light, within(progress, 0, 0.8));

    // Between the light and the horizon, and around both, heights are not stretched.
    const double horizon = patch.rows / 2.0;
    const double margin = std::min(light.radius_px, kLargestLight) + kAroundLight / 2;
    const auto row = [&](double y) { return static_cast<int>(std::clamp(y, 0.0, patch.rows * 1.0)); };
    const int upperEnd = row(std::min(light.place.y - margin, horizon - kAroundLight / 2));
    const int lowerStart = row(std::max(light.place.y + margin, horizon + kAroundLight / 2));
    const double lacking = px((kBand_deg * kRadiansPerDegree - lens.latitude) / kRadiansPerDegree);
    const int toPoles = kMapWidth / 2 - patch.rows; // rows that are lacking above and below together
    const auto rowsFor = [&](int have, int toPole) {
        if (full && have > 0) return have + toPole;
        return static_cast<int>(std::clamp(have + lacking, have * 1.0, have * kMaxUpward * 1.0));
    };
    // The patch widened to the ring, transposed, at a quarter of the map's columns: enough for seams across.
    const cv::Mat turned = remapped(patch, {patch.rows, kMapWidth / 4}, cv::INTER_LINEAR, [&](int x, int y) {
        return cv::Vec2f(ring.column[4 * y + 2], static_cast<float>(x));
    });
    const cv::Mat weight = seamWeights(turned);
    const int up = rowsFor(upperEnd, toPoles / 2),
              down = rowsFor(patch.rows - lowerStart, toPoles - toPoles / 2);
    insertColumns(turned, weight, 0, upperEnd, up, within(progress, 0.8, 0.9), ring.row);
    for (int y = upperEnd; y < lowerStart; ++y) ring.row.push_back(static_cast<float>(y));
    insertColumns(turned, weight, lowerStart, patch.rows, down, within(progress, 0.9, 1), ring.row);
    smoothMap(ring.row, kSmoothUp);
    ring.top = full && up > 0 ? std::numbers::pi / 2
                              : lens.latitude + (up - upperEnd) * kRadiansPerDegree / kMapPixelsPerDegree;
    return ring;
}

// --- Extrapolating a photo

constexpr double kDefaultFov_deg = 65;
constexpr int kMaxPhotoWidth = 6144, kMaxPhotoHeight = 3072;

Status checkPhoto(int width, int height, const PanoramaOptions& options) {
    if (std::min(width, height) < kMinSide)
        return Error{"", fmt::format("its {}x{} pixels are too few for a panorama; sides need {} at least",
                                     width, height, kMinSide)};
    if (std::max(width, height) > kMaxAspect * std::min(width, height))
        return Error{"", fmt::format("its {}x{} pixels are too elongated for a panorama", width, height)};
    if (options.fov_deg && !(*options.fov_deg >= kMinFov_deg && *options.fov_deg <= kMaxFov_deg))
        return Error{"", "a photo's field of view lies between 10 and 150 degrees"};
    return Done{};
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
    cv::Mat small;
    cv::resize(photo, small, size, 0, 0, cv::INTER_AREA);
    return remapped(small, size, cv::INTER_LINEAR, [&](int x, int y) {
        const double lon = ((x + 0.5) / size.width * 2 - 1) * lens.longitude;
        const double lat = (1 - (y + 0.5) / size.height * 2) * lens.latitude;
        return cv::Vec2f(static_cast<float>(lens.columnOf(lon) / lens.width * small.cols - 0.5),
                         static_cast<float>(lens.rowOf(lon, lat) / lens.height * small.rows - 0.5));
    });
}

// Scales a map of the ring's columns or rows to its full size. Returns positions in the patch, -1 to 1.
cv::Mat1d scaledUp(const std::vector<float>& map, int size, int patchSize) {
    cv::Mat large;
    cv::resize(cv::Mat(map).reshape(0, 1), large, {size, 1}, 0, 0, cv::INTER_LINEAR);
    large.convertTo(large, CV_64F, 2.0 / patchSize, 1.0 / patchSize - 1);
    return cv::Mat1d(cv::min(cv::max(large, -1), 1));
}

// Computes for each pixel of the ring at its full size the photo's column and row.
void photoFromRing(const RingMap& map, const Lens& lens, const cv::Size& patch, cv::Mat& column,
                   cv::Mat& row) {
    const cv::Mat1d across = scaledUp(map.column, column.cols, patch.width);
    const cv::Mat1d down = scaledUp(map.row, column.rows, patch.height);
    for (int y = 0; y < column.rows; ++y)
        for (int x = 0; x < column.cols; ++x) {
            const double lon = across(x) * lens.longitude, lat = -down(y) * lens.latitude;
            column.at<float>(y, x) = static_cast<float>(lens.columnOf(lon));
            row.at<float>(y, x) = static_cast<float>(lens.rowOf(lon, lat));
        }
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
        const cv::Mat& from = levels[k];
        const cv::Mat columns = column * (static_cast<double>(from.cols) / levels[0].cols) - 0.5;
        cv::Mat read;
        cv::remap(from, read, columns, rows, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
        for (int y = 0; y < out.rows; ++y)
            for (int x = 0; x < out.cols; ++x) {
                const float share = 1 - std::abs(level.at<float>(y, x) - static_cast<float>(k));
                if (share > 0) out.at<cv::Vec3f>(y, x) += share * read.at<cv::Vec3f>(y, x);
            }
    }
    // A cubic kernel overshoots at edges; without the clamp, pixels at a sun's edge would exceed the sun.
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
    // Reduces the photo's height to the panorama's resolution; resample() reduces its width by mip levels.
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

// Puts the ring on the sphere, its lightColumn in the middle, and fills the poles, each by fromPole rows at
// least. topLatitude: radians.
cv::Mat sphereFrom(const cv::Mat& ring, double topLatitude, double lightColumn, int fromPole) {
    const int width = ring.cols;
    cv::Mat sphere = cv::Mat::zeros(width / 2, width, CV_32FC3);
    const double perRadian = width / (2 * std::numbers::pi);
    const auto above = static_cast<int>(std::lround((std::numbers::pi / 2 - topLatitude) * perRadian));
    const int top = std::clamp(above, fromPole, width / 4 - 1);
    const int bottom = std::min(top + ring.rows, width / 2 - fromPole);
    const cv::Mat known = ring.rowRange(0, bottom - top), to = sphere.rowRange(top, bottom);
    const int by = (static_cast<int>(std::lround(width / 2 - lightColumn)) + width) % width; // to the right
    if (by > 0) known.colRange(width - by, width).copyTo(to.colRange(0, by)); // OpenCV refuses empty columns
    known.colRange(0, width - by).copyTo(to.colRange(by, width));
    fillPoles(sphere, top, bottom);
    return sphere;
}

// photo: 3 coded floats, bounded; the panorama is coded alike.
Panorama<cv::Mat> panoramaFromCoded(const cv::Mat& photo, double fov, int width, bool full,
                                    const Progress& progress) {
    const MainLight light = findMainLight(photo);
    const Lens lens = Lens::make(photo.cols, photo.rows, fov);
    const cv::Mat patch = patchOf(photo, lens);
    const double lightLon = lens.longitudeOf(light.place.x);
    const double lightLat = lens.latitudeOf(lightLon, light.place.y);
    const MainLight inPatch{
        {(lightLon / lens.longitude + 1) / 2 * patch.cols, (1 - lightLat / lens.latitude) / 2 * patch.rows},
        light.radius_px / photo.cols * patch.cols};
    const RingMap map = makeRingMap(patch, lens, inPatch, full, within(progress, 0, 0.7));
    progress(0.75);
    cv::Mat ring = ringOf(photo, map, lens, patch.size(), width);
    progress(0.85);
    blendWrapAround(ring);
    progress(0.9);
    const double lightColumn = ringColumn(map.column, inPatch.place.x) / kMapWidth * width;
    const cv::Mat sphere = sphereFrom(ring, map.top, lightColumn, full ? 0 : 1);
    progress(1);
    return {sphere, {light.place.x, light.place.y}, lightLat / kRadiansPerDegree};
}

// --- Completing a part

// Fills the gap between a picture's two ends: columns right to left + width (exclusive), wrapping around.
void fillGap(cv::Mat& rows, int left, int right) {
    const int gap = left + rows.cols - right;
    // The mirror images end before the main light, so that the panorama shows it once.
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
    // fillPoles() needs rows on both sides of the horizon: repeats the edge row of a part on one side.
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
    const double usual =
        std::tan(kDefaultFov_deg / 2 * kRadiansPerDegree) * photo.width / std::max(photo.width, photo.height);
    const double fov = options.fov_deg ? *options.fov_deg * kRadiansPerDegree : 2 * std::atan(usual);
    const int detailed = static_cast<int>(photo.width * 2 * std::numbers::pi / fov);
    const Panorama<cv::Mat> made = panoramaFromCoded(coded, fov, std::clamp(detailed / 64 * 64, 512, 4096),
                                                     options.full, options.progress);
    return Panorama<Picture>{pictureFromCoded<Picture>(made.latLong),
                             made.lightInPhoto * (photo.width * 1.0 / coded.cols), made.lightLatitude_deg};
}

template <class Picture> Result<Picture> completePanorama(const Picture& photo, const PanoramaPart& part) {
    assert(part.left < part.right && part.top < part.bottom && part.left >= 0 && part.top >= 0 &&
           part.right <= 1 && part.bottom <= 1);
    const double whole = photo.width / (part.right - part.left);
    const int width = static_cast<int>(std::clamp(whole, 512.0, 4096.0)) / 64 * 64;
    if ((part.right - part.left) * width < 2 || (part.bottom - part.top) * width / 2 < 2)
        return Error{"", "covers too small a part of the environment to be shown"};
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
