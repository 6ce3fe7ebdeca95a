// Smart pointer to an output of FFmpeg.
#pragma once

#include "engine/media/Ffmpeg.h"

namespace shoal::media {

// Frees an output that is written to memory (avio_open_dyn_buf()), with its contents so far.
struct CloseOutput {
    void operator()(AVFormatContext* output) const {
        uint8_t* bytes = nullptr;
        if (output->pb) avio_close_dyn_buf(output->pb, &bytes);
        av_free(bytes);
        avformat_free_context(output);
    }
};
using Output = std::unique_ptr<AVFormatContext, CloseOutput>;

} // namespace shoal::media
