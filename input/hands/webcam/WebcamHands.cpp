#include "input/hands/webcam/WebcamHands.h"

#include "engine/core/Threads.h"
#include "engine/media/Codecs.h"
#include "engine/media/VideoSource.h"
#include "input/hands/webcam/WebcamEye.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace shoal::hands {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kRetry{1};

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
    void see(WebcamEye& eye, const cv::Mat& picture, double time_s) {
        stream.push(eye.look(picture, time_s));
        stream.setState(
            {true, eye.calibrated() ? place() : place() + ", learning your hand's colour", eye.asks()});
    }

    // Says how it ended.
    std::string watchClip() {
        auto source = media::VideoSource::open(options.file);
        if (!source) return source.error().sentence();
        WebcamEye eye(rig);
        const Clock::time_point began = Clock::now();
        ImageRgb8 picture(source->info().width, source->info().height);
        for (int64_t number = 0; !gone() && source->grab() && source->retrieve(picture); ++number) {
            const std::chrono::duration<double> time(static_cast<double>(number) / source->info().fps);
            if (options.live && !restUntil(began + std::chrono::duration_cast<Clock::duration>(time))) break;
            see(eye, cv::Mat(picture.height, picture.width, CV_8UC3, picture.pixels.data()), time.count());
        }
        return options.file + " is over";
    }

    std::string watchCamera() {
        const auto with = media::codecs();
        if (!with) return with.error().sentence();
        try {
            const auto camera = (*with)->openCamera(options.index, {.width = 640, .height = 480});
            if (!camera) return place() + " is not there, or lets nobody in";
            WebcamEye eye(rig);
            const Clock::time_point began = Clock::now();
            cv::Mat picture;
            while (!gone() && camera->grab() && camera->retrieve(picture))
                see(eye, picture, std::chrono::duration<double>(Clock::now() - began).count());
        } catch (const cv::Exception&) { // of a driver: as good as unplugged
        }
        return place() + " gives no pictures";
    }

    void run() {
        stepBack();
        if (!options.file.empty()) {
            stream.setState({false, watchClip(), {}});
        } else {
            do stream.setState({false, watchCamera(), {}});
            while (restUntil(Clock::now() + kRetry));
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
