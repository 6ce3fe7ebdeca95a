#include "engine/media/live/StreamDecoder.h"

#include "engine/media/VideoInfo.h"

extern "C" {
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>

namespace shoal::media {

StreamDecoder::StreamDecoder() : frame_(av_frame_alloc()) {}
StreamDecoder::~StreamDecoder() { sws_freeContext(scaler_); }

Status StreamDecoder::open(const AVCodecParameters& parameters, AVRational timeBase) {
    const AVCodec* kind = avcodec_find_decoder(parameters.codec_id);
    codec_.reset(kind ? avcodec_alloc_context3(kind) : nullptr);
    if (!codec_ || avcodec_parameters_to_context(codec_.get(), &parameters) < 0)
        return Error{"", "is of a codec that is not installed"};
    codec_->pkt_timebase = timeBase;
    // Threads that share a picture; threads that each take a picture would hold as many back.
    codec_->thread_type = FF_THREAD_SLICE;
    codec_->thread_count = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 8u));
    codec_->flags |= AV_CODEC_FLAG_LOW_DELAY;
    codec_->max_pixels = int64_t{kMaxVideoSide} * kMaxVideoSide;
    if (avcodec_open2(codec_.get(), kind, nullptr) < 0) return Error{"", "cannot be decoded"};
    return Done{};
}

void StreamDecoder::send(const AVPacket* packet, double arrived_s, bool hurry) {
    codec_->skip_frame = hurry ? AVDISCARD_NONREF : AVDISCARD_DEFAULT;
    // Comes out with the picture, whatever the order: microseconds.
    codec_->reordered_opaque = std::llround(arrived_s * 1e6);
    avcodec_send_packet(codec_.get(), packet);
}

void StreamDecoder::forget() { avcodec_flush_buffers(codec_.get()); }

bool StreamDecoder::receive() { return avcodec_receive_frame(codec_.get(), frame_.get()) == 0; }

double StreamDecoder::arrived_s() const { return static_cast<double>(frame_->reordered_opaque) * 1e-6; }

Status StreamDecoder::convert(ImageRgb8& bgr) {
    const int width = frame_->width, height = frame_->height;
    if (width < 2 || height < 2) return Error{"", "its picture has no size"};
    if (width > kMaxVideoSide || height > kMaxVideoSide)
        return Error{"",
                     "its picture is larger than the limit of " + std::to_string(kMaxVideoSide) + " a side"};
    scaler_ = sws_getCachedContext(scaler_, width, height, static_cast<AVPixelFormat>(frame_->format), width,
                                   height, AV_PIX_FMT_BGR24, SWS_POINT, nullptr, nullptr, nullptr);
    if (!scaler_) return Error{"", "its picture is of an unknown form"};
    // Motion JPEG is BT.601 whatever its size (JFIF); FFmpeg's numbers are those of H.273.
    const ColourMatrix matrix = codec_->codec_id == AV_CODEC_ID_MJPEG
                                    ? ColourMatrix::Bt601
                                    : colourMatrixOf(frame_->colorspace, width, height);
    const int* from = sws_getCoefficients(matrix == ColourMatrix::Bt709    ? SWS_CS_ITU709
                                          : matrix == ColourMatrix::Bt2020 ? SWS_CS_BT2020
                                                                           : SWS_CS_ITU601);
    const bool full = frame_->color_range == AVCOL_RANGE_JPEG || codec_->codec_id == AV_CODEC_ID_MJPEG;
    constexpr int kOne = 1 << 16;
    sws_setColorspaceDetails(scaler_, from, full, sws_getCoefficients(SWS_CS_DEFAULT), 1, 0, kOne, kOne);
    if (bgr.width != width || bgr.height != height) bgr = ImageRgb8(width, height);
    uint8_t* rows[4] = {bgr.pixels.data(), nullptr, nullptr, nullptr};
    const int strides[4] = {width * 3, 0, 0, 0};
    if (sws_scale(scaler_, frame_->data, frame_->linesize, 0, height, rows, strides) != height)
        return Error{"", "its picture is of an unknown form"};
    return Done{};
}

} // namespace shoal::media
