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

// Fails if pictures of that size are not played.
Status checkPictureSize(int width, int height);

// Returns BT.601 for Motion JPEG of any size (JFIF), else colourMatrixOf().
ColourMatrix matrixOf(AVCodecID codec, AVColorSpace stated, int width, int height);

struct FreeScaler {
    void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};

// ByThreads: each thread decodes its own picture, which is faster but delays pictures by one for each thread.
enum class FrameThreading { None, ByThreads };

class PictureDecoder {
  public:
    // Fails if no such codec is installed or it does not start. threads: at least 1. maxPixels: larger
    // pictures are skipped like damaged ones.
    Status open(const AVCodecParameters& parameters, AVRational timeBase, FrameThreading threading,
                int threads, int64_t maxPixels = kMaxPixels);

    // Sends a packet; null drains the decoder. Skips damaged packets; hurry: non-reference pictures too.
    void send(const AVPacket* packet, bool hurry = false);
    void flush() { avcodec_flush_buffers(codec_.get()); } // after a seek, or after packets were left out

    // Receives the next complete picture; false if there is none.
    bool receive();
    // Properties of the picture received last:
    const AVFrame& frame() const { return *frame_; }
    ColourMatrix matrix() const;
    glm::ivec2 chromaTexels() const; // texels that share a colour, across and down

    // Converts the picture received last, blue first, by the matrix and range that it states; bgr takes its
    // size. Fails if it is too large, or of an unknown pixel format.
    Status convert(ImageRgb8& bgr);

  private:
    bool fullRange() const;
    Status convertBySwscale(ImageRgb8& bgr);

    Codec codec_;
    Frame frame_ = makeFrame();
    std::unique_ptr<SwsContext, FreeScaler> scaler_; // for rare pixel formats
    std::vector<uint8_t> rows_;                      // the scaler's output, with a margin behind each row
};

} // namespace shoal::media
