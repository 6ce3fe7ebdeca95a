#include "engine/core/Number.h"
#include "engine/media/Codecs.h"
#include "engine/media/VideoFrame.h"
#include "engine/media/live/LiveFeed.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <utility>

namespace shoal::media {

namespace {

// The camera gives the nearest size that it has.
constexpr int kRequestedWidth = 3840, kRequestedHeight = 1920;

class Camera final : public LiveFeed {
  public:
    explicit Camera(int index) : LiveFeed("camera:" + std::to_string(index), "camera"), index_(index) {}

    Status open() override {
        std::error_code code;
        if (!std::filesystem::exists("/dev/video" + std::to_string(index_), code))
            return Error{"", "is not there; `shoal devices` lists the cameras that are"};
        const auto with = codecs();
        if (!with) return Error{"", "cannot be opened: " + with.error().message()};
        try {
            reader_ = nullptr;
            // The queue is short, because pictures grow old in it.
            reader_ = (*with)->openCamera(
                index_, {.width = kRequestedWidth, .height = kRequestedHeight, .jpeg = true, .waiting = 2});
            if (!reader_) return Error{"", "cannot be opened, or is in use elsewhere"};
        } catch (const std::exception&) {
            return Error{"", "cannot be opened"};
        }
        return Done{};
    }

    Result<LivePicture> read(ImageRgb8& bgr) override {
        if (interrupted_) return Error{"", "was interrupted"};
        const Error silent{"", "sends no pictures any more"};
        try {
            if (!reader_(nullptr)) return silent;
            LivePicture picture;
            picture.arrived_s = liveNow_s();
            cv::Mat read(bgr.height, bgr.width, CV_8UC3, bgr.pixels.data());
            if (!reader_(&read) || read.type() != CV_8UC3) return silent;
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

    void interrupt() override { interrupted_ = true; }

  private:
    int index_;
    CameraReader reader_; // once open
    std::atomic<bool> interrupted_{false};
};

} // namespace

std::shared_ptr<LiveFeed> cameraFeed(const CameraAddress& address) {
    return std::make_shared<Camera>(address.index);
}

std::vector<CameraListed> listCameras() {
    std::vector<CameraListed> cameras;
    std::error_code code;
    for (const auto& entry : std::filesystem::directory_iterator("/sys/class/video4linux", code)) {
        const std::string node = entry.path().filename().string();
        const auto number = parseNumber(node.substr(std::min<size_t>(5, node.size())), 0, 999);
        if (!node.starts_with("video") || !number) continue;
        // A camera's further nodes deliver metadata.
        int which = 0;
        if (std::ifstream(entry.path() / "index") >> which && which != 0) continue;
        CameraListed camera{*number, {}};
        std::getline(std::ifstream(entry.path() / "name"), camera.name);
        cameras.push_back(std::move(camera));
    }
    std::sort(cameras.begin(), cameras.end(), [](const auto& a, const auto& b) { return a.index < b.index; });
    return cameras;
}

} // namespace shoal::media
