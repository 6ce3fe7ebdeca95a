// What a tracker's camera sees, small, so that a person can look at it. It is written by the tracker's thread
// and read by the program's, and leaves the process nowhere.
#pragma once

#include "engine/core/Image.h"

#include <atomic>
#include <mutex>

namespace shoal::hands {

class CameraPreview {
  public:
    static constexpr int kWidth = 240; // pixels

    // The tracker's: whether somebody has looked since the last show(); else no picture is needed.
    bool isWatched() const { return watched_; }
    void show(const ImageRgba8& picture) {
        const std::lock_guard lock(mutex_);
        picture_ = picture;
        isNew_ = true;
        watched_ = false;
    }

    // The program's, once a frame while the picture is on the screen. False: nothing new, out stays as it is.
    bool look(ImageRgba8& out) {
        const std::lock_guard lock(mutex_);
        watched_ = true;
        if (!isNew_) return false;
        isNew_ = false;
        out = picture_;
        return true;
    }

  private:
    std::atomic<bool> watched_ = false;
    std::mutex mutex_;
    ImageRgba8 picture_; // guarded, as isNew_
    bool isNew_ = false;
};

} // namespace shoal::hands
