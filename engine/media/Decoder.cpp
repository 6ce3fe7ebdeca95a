#include "engine/media/Decoder.h"

#include "engine/core/Log.h"
#include "engine/core/Vectorise.h"

#include <fmt/core.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <utility>

namespace shoal::media {

// --- Conversion of luma and colour differences

namespace {

// Sums are in units of 1/32 level: they fit in 16 bits, and rounding a product changes it by 1/64 at most.
constexpr int kSumBits = 5;
constexpr int kLumaBits = 7, kDifferenceBits = 8; // shifts that fill 16 bits before they are multiplied
constexpr int kMiddle = 128;                      // code of a difference of 0

// Returns the rounded product of two fractions of 2^15, in a form that GCC compiles to one instruction.
int16_t product(int16_t a, int16_t b) { return static_cast<int16_t>((((a * b) >> 14) + 1) >> 1); }

// Fixed-point factors: of luma times 2^13, of differences times 2^12. black: the luma code of black.
struct Factors {
    int16_t black, luma, blueOfBlue, greenOfBlue, greenOfRed, redOfRed;
};

// Computes what a row's differences add to the luma of each pixel: by channel, blue first.
SHOAL_VECTORISE
void addends(const uint8_t* __restrict blueDifference, const uint8_t* __restrict redDifference, int pairs,
             const Factors& factors, int16_t* __restrict blue, int16_t* __restrict green,
             int16_t* __restrict red) {
    for (int i = 0; i < pairs; ++i) {
        const auto cb = static_cast<int16_t>((blueDifference[i] - kMiddle) << kDifferenceBits);
        const auto cr = static_cast<int16_t>((redDifference[i] - kMiddle) << kDifferenceBits);
        blue[2 * i] = blue[2 * i + 1] = product(cb, factors.blueOfBlue);
        green[2 * i] = green[2 * i + 1] =
            static_cast<int16_t>(-product(cb, factors.greenOfBlue) - product(cr, factors.greenOfRed));
        red[2 * i] = red[2 * i + 1] = product(cr, factors.redOfRed);
    }
}

SHOAL_VECTORISE
void levels(const uint8_t* __restrict luma, const int16_t* __restrict add, int width, const Factors& factors,
            uint8_t* __restrict out) {
    const int16_t black = factors.black, scale = factors.luma;
    for (int x = 0; x < width; ++x) {
        const int16_t y = product(static_cast<int16_t>((luma[x] - black) << kLumaBits), scale);
        const auto sum = static_cast<int16_t>(y + add[x] + (1 << (kSumBits - 1)));
        out[x] = static_cast<uint8_t>(std::clamp<int16_t>(sum >> kSumBits, 0, 255));
    }
}

// The formula, with weights kr, kg, kb of luma and differences of +-1/2 (BT.601, BT.709 item 3):
//   R = Y + (2 - 2 kr) Cr,  B = Y + (2 - 2 kb) Cb,
//   G = (Y - kr R - kb B) / kg = Y - kb (2 - 2 kb) / kg Cb - kr (2 - 2 kr) / kg Cr.
Factors factorsOf(ColourMatrix matrix, bool fullRange) {
    const Luma k = lumaOf(matrix);
    const double green = 1 - k.red - k.blue;
    const auto fraction = [](double factor, int shift) {
        return static_cast<int16_t>(std::lround(factor * (1 << (15 + kSumBits - shift))));
    };
    const double difference = fullRange ? 1 : 255.0 / 224;
    const double blue = (2 - 2 * k.blue) * difference, red = (2 - 2 * k.red) * difference;
    return {.black = static_cast<int16_t>(fullRange ? 0 : 16),
            .luma = fraction(fullRange ? 1 : 255.0 / 219, kLumaBits),
            .blueOfBlue = fraction(blue, kDifferenceBits),
            .greenOfBlue = fraction(blue * k.blue / green, kDifferenceBits),
            .greenOfRed = fraction(red * k.red / green, kDifferenceBits),
            .redOfRed = fraction(red, kDifferenceBits)};
}

} // namespace

void toBgr(const std::array<const uint8_t*, 3>& planes, const std::array<int, 3>& strides,
           int rowsPerDifference, ColourMatrix matrix, bool fullRange, ImageRgb8& bgr) {
    const Factors factors = factorsOf(matrix, fullRange);
    const int width = bgr.width, pairs = (width + 1) / 2;
    std::vector<int16_t> add(static_cast<size_t>(6 * pairs));
    std::vector<uint8_t> values(static_cast<size_t>(3 * width));
    for (int y = 0; y < bgr.height; ++y) {
        const auto row = [&](size_t plane, int at) { return planes[plane] + ptrdiff_t{at} * strides[plane]; };
        const int differences = y / rowsPerDifference;
        addends(row(1, differences), row(2, differences), pairs, factors, add.data(), &add[2 * pairs],
                &add[4 * pairs]);
        cv::Mat channels[3];
        for (int c = 0; c < 3; ++c) {
            channels[c] = cv::Mat(1, width, CV_8U, &values[c * width]);
            levels(row(0, y), &add[2 * c * pairs], width, factors, channels[c].data);
        }
        cv::merge(channels, 3, cv::Mat(1, width, CV_8UC3, bgr.at(0, y)));
    }
}

// --- Decoding by a graphics card

// Returns the format that the decoder's owner keeps in `opaque`; none, which fails, if it is not offered: the
// decoder itself would go on with one thread.
static AVPixelFormat cardFormat(AVCodecContext* decoder, const AVPixelFormat* offered) {
    const auto wanted = static_cast<AVPixelFormat>(reinterpret_cast<intptr_t>(decoder->opaque));
    while (*offered != AV_PIX_FMT_NONE && *offered != wanted) ++offered;
    return *offered;
}

// Returns a decoder of the stream that is not opened yet; null if there is no such kind.
static Codec decoderOf(const AVCodec* kind, const AVStream& stream, int threads, int64_t maxPixels) {
    Codec codec(kind ? avcodec_alloc_context3(kind) : nullptr);
    if (!codec || avcodec_parameters_to_context(codec.get(), stream.codecpar) < 0) return nullptr;
    codec->pkt_timebase = stream.time_base;
    codec->thread_count = threads;
    codec->max_pixels = maxPixels;
    return codec;
}

// Returns an opened decoder whose pictures are on a card; null if there is none for this stream.
static Codec openOnCard(const AVStream& stream, int64_t maxPixels) {
    for (const AVHWDeviceType device : {AV_HWDEVICE_TYPE_VAAPI, AV_HWDEVICE_TYPE_CUDA}) {
        void* at = nullptr;
        while (const AVCodec* kind = av_codec_iterate(&at)) { // the codec's first may be software alone
            if (kind->id != stream.codecpar->codec_id || !av_codec_is_decoder(kind)) continue;
            for (int i = 0; const AVCodecHWConfig* way = avcodec_get_hw_config(kind, i); ++i) {
                if (way->device_type != device || !(way->methods & AV_CODEC_HW_CONFIG_METHOD_HW_DEVICE_CTX))
                    continue;
                Codec codec = decoderOf(kind, stream, 1, maxPixels);
                if (!codec || av_hwdevice_ctx_create(&codec->hw_device_ctx, device, nullptr, nullptr, 0) < 0)
                    continue;
                codec->opaque = reinterpret_cast<void*>(intptr_t{way->pix_fmt});
                codec->get_format = cardFormat;
                if (avcodec_open2(codec.get(), kind, nullptr) < 0) continue;
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

// --- Decoding

Status checkPictureSize(int width, int height) {
    if (width < 2 || height < 2) return Error{"", "its picture has no size"};
    if (width > kMaxVideoSide || height > kMaxVideoSide)
        return Error{"", fmt::format("its picture of {}x{} pixels is larger than the limit of {} a side",
                                     width, height, kMaxVideoSide)};
    return Done{};
}

Status Decoder::open(const AVStream& stream, FrameThreading threading, int threads, int64_t maxPixels,
                     bool onCard) {
    cardFailed_ = false;
    codec_ = onCard ? openOnCard(stream, maxPixels) : nullptr;
    isOnCard_ = codec_ != nullptr;
    stated_ = {stream.codecpar->color_space, stream.codecpar->color_primaries, stream.codecpar->color_trc};
    if (isOnCard_) return Done{};
    const AVCodec* kind = avcodec_find_decoder(stream.codecpar->codec_id);
    codec_ = decoderOf(kind, stream, threads, maxPixels);
    if (!codec_) return Error{"", "is of a codec that is not installed"};
    if (threading == FrameThreading::None) {
        codec_->thread_type = FF_THREAD_SLICE; // threads share a picture
        codec_->flags |= AV_CODEC_FLAG_LOW_DELAY;
    }
    if (avcodec_open2(codec_.get(), kind, nullptr) < 0) return Error{"", "cannot be decoded"};
    return Done{};
}

void Decoder::send(const AVPacket* packet, bool hurry) {
    codec_->skip_frame = hurry ? AVDISCARD_NONREF : AVDISCARD_DEFAULT;
    const int sent = avcodec_send_packet(codec_.get(), packet);
    cardFailed_ = cardFailed_ || (isOnCard_ && sent < 0 && sent != AVERROR_EOF);
}

bool Decoder::receive() {
    const int received = avcodec_receive_frame(codec_.get(), frame_.get());
    if (!isOnCard_) return received == 0;
    const bool isEmpty = received == AVERROR(EAGAIN) || received == AVERROR_EOF;
    cardFailed_ = cardFailed_ || (!isEmpty && (received < 0 || !card_.bringBack(*frame_)));
    return received == 0 && !cardFailed_;
}

Status FileDecoder::openFilm(const Path& file) {
    const Error unreadable{"", "has no video that can be read: it is damaged, cut short or only sound"};
    drained = false;
    input = openInput(file, kVideoContainers);
    if (!input) return unreadable;
    // Checked before a decoder sees the stream, if the container states a size.
    for (unsigned i = 0; i < input->nb_streams; ++i)
        if (const AVCodecParameters& stated = *input->streams[i]->codecpar;
            stated.codec_type == AVMEDIA_TYPE_VIDEO && std::max(stated.width, stated.height) > kMaxVideoSide)
            return checkPictureSize(stated.width, stated.height);
    if (avformat_find_stream_info(input.get(), nullptr) < 0) return unreadable;
    stream = filmStreamOf(*input);
    if (stream < 0) return unreadable;
    keepOnly(*input, stream);
    return checkPictureSize(opened().codecpar->width, opened().codecpar->height);
}

bool FileDecoder::next(int maxPackets) {
    for (int sent = 0; !decoder.receive();) {
        if (!input || drained || decoder.cardFailed() || sent == maxPackets) return false;
        av_packet_unref(packet.get());
        drained = av_read_frame(input.get(), packet.get()) < 0; // the decoder may hold frames still
        if (!drained && packet->stream_index != stream) continue;
        decoder.send(drained ? nullptr : packet.get(), hurries);
        ++sent;
    }
    return true;
}

bool FileDecoder::seek(int64_t stamp, int flags) {
    if (av_seek_frame(input.get(), stream, stamp, flags) < 0) return false;
    decoder.flush();
    drained = false;
    return true;
}

glm::ivec2 Decoder::chromaTexels() const {
    const AVPixFmtDescriptor* format = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame_->format));
    return format ? glm::ivec2(1 << format->log2_chroma_w, 1 << format->log2_chroma_h) : glm::ivec2(1);
}

FrameColour Decoder::colour(const AVFrame& received) const {
    StatedColour stated = stated_;
    if (received.colorspace != AVCOL_SPC_UNSPECIFIED) stated.matrix = received.colorspace;
    if (received.color_primaries != AVCOL_PRI_UNSPECIFIED) stated.primaries = received.color_primaries;
    if (received.color_trc != AVCOL_TRC_UNSPECIFIED) stated.transfer = received.color_trc;
    stated.range = received.color_range;
    stated.format = static_cast<AVPixelFormat>(received.format);
    return colourOf(codec_->codec_id, stated, received.width, received.height);
}

Status Decoder::convert(ImageRgb8& bgr, ImageRgbF* radianceLin) {
    const int width = frame_->width, height = frame_->height;
    if (Status playable = checkPictureSize(width, height); !playable) return playable;
    const auto format = static_cast<AVPixelFormat>(frame_->format);
    const FrameColour colour = this->colour(*frame_);
    if (!colour.decodable) return colour.decodable;
    const bool isUsual = format == AV_PIX_FMT_YUV420P || format == AV_PIX_FMT_YUV422P ||
                         format == AV_PIX_FMT_YUVJ420P || format == AV_PIX_FMT_YUVJ422P;
    if (!isUsual || colour.transfer != Transfer::Sdr || colour.primaries != AVCOL_PRI_BT709)
        return converter_.convert(*frame_, colour, bgr, radianceLin);
    // Whole numbers take a fraction of the converter's time, within 0.6 levels.
    if (radianceLin && !radianceLin->empty()) *radianceLin = {};
    bgr.fit(width, height);
    const auto& data = frame_->data;
    const auto& linesize = frame_->linesize;
    toBgr({data[0], data[1], data[2]}, {linesize[0], linesize[1], linesize[2]}, chromaTexels().y,
          colour.matrix, colour.fullRange, bgr);
    return Done{};
}

} // namespace shoal::media
