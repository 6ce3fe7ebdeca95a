// For this room and the webcam's: one video file being decoded, frame by frame. Owned by one thread at a time.
#pragma once

#include "engine/media/VideoInfo.h"

#include <opencv2/videoio.hpp>

namespace shoal::media {

class VideoSource {
  public:
    // Checks the kind of file and its stated size before any decoder sees it. info() lacks layout.
    static Result<VideoSource> open(const Path& file);

    const VideoInfo& info() const { return info_; }

    // Number of the frame that the next grab() gives, from 0.
    int64_t position() const { return position_; }

    // Decodes the next frame. False at the end, or where nothing more can be decoded.
    bool grab();

    // The frame grabbed last, blue first, into the image's own memory. False if it cannot be had or has
    // another size than info() says.
    bool retrieve(ImageRgb8& bgr);

    // Makes `number` the next frame, or a smaller number if that is as near as the file lets: the caller
    // grabs on from position(). False if the file cannot be opened again.
    bool seek(int64_t number);

  private:
    bool reopen();

    Path file_;
    cv::VideoCapture capture_;
    cv::Mat corrected_; // scratch: a few rows
    VideoInfo info_;
    int64_t position_ = 0;
    int64_t grabbedSinceSeek_ = 0;
    bool jumped_ = false;  // the position comes from a seek
    bool seekable_ = true; // until a seek went wrong
};

} // namespace shoal::media
