// How OpenCV and FFmpeg are set up: for this room and the webcam's.
#pragma once

#include <mutex>
#include <streambuf>

namespace shoal::media {

// Called before the first use of FFmpeg, and of OpenCV's codecs (Codecs.h). No chatter of theirs on standard
// error (the player reads our sentences instead); a bound on what FFmpeg takes in one piece; the EXR codec
// on. The first call should come before other threads read the environment.
void setUpDecoders();

// Stops std::cerr for its lifetime: OpenCV 4.6 reports what imread, imdecode and imwrite throw there,
// whatever the log level. Our own messages take another way (engine/core/Log.h). One at a time.
class QuietCerr {
  public:
    QuietCerr();
    ~QuietCerr();
    QuietCerr(const QuietCerr&) = delete;
    QuietCerr& operator=(const QuietCerr&) = delete;

  private:
    std::unique_lock<std::mutex> turn_;
    std::streambuf* before_;
};

} // namespace shoal::media
