#include "engine/media/Codecs.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include <memory>

namespace shoal::media {

static CameraReader openCamera(int index, const CameraRequest& request) {
    const auto camera = std::make_shared<cv::VideoCapture>(index, cv::CAP_V4L2);
    if (!camera->isOpened()) return {};
    // A camera refuses properties that it does not know.
    if (request.jpeg) camera->set(cv::CAP_PROP_FOURCC, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'));
    camera->set(cv::CAP_PROP_FRAME_WIDTH, request.width);
    camera->set(cv::CAP_PROP_FRAME_HEIGHT, request.height);
    if (request.waiting > 0) camera->set(cv::CAP_PROP_BUFFERSIZE, request.waiting);
    return [camera](cv::Mat* bgr) { return bgr ? camera->retrieve(*bgr) : camera->grab(); };
}

extern "C" {
[[gnu::visibility("default")]] extern const Codecs shoalCodecs;
const Codecs shoalCodecs = {cv::imdecode, openCamera};
}

} // namespace shoal::media
