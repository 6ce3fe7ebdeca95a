// OpenCV's picture codecs and cameras, as a plug-in that is loaded on first use. If it were linked directly,
// it would bring some 100 libraries into the process, 36 MiB and 90 ms, which a dive into a video does not
// need. This folder and the webcam's use it.
#pragma once

#include "engine/core/Result.h"

#include <opencv2/core.hpp>

#include <functional>

namespace shoal::media {

struct CameraRequest {
    int width = 0, height = 0; // the camera gives the nearest it has
    bool jpeg = false;         // Motion JPEG if it can, which most cameras need for large pictures
    int waiting = 0;           // length of the driver's queue; 0: its default
};

// Reader of a camera. Null: waits for the next picture; else: converts it, blue first. False: no more come.
using CameraReader = std::function<bool(cv::Mat* bgr)>;

// OpenCV's function of this name, and openCamera(). They may throw. Empty or null on failure. The plug-in
// exports one as `shoalCodecs`, with C linkage.
struct Codecs {
    cv::Mat (*imdecode)(cv::InputArray bytes, int flags);
    CameraReader (*openCamera)(int index, const CameraRequest& request);
};

// Loads the plug-in at the first call, by any thread: from beside the program, else where it is installed or
// was built. Fails if it or a library that it needs is missing. Calls setUpDecoders() of Ffmpeg.h.
Result<const Codecs*> codecs();

} // namespace shoal::media
