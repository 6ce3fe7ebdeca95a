#include "engine/media/Ffmpeg.h"

#include "engine/media/Codecs.h"

#include <opencv2/core/utils/logger.hpp>

#include <cstdlib>
#include <dlfcn.h>
#include <mutex>

namespace shoal::media {

void setUpDecoders() {
    // Enough for any plane of a picture of kMaxVideoSide a side, at 16 bits.
    constexpr size_t kMaxMemory = size_t{256} << 20;
    static std::once_flag once;
    std::call_once(once, [] {
        av_log_set_level(AV_LOG_QUIET);
        av_max_alloc(kMaxMemory);
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

int filmStreamOf(AVFormatContext& input) {
    const auto isCover = [&](int i) {
        return (input.streams[i]->disposition &
                (AV_DISPOSITION_ATTACHED_PIC | AV_DISPOSITION_TIMED_THUMBNAILS)) != 0;
    };
    int best = av_find_best_stream(&input, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    for (int i = 0; best >= 0 && isCover(best) && i < static_cast<int>(input.nb_streams); ++i)
        if (input.streams[i]->codecpar->codec_type == AVMEDIA_TYPE_VIDEO && !isCover(i)) best = i;
    return best >= 0 && isCover(best) ? -1 : best;
}

void keepOnly(AVFormatContext& input, int stream) {
    for (unsigned i = 0; i < input.nb_streams; ++i)
        input.streams[i]->discard = static_cast<int>(i) == stream ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
}

static Result<const Codecs*> load() {
    setUpDecoders();
    const Path built = SHOAL_CODECS;
    Path file = built;
    std::error_code code;
    for (const char* folder : {".", SHOAL_LIBRARY_FROM_PROGRAM}) {
        const Path there = (programFolder() / folder / built.filename()).lexically_normal();
        if (file == built && std::filesystem::exists(there, code)) file = there;
    }
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    const void* found = library ? dlsym(library, "shoalCodecs") : nullptr;
    if (!found) {
        const char* why = dlerror();
        return Error{"", std::string("pictures and cameras need a library of this program: ") +
                             (why ? why : "it is empty")};
    }
    return static_cast<const Codecs*>(found);
}

Result<const Codecs*> codecs() {
    static const Result<const Codecs*> loaded = load();
    return loaded;
}

} // namespace shoal::media
