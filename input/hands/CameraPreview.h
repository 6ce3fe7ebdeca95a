// A small copy of a camera's picture for the player. The tracker's thread writes it, the program's reads it;
// it never leaves the process.
#pragma once

#include "engine/core/Image.h"

#include <atomic>
#include <mutex>

namespace shoal::hands {

class CameraPreview {
  public:
    static constexpr int kWidth = 240; // pixels

    // Returns whether look() was called since the last show(): a picture is needed. Tracker's thread.
    bool isWatched() const { return watched_; }
    void show(const ImageRgba8& picture) {
        const std::lock_guard lock(mutex_);
        picture_ = picture;
        isNew_ = true;
        watched_ = false;
    }

    // Copies a new picture to out; returns false if there is none. For the program's thread, once a frame
    // while the picture is on the screen.
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
    ImageRgba8 picture_; // guarded by mutex_, as is isNew_
    bool isNew_ = false;
};

} // namespace shoal::hands
