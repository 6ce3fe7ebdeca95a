#include "input/hands/webcam/WebcamHands.h"

#include "engine/core/Threads.h"
#include "input/hands/webcam/WebcamEye.h"

#include <opencv2/videoio.hpp>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace shoal::hands {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kRetry{1};
constexpr int kMostPixels = 8192 * 8192;

} // namespace

struct WebcamHands::State {
    WebcamOptions options;
    HandRig rig;
    HandStream stream;
    std::mutex mutex;
    std::condition_variable left;
    bool leaving = false;
    std::thread thread; // last: it uses all of the above

    State(const WebcamOptions& o, const HandRig& r)
        : options(o), rig(r), stream(o.live ? 64 : 8, !o.live && !o.file.empty() ? HandStream::Full::Wait
                                                                                 : HandStream::Full::Drop) {}
    ~State() {
        {
            const std::lock_guard lock(mutex);
            leaving = true;
        }
        left.notify_all();
        stream.close();
        if (thread.joinable()) thread.join();
    }

    // False: it is time to go.
    bool restUntil(Clock::time_point when) {
        std::unique_lock lock(mutex);
        return !left.wait_until(lock, when, [&] { return leaving; });
    }
    bool gone() {
        const std::lock_guard lock(mutex);
        return leaving;
    }

    std::string place() const {
        return options.file.empty() ? "camera " + std::to_string(options.index) : options.file;
    }
    bool open(cv::VideoCapture& capture) const {
        if (!options.file.empty()) return capture.open(options.file);
        if (!capture.open(options.index)) return false;
        capture.set(cv::CAP_PROP_FRAME_WIDTH, 640);
        capture.set(cv::CAP_PROP_FRAME_HEIGHT, 480);
        return true;
    }

    void watch(cv::VideoCapture& capture) {
        WebcamEye eye(rig);
        const double stated_Hz = capture.get(cv::CAP_PROP_FPS);
        const double rate_Hz = stated_Hz >= 1 && stated_Hz <= 240 ? stated_Hz : 30;
        const Clock::time_point began = Clock::now();
        cv::Mat picture;
        for (int64_t number = 0; !gone(); ++number) {
            if (!capture.read(picture) || picture.empty() || picture.total() > kMostPixels) return;
            double time_s = std::chrono::duration<double>(Clock::now() - began).count();
            if (!options.file.empty()) {
                time_s = static_cast<double>(number) / rate_Hz;
                const auto due = began + std::chrono::duration_cast<Clock::duration>(
                                             std::chrono::duration<double>(time_s));
                if (options.live && !restUntil(due)) return;
            }
            const HandFrame frame = eye.look(picture, time_s);
            stream.push(frame);
            stream.setState(
                {true, eye.calibrated() ? place() : place() + ", learning your hand's colour", eye.asks()});
        }
    }

    void run() {
        stepBack();
        for (;;) {
            try {
                cv::VideoCapture capture;
                if (open(capture)) watch(capture);
            } catch (const cv::Exception&) {
                // As good as not there.
            }
            stream.setState(
                {false, options.file.empty() ? place() + " gives no pictures" : place() + " is over", {}});
            if (!options.file.empty()) break;
            if (!restUntil(Clock::now() + kRetry)) break;
        }
        stream.close();
    }
};

WebcamHands::WebcamHands(const WebcamOptions& options, const HandRig& rig)
    : state_(std::make_unique<State>(options, rig)) {
    state_->stream.setState({false, state_->place() + " is being opened", {}});
    state_->thread = std::thread([s = state_.get()] { s->run(); });
}

WebcamHands::WebcamHands(WebcamHands&&) noexcept = default;
WebcamHands& WebcamHands::operator=(WebcamHands&&) noexcept = default;
WebcamHands::~WebcamHands() = default;

HandStream& WebcamHands::stream() { return state_->stream; }

} // namespace shoal::hands
