#include "engine/media/Ffmpeg.h"

#include <opencv2/core/utils/logger.hpp>

extern "C" {
#include <libavutil/log.h>
}

#include <cstdlib>
#include <mutex>

namespace shoal::media {

void setUpDecoders() {
    // Enough for any plane of a picture of kMaxVideoSide a side, at 16 bits.
    constexpr size_t kMaxMemory = size_t{256} << 20;
    constexpr int kDoNotOverwrite = 0;
    static std::once_flag once;
    std::call_once(once, [] {
        av_log_set_level(AV_LOG_QUIET);
        av_max_alloc(kMaxMemory);
        setenv("OPENCV_IO_ENABLE_OPENEXR", "1", kDoNotOverwrite);
        if (!std::getenv("OPENCV_LOG_LEVEL"))
            cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    });
}

Input openInput(const Path& file, const char* formats) {
    AVFormatContext* input = nullptr;
    AVDictionary* options = nullptr;
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    av_dict_set(&options, "format_whitelist", formats, 0);
    const int opened = avformat_open_input(&input, ("file:" + file.string()).c_str(), nullptr, &options);
    av_dict_free(&options);
    return Input(opened < 0 ? nullptr : input);
}

void keepOnly(AVFormatContext& input, int stream) {
    for (unsigned i = 0; i < input.nb_streams; ++i)
        input.streams[i]->discard = static_cast<int>(i) == stream ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
}

} // namespace shoal::media
