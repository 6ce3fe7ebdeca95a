// FFmpeg's headers, setup of it and of OpenCV, smart pointers, opening of files. Internal to this folder.
#pragma once

#include "engine/core/Files.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/avstring.h>
#include <libavutil/channel_layout.h>
#include <libavutil/crc.h>
#include <libavutil/csp.h>
#include <libavutil/hwcontext.h>
#include <libavutil/imgutils.h>
#include <libavutil/log.h>
#include <libavutil/mem.h>
#include <libavutil/opt.h>
#include <libavutil/parseutils.h>
#include <libavutil/pixdesc.h>
#include <libavutil/spherical.h>
#include <libavutil/stereo3d.h>
#include <libavutil/time.h>
#include <libswresample/swresample.h>
}

#include <memory>

namespace shoal::media {

// Deleter that passes the address of the pointer, as FFmpeg's freeing functions expect it.
template <auto kFree> struct FreeAt {
    template <class T> void operator()(T* object) const { kFree(&object); }
};
using Packet = std::unique_ptr<AVPacket, FreeAt<av_packet_free>>; // never null once made
using Frame = std::unique_ptr<AVFrame, FreeAt<av_frame_free>>;
using Codec = std::unique_ptr<AVCodecContext, FreeAt<avcodec_free_context>>;
using Input = std::unique_ptr<AVFormatContext, FreeAt<avformat_close_input>>;

inline Packet makePacket() { return Packet(av_packet_alloc()); }
inline Frame makeFrame() { return Frame(av_frame_alloc()); }

// Must be called before the first use of FFmpeg and of OpenCV's codecs (Codecs.h). Silences their logs on
// standard error, bounds FFmpeg's allocations.
void setUpDecoders();

// Containers of video. FFmpeg's other formats include playlists and scripts that name further files.
constexpr const char* kVideoContainers = "mov,matroska,avi,ogg,flv,mpeg,mpegts";

// Opens a file and nothing else: neither its name nor a playlist may lead to a server. formats: FFmpeg's
// names of the containers that are allowed, comma separated; null: all. Returns null if it cannot be opened.
Input openInput(const Path& file, const char* formats = nullptr);

// Returns side data of a stream; null if it has fewer than `count` items. FFmpeg 6.1 moved it to codecpar.
template <class T> const T* sideData(const AVStream& of, AVPacketSideDataType type, size_t count = 1) {
#if LIBAVCODEC_VERSION_INT >= AV_VERSION_INT(60, 31, 0)
    const AVCodecParameters& in = *of.codecpar;
    const auto* found = av_packet_side_data_get(in.coded_side_data, in.nb_coded_side_data, type);
    const uint8_t* bytes = found ? found->data : nullptr;
    const size_t size = found ? found->size : 0;
#else
    size_t size = 0;
    const uint8_t* bytes = av_stream_get_side_data(&of, type, &size);
#endif
    return size >= count * sizeof(T) ? reinterpret_cast<const T*>(bytes) : nullptr;
}

// Returns the index of the video stream; negative if the file has none, or only the cover of its music.
int filmStreamOf(AVFormatContext& input);

// Returns a picture's duration in units of its stream; 0: unknown. FFmpeg 6 gave it another name.
inline int64_t durationOf(const AVFrame& picture) {
#if LIBAVUTIL_VERSION_INT >= AV_VERSION_INT(57, 30, 100)
    return picture.duration;
#else
    return picture.pkt_duration;
#endif
}

// Discards all streams but this one.
void keepOnly(AVFormatContext& input, int stream);

} // namespace shoal::media
