#include "engine/media/Quiet.h"

#include <opencv2/core/utils/logger.hpp>

#include <cstdlib>
#include <iostream>

namespace shoal::media {

void setUpDecoders() {
    static std::once_flag once;
    std::call_once(once, [] {
        constexpr int kKeepTheirs = 0;
        setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", kKeepTheirs); // AV_LOG_QUIET
        setenv("OPENCV_FFMPEG_CAPTURE_OPTIONS", "protocol_whitelist;file", kKeepTheirs);
        setenv("OPENCV_IO_ENABLE_OPENEXR", "1", kKeepTheirs);
        if (!std::getenv("OPENCV_LOG_LEVEL"))
            cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    });
}

static std::mutex& cerrMutex() {
    static std::mutex mutex;
    return mutex;
}

QuietCerr::QuietCerr() : turn_(cerrMutex()), before_(std::cerr.rdbuf(nullptr)) {}
QuietCerr::~QuietCerr() { std::cerr.rdbuf(before_); }

} // namespace shoal::media
