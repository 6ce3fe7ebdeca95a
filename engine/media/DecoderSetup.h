// Process-wide setup of OpenCV and FFmpeg. For this folder and the webcam's.
#pragma once

#include <mutex>
#include <streambuf>

namespace shoal::media {

// To be called before the first use of FFmpeg and of OpenCV's codecs (Codecs.h). Silences their logs on
// standard error, bounds FFmpeg's allocations, enables the EXR codec. The first call should come before other
// threads read the environment.
void setUpDecoders();

// Silences std::cerr for its lifetime: OpenCV 4.6 prints exceptions of imread, imdecode and imwrite there,
// whatever the log level. Our own messages do not use it (engine/core/Log.h). One at a time.
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
