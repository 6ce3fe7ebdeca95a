#include "content/make/depth/CubeFlow.h"

#include "content/make/depth/GreyFilm.h"
#include "engine/math/LatLong.h"

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include <cmath>

namespace shoal::depth {

namespace {

struct Axes {
    glm::vec3 ahead, right, down;
};
constexpr std::array<Axes, 6> kFaces = {{{{0, 0, -1}, {1, 0, 0}, {0, -1, 0}},
                                         {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                         {{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}},
                                         {{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                         {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                         {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}}}};

constexpr float kPixelsPerTan = kFaceSize / (2 * kFaceTan);
// Minimum standard deviation of grey values within a window: below it there is only the noise of coded film.
constexpr float kMinContrast = 1.5f;
constexpr int kContrastWindow = 11; // pixels

glm::vec3 directionOf(const Axes& face, float x, float y) {
    return glm::normalize(face.ahead + face.right * (x / kPixelsPerTan - kFaceTan) +
                          face.down * (y / kPixelsPerTan - kFaceTan));
}

size_t faceOf(const glm::vec3& dir) {
    size_t best = 0;
    for (size_t f = 1; f < kFaces.size(); ++f)
        if (glm::dot(dir, kFaces[f].ahead) > glm::dot(dir, kFaces[best].ahead)) best = f;
    return best;
}

// Returns pixel coordinates; a pixel's centre lies at half integers.
cv::Point2f pixelOf(const Axes& face, const glm::vec3& dir) {
    const float ahead = glm::dot(dir, face.ahead);
    return {(glm::dot(dir, face.right) / ahead + kFaceTan) * kPixelsPerTan,
            (glm::dot(dir, face.down) / ahead + kFaceTan) * kPixelsPerTan};
}

// Samples the flow bilinearly. Returns false outside of the face.
bool sample(const cv::Mat2f& flow, const cv::Point2f& at, cv::Point2f& out) {
    const float x = at.x - 0.5f, y = at.y - 0.5f;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    if (x0 < 0 || y0 < 0 || x0 + 1 >= flow.cols || y0 + 1 >= flow.rows) return false;
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const cv::Vec2f v = (flow(y0, x0) * (1 - fx) + flow(y0, x0 + 1) * fx) * (1 - fy) +
                        (flow(y0 + 1, x0) * (1 - fx) + flow(y0 + 1, x0 + 1) * fx) * fy;
    out = {v[0], v[1]};
    return true;
}

cv::Mat1b asMat(const std::vector<uint8_t>& grey) {
    return cv::Mat1b(kFaceSize, kFaceSize, const_cast<uint8_t*>(grey.data()));
}

void contrastOf(const cv::Mat1b& grey, cv::Mat1f& out) {
    cv::Mat1f values, mean, square;
    grey.convertTo(values, CV_32F);
    const cv::Size window(kContrastWindow, kContrastWindow);
    cv::boxFilter(values, mean, CV_32F, window);
    cv::boxFilter(values.mul(values), square, CV_32F, window);
    cv::sqrt(cv::max(square - mean.mul(mean), 0), out);
}

} // namespace

struct CubeFlow::Impl {
    cv::Ptr<cv::DISOpticalFlow> flow = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM);
    std::array<cv::Mat2f, 6> maps; // pixel of the padded film for each pixel of a face
    cv::Mat1b padded;
    cv::Mat2f forward, backward;
    cv::Mat1f contrast[2];
};

CubeFlow::CubeFlow() : impl_(makeHidden<Impl>()) {}

void CubeFlow::makeFaces(const light::FrameView& film, CubeFaces& out) {
    constexpr int kPadding = 4, kWidth = 1024;
    Impl& own = *impl_;
    greyOf(film, kWidth, kPadding, own.padded);
    for (size_t f = 0; f < kFaces.size(); ++f) {
        if (own.maps[f].empty()) {
            own.maps[f].create(kFaceSize, kFaceSize);
            for (int y = 0; y < kFaceSize; ++y)
                for (int x = 0; x < kFaceSize; ++x) {
                    const glm::vec2 uv = latLongFromDirection(
                        directionOf(kFaces[f], static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
                    own.maps[f](y, x) = {uv.x * kWidth - 0.5f + kPadding, uv.y * (kWidth / 2) - 0.5f};
                }
        }
        out.grey[f].resize(size_t{kFaceSize} * kFaceSize);
        cv::Mat1b face = asMat(out.grey[f]);
        cv::remap(own.padded, face, own.maps[f], cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    }
}

void CubeFlow::match(const CubeFaces& first, const CubeFaces& second, int width,
                     std::vector<FlowPoint>& there, std::vector<FlowPoint>& back) {
    Impl& own = *impl_;
    const int height = width / 2;
    there.assign(static_cast<size_t>(width) * height, {});
    back.assign(there.size(), {});
    for (size_t f = 0; f < kFaces.size(); ++f) {
        const cv::Mat1b a = asMat(first.grey[f]), b = asMat(second.grey[f]);
        own.forward.release(), own.backward.release(); // else the flow would start from their values
        own.flow->calc(a, b, own.forward);
        own.flow->calc(b, a, own.backward);
        contrastOf(a, own.contrast[0]), contrastOf(b, own.contrast[1]);
        const auto follow = [&](const cv::Mat2f& flow, const cv::Mat2f& counter, const cv::Mat1f& contrast,
                                std::vector<FlowPoint>& out) {
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    const glm::vec3 dir = texelDirection(x, y, width, height);
                    if (faceOf(dir) != f) continue;
                    const cv::Point2f at = pixelOf(kFaces[f], dir);
                    cv::Point2f by, returned;
                    if (!sample(flow, at, by) || !sample(counter, at + by, returned)) continue;
                    FlowPoint& point = out[static_cast<size_t>(y) * width + x];
                    point.second = directionOf(kFaces[f], at.x + by.x, at.y + by.y);
                    if (contrast(static_cast<int>(at.y), static_cast<int>(at.x)) < kMinContrast) continue;
                    point.error_rad = static_cast<float>(cv::norm(by + returned)) / kPixelsPerTan;
                }
        };
        follow(own.forward, own.backward, own.contrast[0], there);
        follow(own.backward, own.forward, own.contrast[1], back);
    }
}

} // namespace shoal::depth
