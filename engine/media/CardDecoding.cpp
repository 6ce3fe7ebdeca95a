#include "engine/media/CardDecoding.h"

#include "engine/core/Log.h"

extern "C" {
#include <libavutil/hwcontext.h>
#include <libavutil/imgutils.h>
}

#include <algorithm>
#include <utility>

namespace shoal::media {

// Returns the format that the decoder's owner keeps in `opaque`; none, which fails, if it is not offered: the
// decoder itself would go on with one thread.
static AVPixelFormat cardFormat(AVCodecContext* decoder, const AVPixelFormat* offered) {
    const auto wanted = static_cast<AVPixelFormat>(reinterpret_cast<intptr_t>(decoder->opaque));
    while (*offered != AV_PIX_FMT_NONE && *offered != wanted) ++offered;
    return *offered;
}

static Codec openOn(AVHWDeviceType device, const AVCodec& kind, AVPixelFormat format, const AVStream& stream,
                    int64_t maxPixels) {
    Codec codec(avcodec_alloc_context3(&kind));
    if (!codec || av_hwdevice_ctx_create(&codec->hw_device_ctx, device, nullptr, nullptr, 0) < 0 ||
        avcodec_parameters_to_context(codec.get(), stream.codecpar) < 0)
        return nullptr;
    codec->pkt_timebase = stream.time_base;
    codec->opaque = reinterpret_cast<void*>(intptr_t{format});
    codec->get_format = cardFormat;
    codec->thread_count = 1;
    codec->max_pixels = maxPixels;
    return avcodec_open2(codec.get(), &kind, nullptr) < 0 ? nullptr : std::move(codec);
}

Codec openOnCard(const AVStream& stream, int64_t maxPixels) {
    for (const AVHWDeviceType device : {AV_HWDEVICE_TYPE_VAAPI, AV_HWDEVICE_TYPE_CUDA}) {
        void* at = nullptr;
        while (const AVCodec* kind = av_codec_iterate(&at)) { // the codec's first may be software alone
            if (kind->id != stream.codecpar->codec_id || !av_codec_is_decoder(kind)) continue;
            for (int i = 0; const AVCodecHWConfig* way = avcodec_get_hw_config(kind, i); ++i) {
                if (way->device_type != device || !(way->methods & AV_CODEC_HW_CONFIG_METHOD_HW_DEVICE_CTX))
                    continue;
                Codec codec = openOn(device, *kind, way->pix_fmt, stream, maxPixels);
                if (!codec) continue;
                log::info("the film is decoded by {}", av_hwdevice_get_type_name(device));
                return codec;
            }
        }
    }
    return nullptr;
}

// Copies codes that are shifted within their bits.
template <class Code> static void split(const AVFrame& from, int shift, AVFrame& to) {
    const auto row = [](const AVFrame& of, int plane, int y) {
        return reinterpret_cast<Code*>(of.data[plane] + ptrdiff_t{y} * of.linesize[plane]);
    };
    const auto code = [=](Code stored) { return static_cast<Code>(stored >> shift); };
    for (int y = 0; y < to.height; ++y)
        std::transform(row(from, 0, y), row(from, 0, y) + to.width, row(to, 0, y), code);
    for (int y = 0; y < (to.height + 1) / 2; ++y) {
        const Code* pairs = row(from, 1, y);
        Code *const blue = row(to, 1, y), *const red = row(to, 2, y);
        for (int x = 0; x < (to.width + 1) / 2; ++x)
            blue[x] = code(pairs[2 * x]), red[x] = code(pairs[2 * x + 1]);
    }
}

bool CardPictures::copyInPlanes(const AVFrame& codes, AVFrame& picture) {
    const bool isDeep = codes.format == AV_PIX_FMT_P010;
    if (!isDeep && codes.format != AV_PIX_FMT_NV12) return false;
    constexpr int kAlign = 64; // of rows, bytes
    const AVPixelFormat format = isDeep ? AV_PIX_FMT_YUV420P10 : AV_PIX_FMT_YUV420P;
    const int bytes = av_image_get_buffer_size(format, codes.width, codes.height, kAlign);
    if (bytes > 0 && bytes != std::exchange(pictureBytes_, bytes))
        pool_.reset(av_buffer_pool_init(static_cast<size_t>(bytes), nullptr));
    picture.buf[0] = pool_ ? av_buffer_pool_get(pool_.get()) : nullptr;
    if (!picture.buf[0]) return false;
    picture.format = format;
    picture.width = codes.width, picture.height = codes.height;
    av_image_fill_arrays(picture.data, picture.linesize, picture.buf[0]->data, format, codes.width,
                         codes.height, kAlign);
    isDeep ? split<uint16_t>(codes, 6, picture) : split<uint8_t>(codes, 0, picture);
    return true;
}

bool CardPictures::bringBack(AVFrame& picture) {
    if (!picture.hw_frames_ctx) return false;
    if (codes_->width != picture.width || codes_->height != picture.height) av_frame_unref(codes_.get());
    av_frame_unref(copy_.get());
    if (av_hwframe_transfer_data(codes_.get(), &picture, 0) < 0 || !copyInPlanes(*codes_, *copy_) ||
        av_frame_copy_props(copy_.get(), &picture) < 0)
        return false;
    av_frame_unref(&picture);
    av_frame_move_ref(&picture, copy_.get());
    return true;
}

} // namespace shoal::media
