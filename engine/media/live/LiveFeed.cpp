#include "engine/media/live/LiveFeed.h"

#include "engine/core/Number.h"
#include "engine/media/Codecs.h"
#include "engine/media/VideoFrame.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <string_view>
#include <utility>

namespace shoal::media {

namespace {

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
            reader_ =
                (*with)->openCamera(index_, {.width = 3840, .height = 1920, .jpeg = true, .waiting = 2});
            if (!reader_) return Error{"", "cannot be opened, or is in use elsewhere"};
        } catch (const std::exception&) {
            return Error{"", "cannot be opened"};
        }
        return Done{};
    }

    Result<int64_t> read(ImageRgb8& bgr, VideoFrame& frame) override {
        if (interrupted_) return Error{"", "was interrupted"};
        const Error silent{"", "sends no pictures any more"};
        try {
            if (!reader_(nullptr)) return silent;
            frame.arrived_s = liveNow_s();
            cv::Mat read(bgr.height, bgr.width, CV_8UC3, bgr.pixels.data());
            if (!reader_(&read) || read.type() != CV_8UC3) return silent;
            if (std::min(read.cols, read.rows) < 2 || std::max(read.cols, read.rows) > kMaxVideoSide)
                return Error{"", "gives a picture of a size that is not played"};
            if (read.data != bgr.pixels.data()) { // it has another size
                bgr = ImageRgb8(read.cols, read.rows);
                read.copyTo(cv::Mat(bgr.height, bgr.width, CV_8UC3, bgr.pixels.data()));
            }
            frame.decode_ms = 1e3 * (liveNow_s() - frame.arrived_s);
            return 0; // the driver does not tell which pictures it dropped
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

// Schemes of URLs that are played, with LiveAddress::protocols; all others are refused. RTSP has to send
// pictures over its own connection: by UDP its server could make us send to other hosts.
constexpr std::pair<const char*, const char*> kStreams[] = {
    {"rtsp", "tcp"}, {"http", "http,tcp"}, {"https", "https,tls,tcp"}, {"tcp", "tcp"}, {"udp", "udp"}};

// Returns the text before "://", if that can be a scheme.
static std::string_view schemeOf(std::string_view text) {
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-.";
    const size_t end = text.find_first_not_of(kLetters);
    return end != text.npos && text.substr(end).starts_with("://") ? text.substr(0, end) : std::string_view();
}

Result<std::optional<LiveAddress>> liveAddress(const std::string& text) {
    if (text.starts_with("camera:")) {
        const auto number = parseNumber(text.substr(7), 0, 99);
        if (!number) return Error{text, "wants the number of a camera, such as camera:0"};
        return std::optional<LiveAddress>(LiveAddress{.camera = *number});
    }
    if (const std::string_view scheme = schemeOf(text); !scheme.empty()) {
        constexpr size_t kMaxLength = 2048;
        if (text.size() > kMaxLength) return Error{withoutPassword(text.substr(0, 80)), "is too long a URL"};
        std::string known;
        for (const auto& [name, protocols] : kStreams) {
            if (scheme == name) return std::optional<LiveAddress>(LiveAddress{-1, text, protocols});
            known += (known.empty() ? "" : ", ") + std::string(name);
        }
        return Error{withoutPassword(text), "is a URL of a kind that is not played; these are: " + known};
    }
    std::error_code code;
    if (!std::filesystem::is_fifo(text, code)) return std::optional<LiveAddress>();
    return std::optional<LiveAddress>(LiveAddress{-1, text, "pipe", true});
}

std::string withoutPassword(const std::string& url) {
    const size_t from = url.find("://");
    if (from == std::string::npos) return url;
    const size_t host = from + 3, at = url.substr(0, url.find_first_of("/?#", host)).rfind('@');
    return at == std::string::npos || at < host ? url : url.substr(0, host) + url.substr(at + 1);
}

std::shared_ptr<LiveFeed> feedFrom(const LiveAddress& address, const FeedTimeouts& timeouts) {
    if (address.camera >= 0) return std::make_shared<Camera>(address.camera);
    return streamFeed(address, timeouts);
}

std::map<int, std::string> listCameras() {
    std::map<int, std::string> cameras;
    std::error_code code;
    for (const auto& entry : std::filesystem::directory_iterator("/sys/class/video4linux", code)) {
        const std::string node = entry.path().filename().string();
        const auto number = parseNumber(node.substr(std::min<size_t>(5, node.size())), 0, 999);
        if (!node.starts_with("video") || !number) continue;
        // A camera's further nodes deliver metadata.
        int which = 0;
        if (std::ifstream(entry.path() / "index") >> which && which != 0) continue;
        std::getline(std::ifstream(entry.path() / "name"), cameras[*number]);
    }
    return cameras;
}

} // namespace shoal::media
