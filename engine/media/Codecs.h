// Picture files and cameras, by OpenCV. Its libraries for these bring some 100 others into the process: 36
// MiB and 90 ms that a dive into a video has no use for. So they are reached through a library of ours that
// is loaded when the first picture or camera is asked for. For this room and the webcam's.
#pragma once

#include "engine/core/Result.h"

#include <opencv2/core.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace shoal::media {

struct CameraWish {
    int width = 0, height = 0; // the camera gives what is nearest
    bool jpeg = false;         // coded, in which alone most cameras send large pictures; if it knows that
    int waiting = 0;           // pictures that may wait within the system; 0: as it likes
};

// Methods may throw as OpenCV does.
class OpenCamera {
  public:
    virtual ~OpenCamera() = default;
    virtual bool grab() = 0; // the next picture
    virtual cv::Size size() const = 0;
    virtual bool retrieve(cv::Mat& bgr) = 0; // the one grabbed last
};

// Each as OpenCV's function of that name, which may throw. Empty, false or null: it cannot.
struct Codecs {
    cv::Mat (*imdecode)(const std::vector<uint8_t>& bytes, int flags);
    cv::Mat (*imread)(const std::string& file, int flags);
    bool (*imencode)(const std::string& kind, const cv::Mat& bgr, std::vector<uint8_t>& bytes);
    bool (*imwrite)(const std::string& file, const cv::Mat& bgr);
    std::unique_ptr<OpenCamera> (*openCamera)(int index, const CameraWish& wish);
};

// Loaded with the first call, from any thread, and kept. Looked for beside the program, then where it was
// built. Error: it is not there, or something that it needs is not. Sets up OpenCV (Quiet.h).
Result<const Codecs*> codecs();

// What the library gives under this name, with C linkage.
constexpr const char* kCodecsName = "shoalCodecs";

} // namespace shoal::media
