#include "engine/media/PictureDecoder.h"

#include "engine/media/YuvToBgr.h"

extern "C" {
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <string>

namespace shoal::media {

Status checkPictureSize(int width, int height) {
    if (width < 2 || height < 2) return Error{"", "its picture has no size"};
    if (width > kMaxVideoSide || height > kMaxVideoSide)
        return Error{"", "its picture of " + std::to_string(width) + "x" + std::to_string(height) +
                             " pixels is larger than the limit of " + std::to_string(kMaxVideoSide) +
                             " a side"};
    return Done{};
}

ColourMatrix matrixOf(AVCodecID codec, AVColorSpace stated, int width, int height) {
    return codec == AV_CODEC_ID_MJPEG ? ColourMatrix::Bt601 : colourMatrixOf(stated, width, height);
}

Status PictureDecoder::open(const AVCodecParameters& parameters, AVRational timeBase,
                            FrameThreading threading, int threads, int64_t maxPixels) {
    const AVCodec* kind = avcodec_find_decoder(parameters.codec_id);
    codec_.reset(kind ? avcodec_alloc_context3(kind) : nullptr);
    if (!codec_ || avcodec_parameters_to_context(codec_.get(), &parameters) < 0)
        return Error{"", "is of a codec that is not installed"};
    codec_->pkt_timebase = timeBase;
    codec_->thread_count = threads;
    if (threading == FrameThreading::None) {
        codec_->thread_type = FF_THREAD_SLICE; // threads share a picture
        codec_->flags |= AV_CODEC_FLAG_LOW_DELAY;
    }
    codec_->max_pixels = maxPixels;
    if (avcodec_open2(codec_.get(), kind, nullptr) < 0) return Error{"", "cannot be decoded"};
    return Done{};
}

void PictureDecoder::send(const AVPacket* packet, bool hurry) {
    codec_->skip_frame = hurry ? AVDISCARD_NONREF : AVDISCARD_DEFAULT;
    avcodec_send_packet(codec_.get(), packet);
}

bool PictureDecoder::receive() { return avcodec_receive_frame(codec_.get(), frame_.get()) == 0; }

ColourMatrix PictureDecoder::matrix() const {
    return matrixOf(codec_->codec_id, frame_->colorspace, frame_->width, frame_->height);
}

glm::ivec2 PictureDecoder::chromaTexels() const {
    const AVPixFmtDescriptor* format = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame_->format));
    return format ? glm::ivec2(1 << format->log2_chroma_w, 1 << format->log2_chroma_h) : glm::ivec2(1);
}

bool PictureDecoder::fullRange() const {
    return frame_->color_range == AVCOL_RANGE_JPEG || frame_->format == AV_PIX_FMT_YUVJ420P ||
           frame_->format == AV_PIX_FMT_YUVJ422P || codec_->codec_id == AV_CODEC_ID_MJPEG;
}

Status PictureDecoder::convert(ImageRgb8& bgr) {
    const int width = frame_->width, height = frame_->height;
    if (Status playable = checkPictureSize(width, height); !playable) return playable;
    bgr.fit(width, height);
    const auto format = static_cast<AVPixelFormat>(frame_->format);
    if (format != AV_PIX_FMT_YUV420P && format != AV_PIX_FMT_YUVJ420P && format != AV_PIX_FMT_YUV422P &&
        format != AV_PIX_FMT_YUVJ422P)
        return convertBySwscale(bgr);
    // Uses our own loop: swscale is either 40 times as slow (SWS_ACCURATE_RND
    // SWS_FULL_CHR_H_INT) or up to 3 of 255 levels off, where ours is within 0.6.
    toBgr({{frame_->data[0], frame_->data[1], frame_->data[2]},
           {frame_->linesize[0], frame_->linesize[1], frame_->linesize[2]},
           chromaTexels().y,
           matrix(),
           fullRange()},
          bgr);
    return Done{};
}

// Converts by swscale into memory of its own, because swscale writes beyond the ends of rows.
Status PictureDecoder::convertBySwscale(ImageRgb8& bgr) {
    const Error unknown{"", "its picture is of an unknown form"};
    const int width = frame_->width, height = frame_->height;
    scaler_.reset(sws_getCachedContext(
        scaler_.release(), width, height, static_cast<AVPixelFormat>(frame_->format), width, height,
        AV_PIX_FMT_BGR24, SWS_POINT | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT, nullptr, nullptr, nullptr));
    if (!scaler_) return unknown;
    const int* from = sws_getCoefficients(static_cast<int>(matrix()));
    constexpr int kOne = 1 << 16;
    sws_setColorspaceDetails(scaler_.get(), from, fullRange(), sws_getCoefficients(SWS_CS_DEFAULT), 1, 0,
                             kOne, kOne);
    constexpr int kMargin = 64;
    const int stride = (3 * width + 2 * kMargin) / kMargin * kMargin;
    rows_.resize(static_cast<size_t>(stride) * static_cast<size_t>(height + 1));
    uint8_t* rows[4] = {rows_.data(), nullptr, nullptr, nullptr};
    const int strides[4] = {stride, 0, 0, 0};
    if (sws_scale(scaler_.get(), frame_->data, frame_->linesize, 0, height, rows, strides) != height)
        return unknown;
    for (int y = 0; y < height; ++y)
        std::copy_n(rows_.data() + ptrdiff_t{y} * stride, 3 * width, bgr.at(0, y));
    return Done{};
}

} // namespace shoal::media
