// Decoder of video packets to pictures, through FFmpeg. Internal to this folder; belongs to one thread.
#pragma once

#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/media/Ffmpeg.h"
#include "engine/media/VideoFrame.h"
#include "engine/media/YuvToBgr.h"

extern "C" {
#include <libswscale/swscale.h>
}

#include <glm/vec2.hpp>

#include <vector>

namespace shoal::media {

constexpr int64_t kMaxPixels = int64_t{kMaxVideoSide} * kMaxVideoSide;

// Error: pictures of that size are not played.
Status checkPictureSize(int width, int height);

// Motion JPEG is BT.601 whatever its size (JFIF); else as colourMatrixOf() says.
ColourMatrix matrixOf(AVCodecID codec, AVColorSpace stated, int width, int height);

struct FreeScaler {
    void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};

// ByThreads: each thread decodes a picture of its own, which is faster but delays pictures by as many.
enum class FrameThreading { None, ByThreads };

class PictureDecoder {
  public:
    // threads: at least 1. maxPixels: larger pictures are skipped as damaged ones are. Error: no such codec
    // is installed, or it does not start.
    Status open(const AVCodecParameters& parameters, AVRational timeBase, FrameThreading threading,
                int threads, int64_t maxPixels = kMaxPixels);

    // packet: null drains the decoder. Damaged packets are skipped. hurry: non-reference pictures too.
    void send(const AVPacket* packet, bool hurry = false);
    void flush() { avcodec_flush_buffers(codec_.get()); } // after a seek, or where packets were left out

    // The next picture that is complete, if there is one.
    bool receive();
    // Properties of the picture received last:
    const AVFrame& frame() const { return *frame_; }
    ColourMatrix matrix() const;
    glm::ivec2 chromaTexels() const; // that share a colour, across and down

    // The picture received last, blue first; bgr takes its size. Colours by the matrix and range that it
    // states. Error: it is too large, or of an unknown pixel format.
    Status convert(ImageRgb8& bgr);

  private:
    bool fullRange() const;
    Status convertBySwscale(ImageRgb8& bgr);

    Codec codec_;
    Frame frame_ = makeFrame();
    std::unique_ptr<SwsContext, FreeScaler> scaler_; // of rare pixel formats
    std::vector<uint8_t> rows_;                      // its output, with a margin behind each row
};

} // namespace shoal::media
