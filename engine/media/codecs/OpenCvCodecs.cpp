#include "engine/media/Codecs.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

namespace shoal::media {

namespace {

class Camera : public OpenCamera {
  public:
    bool open(int index, const CameraRequest& request) {
        if (!capture_.open(index, cv::CAP_V4L2)) return false;
        // What a camera does not know it refuses.
        if (request.jpeg) capture_.set(cv::CAP_PROP_FOURCC, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'));
        capture_.set(cv::CAP_PROP_FRAME_WIDTH, request.width);
        capture_.set(cv::CAP_PROP_FRAME_HEIGHT, request.height);
        if (request.waiting > 0) capture_.set(cv::CAP_PROP_BUFFERSIZE, request.waiting);
        return true;
    }
    bool grab() override { return capture_.grab(); }
    cv::Size size() const override {
        return {static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_WIDTH)),
                static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_HEIGHT))};
    }
    bool retrieve(cv::Mat& bgr) override { return capture_.retrieve(bgr); }

  private:
    cv::VideoCapture capture_;
};

} // namespace

extern "C" {
[[gnu::visibility("default")]] extern const Codecs shoalCodecs;
const Codecs shoalCodecs = {
    .imdecode = [](const std::vector<uint8_t>& bytes, int flags) { return cv::imdecode(bytes, flags); },
    .imread = [](const std::string& file, int flags) { return cv::imread(file, flags); },
    .imencode = [](const std::string& kind, const cv::Mat& bgr,
                   std::vector<uint8_t>& bytes) { return cv::imencode(kind, bgr, bytes); },
    .imwrite = [](const std::string& file, const cv::Mat& bgr) { return cv::imwrite(file, bgr); },
    .openCamera = [](int index, const CameraRequest& request) -> std::unique_ptr<OpenCamera> {
        auto camera = std::make_unique<Camera>();
        if (!camera->open(index, request)) return nullptr;
        return camera;
    },
};
}

} // namespace shoal::media
