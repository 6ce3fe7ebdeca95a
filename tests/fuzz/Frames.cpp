// Decoded frames of all pixel formats and stated colours: width, height, format (2 bytes), matrix, primaries,
// transfer, flags, then what the planes hold, over and over.
#include "engine/media/FrameConverter.h"
#include "tests/fuzz/Target.h"

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    constexpr size_t kHead = 8;
    if (size <= kHead) return 0;
    const media::Frame frame = media::makeFrame();
    frame->width = 1 + data[0] % 64;
    frame->height = 1 + data[1] % 32;
    frame->format = (data[2] | data[3] << 8) % AV_PIX_FMT_NB;
    if (av_frame_get_buffer(frame.get(), 0) < 0) return 0; // a format of graphics memory
    size_t at = 0;
    for (AVBufferRef* plane : frame->buf)
        for (size_t i = 0; plane && i < plane->size; ++i)
            plane->data[i] = data[kHead + at++ % (size - kHead)];
    const media::StatedColour stated{static_cast<AVColorSpace>(data[4] % AVCOL_SPC_NB),
                                     static_cast<AVColorPrimaries>(data[5] % AVCOL_PRI_NB),
                                     static_cast<AVColorTransferCharacteristic>(data[6] % AVCOL_TRC_NB),
                                     static_cast<AVColorRange>((data[7] >> 2) % AVCOL_RANGE_NB),
                                     static_cast<AVPixelFormat>(frame->format)};
    const auto colour = media::colourOf(AV_CODEC_ID_AV1, stated, frame->width, frame->height);
    static media::FrameConverter converter;
    ImageRgb8 bgr;
    ImageRgbF light;
    if (!converter.convert(*frame, colour, bgr, (data[7] & 1) != 0 ? &light : nullptr)) return 0;
    fuzz::expect(bgr.width == frame->width && bgr.height == frame->height);
    for (const float value : light.pixels) fuzz::expect(value >= 0 && value < 1e4f);
    return 0;
}
