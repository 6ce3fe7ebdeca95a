#include "input/hands/HandTracker.h"

#include "engine/core/Log.h"
#include "engine/core/ThreadPool.h"
#include "engine/media/Codecs.h"
#include "engine/media/VideoSource.h"
#include "input/hands/webcam/HandDetector.h"
#ifdef SHOAL_HAND_LANDMARKS
#include "input/hands/webcam/landmarks/LandmarkFinder.h"
#endif

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace shoal::hands {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kRetry{1};

#ifndef SHOAL_HAND_LANDMARKS
Result<std::unique_ptr<HandFinder>> makeLandmarkFinder(const Path&, const HandRig&) {
    return Error{"", "this build lacks XNNPACK; install libxnnpack-dev, libpthreadpool-dev, "
                     "libflatbuffers-dev and flatbuffers-compiler, and build it anew"};
}
#endif

// By landmarks where that is possible; else by colour, and why and what to do is said.
std::unique_ptr<HandFinder> makeFinder(const Path& models, const HandRig& rig) {
    auto finder = makeLandmarkFinder(models, rig);
    if (finder) return std::move(*finder);
    log::info("Webcam: hands are found by their colour alone: {}", finder.error().message());
    return std::make_unique<HandDetector>(rig);
}

class WebcamTracker final : public HandTracker {
  public:
    WebcamTracker(const WebcamOptions& options, const HandRig& rig)
        : HandTracker("Webcam", options.live ? 64 : 8,
                      !options.live && !options.file.empty() ? HandStream::Full::Wait
                                                             : HandStream::Full::Drop),
          options_(options), rig_(rig) {
        stream().setState({false, place() + " is being opened", {}});
        thread_ = std::jthread([this](const std::stop_token& ending) { run(ending); });
    }
    ~WebcamTracker() override {
        thread_.request_stop();
        stream().close();
    }

  private:
    // False: the tracker is being destroyed.
    static bool waitUntil(const std::stop_token& ending, Clock::time_point when) {
        std::mutex mutex;
        std::unique_lock lock(mutex);
        std::condition_variable_any().wait_until(lock, ending, when, [] { return false; });
        return !ending.stop_requested();
    }

    std::string place() const {
        return options_.file.empty() ? "camera " + std::to_string(options_.index) : options_.file;
    }
    void detect(HandFinder& finder, const cv::Mat& picture, double time_s) {
        HandFrame frame = finder.detect(picture, time_s);
        placement_.apply(frame.hands, frame.time_us);
        stream().push(frame);
        const Instruction instruction = finder.instruction();
        stream().setState(
            {true, instruction == Instruction::None ? place() : place() + ", learning your hand's colour",
             instruction});
    }

    // Returns why it ended.
    std::string watchClip(const std::stop_token& ending) {
        auto source = media::VideoSource::open(options_.file, media::Layout::Mono);
        if (!source) return source.error().message();
        const auto finder = makeFinder(options_.models, rig_);
        const Clock::time_point began = Clock::now();
        ImageRgb8 picture(source->info().width, source->info().height);
        for (int64_t number = 0; !ending.stop_requested() && source->grab() && source->retrieve(picture);
             ++number) {
            const std::chrono::duration<double> time(static_cast<double>(number) / source->info().fps);
            if (options_.live &&
                !waitUntil(ending, began + std::chrono::duration_cast<Clock::duration>(time)))
                break;
            detect(*finder, cv::Mat(picture.height, picture.width, CV_8UC3, picture.pixels.data()),
                   time.count());
        }
        return options_.file + " is over";
    }

    std::string watchCamera(const std::stop_token& ending) {
        const auto with = media::codecs();
        if (!with) return with.error().message();
        try {
            const auto camera = (*with)->openCamera(options_.index, {.width = 640, .height = 480});
            if (!camera) return place() + " is not there, or lets nobody in";
            const auto finder = makeFinder(options_.models, rig_);
            const Clock::time_point began = Clock::now();
            cv::Mat picture;
            while (!ending.stop_requested() && camera(nullptr) && camera(&picture))
                detect(*finder, picture, std::chrono::duration<double>(Clock::now() - began).count());
        } catch (const cv::Exception&) { // of a driver: as good as unplugged
        }
        return place() + " gives no pictures";
    }

    void run(const std::stop_token& ending) {
        lowerThreadPriority();
        if (!options_.file.empty()) {
            stream().setState({false, watchClip(ending), {}});
        } else {
            do stream().setState({false, watchCamera(ending), {}});
            while (waitUntil(ending, Clock::now() + kRetry));
        }
        stream().close();
    }

    WebcamOptions options_;
    HandRig rig_;
    HandPlacement placement_{kCameraMount};
    std::jthread thread_; // last: it uses all of the above
};

} // namespace

std::unique_ptr<HandTracker> makeWebcamTracker(const WebcamOptions& options, const HandRig& rig) {
    return std::make_unique<WebcamTracker>(options, rig);
}

} // namespace shoal::hands
