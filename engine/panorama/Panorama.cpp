#include "engine/panorama/Panorama.h"

#include "engine/panorama/FindLight.h"
#include "engine/panorama/PerceptualCoding.h"
#include "engine/panorama/PolarCaps.h"
#include "engine/panorama/Resample.h"
#include "engine/panorama/RingMap.h"
#include "engine/panorama/WrapBlend.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace shoal::panorama {

namespace {

constexpr double kDefaultFov_deg = 65;
constexpr double kBand_deg = 45; // from the horizon up and down
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

int widthFor(int photoWidth, double fov, const PanoramaOptions& options) {
    if (options.width > 0) return options.width;
    const int detailed = static_cast<int>(photoWidth * 2 * std::numbers::pi / fov);
    return std::clamp(detailed / 64 * 64, 512, 4096);
}

// Reduced where it has more pixels than any panorama could show.
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

// The photo, reduced and projected to latitude and longitude.
Colours patchOf(const cv::Mat& photo, const Lens& lens) {
    const auto pixels = [](double radians) {
        return std::max(4, static_cast<int>(std::lround(radians / kRadiansPerDegree * kMapPixelsPerDegree)));
    };
    Colours patch(std::min(pixels(2 * lens.longitude), kMapWidth), pixels(2 * lens.latitude));
    cv::Mat small, column(patch.height, patch.width, CV_32F), row(column.size(), CV_32F);
    cv::resize(photo, small, column.size(), 0, 0, cv::INTER_AREA);
    for (int y = 0; y < patch.height; ++y)
        for (int x = 0; x < patch.width; ++x) {
            const double lon = ((x + 0.5) / patch.width * 2 - 1) * lens.longitude;
            const double lat = (1 - (y + 0.5) / patch.height * 2) * lens.latitude;
            column.at<float>(y, x) = static_cast<float>(lens.columnOf(lon) / lens.width * small.cols - 0.5);
            row.at<float>(y, x) = static_cast<float>(lens.rowOf(lon, lat) / lens.height * small.rows - 0.5);
        }
    cv::remap(small, cv::Mat(patch.height, patch.width, CV_32FC3, patch.pixels.data()), column, row,
              cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    return patch;
}

// A map of the ring's columns or rows, scaled to its full size; in the patch, -1 to 1.
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

// For each pixel of the ring at its full size, the photo's column and row.
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
    cv::Mat turned(picture.size(), picture.type());
    picture.colRange(0, w - by).copyTo(turned.colRange(by, w));
    picture.colRange(w - by, w).copyTo(turned.colRange(0, by));
    picture = turned;
}

// The fractional column of the ring that shows this column of the patch.
double ringColumn(const std::vector<float>& map, double patchColumn) {
    const double wanted = patchColumn - 0.5;
    const auto after = std::upper_bound(map.begin() + 1, map.end() - 1, static_cast<float>(wanted));
    const double before = static_cast<double>(*(after - 1));
    const double step = std::max(1e-6, static_cast<double>(*after) - before);
    return static_cast<double>(after - map.begin()) - 0.5 + std::clamp((wanted - before) / step, 0.0, 1.0);
}

// photo: 3 coded floats. Found on a reduced copy; in pixels of the photo.
MainLight mainLightOf(const cv::Mat& photo) {
    cv::Mat small;
    const double reduced = std::min(1.0, 1024.0 / photo.cols);
    cv::resize(photo, small,
               {std::max(8, static_cast<int>(photo.cols * reduced)),
                std::max(8, static_cast<int>(photo.rows * reduced))},
               0, 0, cv::INTER_AREA);
    MainLight light = findMainLight(small);
    light.place = {light.place.x * photo.cols / small.cols, light.place.y * photo.rows / small.rows};
    light.radius_px *= static_cast<double>(photo.cols) / small.cols;
    return light;
}

// The photo resampled to the ring, `width` columns.
cv::Mat ringOf(const cv::Mat& photo, const RingMap& map, const Lens& lens, const cv::Size& patch, int width) {
    const double perRadian = width / (2 * std::numbers::pi);
    const double ringHeight = static_cast<double>(map.row.size()) / kMapPixelsPerDegree * kRadiansPerDegree;
    cv::Mat column(static_cast<int>(std::lround(ringHeight * perRadian)), width, CV_32F),
        row(column.size(), CV_32F);
    photoFromRing(map, lens, patch, column, row);
    // Reduced to the panorama's resolution vertically; horizontally resample() does.
    cv::Mat reduced = photo;
    const int rowsNeeded = static_cast<int>(std::lround(2 * lens.latitude * perRadian));
    if (rowsNeeded < photo.rows)
        cv::resize(photo, reduced, {photo.cols, std::max(rowsNeeded, 4)}, 0, 0, cv::INTER_AREA);
    row *= static_cast<double>(reduced.rows) / photo.rows;
    return resample(widthPyramid(reduced), column, row);
}

// topLatitude: of the ring, radians. lightColumn: of the ring; comes to the middle.
cv::Mat sphereFrom(const cv::Mat& ring, double topLatitude, double lightColumn) {
    const int width = ring.cols;
    cv::Mat sphere = cv::Mat::zeros(width / 2, width, CV_32FC3);
    const double perRadian = width / (2 * std::numbers::pi);
    const int top = std::clamp(
        static_cast<int>(std::lround((std::numbers::pi / 2 - topLatitude) * perRadian)), 1, width / 4 - 1);
    const int bottom = std::min(top + ring.rows, width / 2 - 1);
    ring.rowRange(0, bottom - top).copyTo(sphere.rowRange(top, bottom));
    rotateColumns(sphere, static_cast<int>(std::lround(width / 2 - lightColumn)));
    fillPolarCap(sphere, top, PolarCap::Sky);
    cv::flip(sphere, sphere, 0);
    fillPolarCap(sphere, width / 2 - bottom, PolarCap::Ground);
    cv::flip(sphere, sphere, 0);
    return sphere;
}

// photo: 3 coded floats, bounded; result likewise.
Panorama<cv::Mat> panoramaFromCoded(const cv::Mat& photo, double fov, int width, const Progress& progress) {
    const auto done = [&](double fraction) {
        if (progress) progress(fraction);
    };
    const MainLight light = mainLightOf(photo);
    const Lens lens = Lens::make(photo.cols, photo.rows, fov);
    const Colours patch = patchOf(photo, lens);
    const double lightLon = lens.longitudeOf(light.place.x);
    const double lightLat = lens.latitudeOf(lightLon, light.place.y);
    const LightInPatch inPatch{(lightLon / lens.longitude + 1) / 2 * patch.width,
                               (1 - lightLat / lens.latitude) / 2 * patch.height,
                               light.radius_px / photo.cols * patch.width};
    const RingMap map = makeRingMap(patch, lens, inPatch, kBand_deg * kRadiansPerDegree,
                                    [&](double fraction) { done(0.7 * fraction); });
    done(0.75);
    cv::Mat ring = ringOf(photo, map, lens, {patch.width, patch.height}, width);
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

template <class Picture>
Result<Panorama<Picture>> panoramaFromAny(const Picture& photo, const PanoramaOptions& options) {
    if (Status s = checkPhoto(photo.width, photo.height, options); !s) return s.error();
    const cv::Mat coded = codedFrom(bounded(viewOf(photo)));
    const double fov = fovOf(photo.width, photo.height, options);
    const Panorama<cv::Mat> made =
        panoramaFromCoded(coded, fov, widthFor(photo.width, fov, options), options.progress);
    return Panorama<Picture>{pictureFromCoded<Picture>(made.latLong),
                             made.lightInPhoto * (photo.width * 1.0 / coded.cols), made.lightLatitude_deg,
                             made.wrapStep, made.usualStep};
}

} // namespace

Result<Panorama<ImageRgb8>> panoramaFromPhoto(const ImageRgb8& photo, const PanoramaOptions& options) {
    return panoramaFromAny(photo, options);
}
Result<Panorama<ImageRgbF>> panoramaFromPhoto(const ImageRgbF& radianceLin, const PanoramaOptions& options) {
    return panoramaFromAny(radianceLin, options);
}

} // namespace shoal::panorama
