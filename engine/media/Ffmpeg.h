// Owners of FFmpeg's objects, and how it opens a file. Internal to this folder.
#pragma once

#include "engine/core/Files.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <memory>

namespace shoal::media {

// The functions that free take the address of the pointer.
template <auto kFree> struct FreeAt {
    template <class T> void operator()(T* object) const { kFree(&object); }
};
struct CloseParser {
    void operator()(AVCodecParserContext* parser) const { av_parser_close(parser); }
};
using Packet = std::unique_ptr<AVPacket, FreeAt<av_packet_free>>; // never null once made
using Frame = std::unique_ptr<AVFrame, FreeAt<av_frame_free>>;
using Codec = std::unique_ptr<AVCodecContext, FreeAt<avcodec_free_context>>;
using Input = std::unique_ptr<AVFormatContext, FreeAt<avformat_close_input>>;

inline Packet makePacket() { return Packet(av_packet_alloc()); }
inline Frame makeFrame() { return Frame(av_frame_alloc()); }

// container: null to find out. As a file and nothing else: neither a name nor a playlist may lead to a
// server. Null if it cannot be opened.
inline Input openInput(const Path& file, const AVInputFormat* container = nullptr) {
    AVFormatContext* input = nullptr;
    AVDictionary* options = nullptr;
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    const int opened = avformat_open_input(&input, ("file:" + file.string()).c_str(), container, &options);
    av_dict_free(&options);
    return Input(opened < 0 ? nullptr : input);
}

// Of all streams only this one is read.
inline void keepOnly(AVFormatContext& input, int stream) {
    for (unsigned i = 0; i < input.nb_streams; ++i)
        input.streams[i]->discard = static_cast<int>(i) == stream ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
}

} // namespace shoal::media
