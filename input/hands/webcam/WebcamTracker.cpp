#include "input/hands/HandTracker.h"

#include "engine/core/ThreadPool.h"
#include "engine/media/Codecs.h"
#include "engine/media/VideoSource.h"
#include "input/hands/webcam/landmarks/LandmarkFinder.h"

#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace shoal::hands {

namespace {

constexpr std::chrono::seconds kRetry{1};

class WebcamTracker final : public HandTracker {
  public:
    WebcamTracker(const WebcamOptions& options, const HandRig& rig)
        : HandTracker("Webcam", options.live ? 64 : 8, !options.live && !options.file.empty()),
          options_(options), rig_(rig), handSize_(options.handSize) {
        stream().setState({false, place() + " is being opened"});
        thread_ = std::jthread([this](const std::stop_token& ending) { run(ending); });
    }
    ~WebcamTracker() override {
        thread_.request_stop();
        stream().close();
    }
    CameraPreview* preview() override { return &preview_; }
    void setHandSize(float size) override { handSize_ = size; }

  private:
    // Waits until a point in time. Returns false if the tracker is being destroyed.
    static bool waitUntil(const std::stop_token& ending, Clock::time_point when) {
        std::mutex mutex;
        std::unique_lock lock(mutex);
        std::condition_variable_any().wait_until(lock, ending, when, [] { return false; });
        return !ending.stop_requested();
    }

    std::string place() const {
        return options_.file.empty() ? "camera " + std::to_string(options_.index) : options_.file;
    }
    // takenAt: time of the picture; time_s: time since the first one.
    void detect(LandmarkFinder& finder, const cv::Mat& picture, Clock::time_point takenAt, double time_s) {
        HandFrame frame = finder.detect(picture, time_s);
        frame.seenAt = takenAt;
        const float size =
            std::clamp(handSize_.load(), static_cast<float>(kHandSizeMin), static_cast<float>(kHandSizeMax));
        for (size_t side = 0; side < 2; ++side) {
            if (!frame.hands[side].tracked) continue;
            frame.rigDistance_m[side] = glm::length(frame.hands[side].joints[kPalmJoint].position);
            resize(frame.hands[side], size);
        }
        placement_.apply(frame.hands, frame.time_us);
        stream().push(frame);
        if (preview_.isWatched()) showPreview(picture, finder.marks());
        stream().setState({true, place()});
    }

    // Shows the picture as in a mirror.
    void showPreview(const cv::Mat& bgr, std::span<const cv::Point2f> marks) {
        if (bgr.empty() || bgr.type() != CV_8UC3) return;
        const float scale = static_cast<float>(CameraPreview::kWidth) / static_cast<float>(bgr.cols);
        const int height = std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(bgr.rows))));
        shown_.fit(CameraPreview::kWidth, height);
        cv::Mat rgba(height, CameraPreview::kWidth, CV_8UC4, shown_.pixels.data());
        cv::resize(bgr, small_, rgba.size(), 0, 0, cv::INTER_AREA);
        cv::flip(small_, small_, 1);
        cv::cvtColor(small_, rgba, cv::COLOR_BGR2RGBA);
        for (const cv::Point2f& mark : marks) {
            const cv::Point at(CameraPreview::kWidth - 1 - static_cast<int>(scale * mark.x),
                               static_cast<int>(scale * mark.y));
            cv::circle(rgba, at, 3, cv::Scalar(0, 0, 0, 255), cv::FILLED);
            cv::circle(rgba, at, 2, cv::Scalar(255, 200, 60, 255), cv::FILLED);
        }
        preview_.show(shown_);
    }

    // watchClip() and watchCamera() return the state that tells why they ended.
    DeviceState watchClip(const std::stop_token& ending) {
        auto source = media::VideoSource::open(options_.file, media::Layout::Mono);
        if (!source) return {false, source.error().message()};
        auto finder = LandmarkFinder::load(options_.models, rig_);
        if (!finder) return {false, finder.error().message(), true};
        const Clock::time_point began = Clock::now();
        ImageRgb8 picture(source->info().width, source->info().height);
        for (int64_t number = 0; !ending.stop_requested() && source->grab() && source->retrieve(picture);
             ++number) {
            const std::chrono::duration<double> time(static_cast<double>(number) / source->info().fps);
            const Clock::time_point due = began + std::chrono::duration_cast<Clock::duration>(time);
            if (options_.live && !waitUntil(ending, due)) break;
            detect(*finder, cv::Mat(picture.height, picture.width, CV_8UC3, picture.pixels.data()), due,
                   time.count());
        }
        return {false, options_.file + " is over"};
    }

    // Opens no camera without the models.
    DeviceState watchCamera(const std::stop_token& ending) {
        auto finder = LandmarkFinder::load(options_.models, rig_);
        if (!finder) return {false, finder.error().message(), true};
        const auto with = media::codecs();
        if (!with) return {false, with.error().message()};
        try {
            const auto camera = (*with)->openCamera(options_.index, {.width = 640, .height = 480});
            if (!camera) return {false, place() + " is not there, or lets nobody in"};
            const Clock::time_point began = Clock::now();
            cv::Mat picture;
            while (!ending.stop_requested() && camera(nullptr)) {
                const Clock::time_point takenAt = Clock::now();
                if (!camera(&picture)) break;
                detect(*finder, picture, takenAt, std::chrono::duration<double>(takenAt - began).count());
            }
        } catch (const cv::Exception&) { // a driver's error: the camera counts as unplugged
        }
        return {false, place() + " gives no pictures"};
    }

    void run(const std::stop_token& ending) {
        lowerThreadPriority();
        const bool isClip = !options_.file.empty();
        do stream().setState(isClip ? watchClip(ending) : watchCamera(ending));
        while (!isClip && waitUntil(ending, Clock::now() + kRetry));
        stream().close();
    }

    WebcamOptions options_;
    HandRig rig_;
    std::atomic<float> handSize_; // set by the program's thread
    HandPlacement placement_{kCameraMount};
    CameraPreview preview_;
    cv::Mat small_;       // scratch memory of showPreview()
    ImageRgba8 shown_;    // likewise
    std::jthread thread_; // last: it uses all of the above
};

} // namespace

std::unique_ptr<HandTracker> makeWebcamTracker(const WebcamOptions& options, const HandRig& rig) {
    return std::make_unique<WebcamTracker>(options, rig);
}

} // namespace shoal::hands
