#include "engine/media/Codecs.h"
#include "engine/media/VideoInfo.h"
#include "engine/media/live/LiveFeed.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <utility>

namespace shoal::media {

namespace {

// The camera gives the nearest size it has.
constexpr int kRequestedWidth = 3840, kRequestedHeight = 1920;

class Camera {
  public:
    explicit Camera(int index) : index_(index) {}

    Status open() {
        std::error_code code;
        if (!std::filesystem::exists("/dev/video" + std::to_string(index_), code))
            return Error{"", "is not there; `shoal devices` lists the cameras that are"};
        const auto with = codecs();
        if (!with) return Error{"", "cannot be opened: " + with.error().message()};
        try {
            camera_ = nullptr;
            // A short queue: pictures that wait grow old.
            camera_ = (*with)->openCamera(
                index_, {.width = kRequestedWidth, .height = kRequestedHeight, .jpeg = true, .waiting = 2});
            if (!camera_) return Error{"", "cannot be opened, or is in use elsewhere"};
        } catch (const std::exception&) {
            return Error{"", "cannot be opened"};
        }
        return Done{};
    }

    Result<LivePicture> read(ImageRgb8& bgr) {
        const Error silent{"", "sends no pictures any more"};
        try {
            if (interrupted_ || !camera_(nullptr)) return silent;
            LivePicture picture;
            picture.arrived_s = liveNow_s();
            cv::Mat read(bgr.height, bgr.width, CV_8UC3, bgr.pixels.data());
            if (!camera_(&read) || read.type() != CV_8UC3) return silent;
            if (std::min(read.cols, read.rows) < 2 || std::max(read.cols, read.rows) > kMaxVideoSide)
                return Error{"", "gives a picture of a size that is not played"};
            if (read.data != bgr.pixels.data()) { // it has another size
                bgr = ImageRgb8(read.cols, read.rows);
                read.copyTo(cv::Mat(bgr.height, bgr.width, CV_8UC3, bgr.pixels.data()));
            }
            picture.decode_ms = 1e3 * (liveNow_s() - picture.arrived_s);
            return picture;
        } catch (const std::exception&) {
            return silent;
        }
    }

    void interrupt() { interrupted_ = true; }

  private:
    int index_;
    CameraReader camera_; // once open
    std::atomic<bool> interrupted_{false};
};

} // namespace

LiveFeed cameraFeed(const CameraAddress& address) {
    const auto camera = std::make_shared<Camera>(address.index);
    return {.name = "camera:" + std::to_string(address.index),
            .kind = "camera",
            .open = [camera] { return camera->open(); },
            .read = [camera](ImageRgb8& bgr) { return camera->read(bgr); },
            .interrupt = [camera] { camera->interrupt(); }};
}

std::vector<CameraListed> listCameras() {
    std::vector<CameraListed> cameras;
    std::error_code code;
    for (const auto& entry : std::filesystem::directory_iterator("/sys/class/video4linux", code)) {
        const std::string node = entry.path().filename().string();
        if (!node.starts_with("video") || node.size() < 6 || node.size() > 8 ||
            node.find_first_not_of("0123456789", 5) != std::string::npos)
            continue;
        // A camera's further nodes give metadata.
        int which = 0;
        if (std::ifstream(entry.path() / "index") >> which && which != 0) continue;
        CameraListed camera{std::stoi(node.substr(5)), {}};
        std::getline(std::ifstream(entry.path() / "name"), camera.name);
        cameras.push_back(std::move(camera));
    }
    std::sort(cameras.begin(), cameras.end(), [](const auto& a, const auto& b) { return a.index < b.index; });
    return cameras;
}

} // namespace shoal::media
