// Decoders of pictures and sound, through FFmpeg. Internal to this folder; each belongs to one thread.
#pragma once

#include "engine/media/Ffmpeg.h"
#include "engine/media/FrameConverter.h"
#include "engine/media/VideoFrame.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <memory>

namespace shoal::media {

constexpr int64_t kMaxVideoPixels = int64_t{kMaxVideoSide} * kMaxVideoSide;

// Fails if pictures of that size are not played.
Status checkPictureSize(int width, int height);

// Converts a picture in planes (luma, blue and red difference), which are `strides` bytes a row, to the size
// that bgr has. Each difference stands for two pixels of a row, the last one of an odd width for one, and for
// rowsPerDifference rows, 1 or 2. fullRange: luma 0 to 255, differences span 255; else 16 to 235 and 224
// (BT.601 and 709). Values are within 0.6 of the formula's, clamped to 0 .. 255.
void toBgr(const std::array<const uint8_t*, 3>& planes, const std::array<int, 3>& strides,
           int rowsPerDifference, ColourMatrix matrix, bool fullRange, ImageRgb8& bgr);

// Brings pictures back from a graphics card, which decodes films by VAAPI or CUDA; keeps memory between them.
class CardPictures {
  public:
    // Replaces a picture on the card by a copy in planes, as software decoders give it. False: that failed.
    bool bringBack(AVFrame& picture);
    // Makes `picture` a copy in planes of NV12 or P010, which have both colour differences in one plane.
    bool copyInPlanes(const AVFrame& codes, AVFrame& picture);

  private:
    Frame codes_ = makeFrame(), copy_ = makeFrame();
    std::unique_ptr<AVBufferPool, FreeAt<av_buffer_pool_uninit>> pool_; // of pictures of pictureBytes_
    int pictureBytes_ = 0;
};

// ByThreads: each thread decodes its own picture, which is faster but delays pictures by one for each thread.
enum class FrameThreading { None, ByThreads };

// Decoder of packets to frames: pictures, or blocks of sound.
class Decoder {
  public:
    // Fails if no such codec is installed or it does not start. threads: at least 1. maxPixels: larger
    // pictures are skipped like damaged ones. onCard: decodes on a graphics card, if one can do it.
    Status open(const AVStream& stream, FrameThreading threading, int threads,
                int64_t maxPixels = kMaxVideoPixels, bool onCard = false);
    // Returns whether a graphics card failed: no more frames come.
    bool cardFailed() const { return cardFailed_; }

    // Sends a packet; null drains the decoder. Skips damaged packets; hurry: non-reference pictures too.
    void send(const AVPacket* packet, bool hurry = false);
    void flush() { avcodec_flush_buffers(codec_.get()); } // after a seek, or after packets were left out

    // Receives the next complete frame; false if there is none.
    bool receive();
    // The frame received last.
    AVFrame& frame() { return *frame_; }
    void exchange(Frame& other) { frame_.swap(other); } // receives into `other` from now on
    glm::ivec2 chromaTexels() const; // texels of a picture that share a colour, across and down
    FrameColour colour(const AVFrame& received) const; // as the frame states it, else as the stream does

    // Converts the picture received last, blue first, by the colours and range that it states, or else its
    // stream; bgr takes its size. radianceLin: null, or takes the light of PQ or HLG; empty for other
    // pictures. Fails if it is too large, or of an unknown pixel format.
    Status convert(ImageRgb8& bgr, ImageRgbF* radianceLin = nullptr);
    void share(VideoFrame& out) { converter_.share(*frame_, colour(*frame_), out); }

  private:
    Codec codec_;
    CardPictures card_;
    bool isOnCard_ = false, cardFailed_ = false;
    Frame frame_ = makeFrame();
    StatedColour stated_; // by the stream
    FrameConverter converter_;
};

// Decoder of one stream of a file.
struct FileDecoder {
    Input input;
    int stream = -1;
    Decoder decoder;
    Packet packet = makePacket();
    bool drained = false; // whether the end of the file was sent to the decoder
    bool hurries = false; // whether next() leaves out pictures that no others refer to

    const AVStream& opened() const { return *input->streams[stream]; }
    // Returns the length that the file states; 0 if it does not.
    double length_s() const {
        return static_cast<double>(std::max<int64_t>(input->duration, 0)) / AV_TIME_BASE;
    }
    // Opens a file's film, without its decoder. The error has no path.
    Status openFilm(const Path& file);
    // Decodes the next frame. Returns false at the end, or after so many packets of the stream without one.
    bool next(int maxPackets);
    // Seeks to a key frame at or before this time stamp. Returns false if the file cannot be read there.
    bool seek(int64_t stamp, int flags = AVSEEK_FLAG_BACKWARD);
};

} // namespace shoal::media
