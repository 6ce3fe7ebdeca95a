#include "engine/media/DecoderSetup.h"

#include <opencv2/core/utils/logger.hpp>

extern "C" {
#include <libavutil/log.h>
#include <libavutil/mem.h>
}

#include <cstdlib>
#include <iostream>

namespace shoal::media {

// Enough for any plane of a picture of kMaxVideoSide a side, at 16 bits.
static constexpr size_t kMaxMemory = size_t{256} << 20;

void setUpDecoders() {
    static std::once_flag once;
    std::call_once(once, [] {
        constexpr int kDoNotOverwrite = 0;
        av_log_set_level(AV_LOG_QUIET);
        av_max_alloc(kMaxMemory);
        setenv("OPENCV_IO_ENABLE_OPENEXR", "1", kDoNotOverwrite);
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
